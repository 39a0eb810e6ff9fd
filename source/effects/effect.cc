#include "seedflow/effects/effect.h"

#include <algorithm>
#include <sstream>

#include "seedflow/base/binary.h"
#include "seedflow/base/nearest_name.h"

namespace seedflow {
namespace {

/// Above 1 for a measured amplitude that exceeds the published one.
constexpr double largest_strength = 2;

/// Index of the member of that name, or InputError naming the nearest one.
template <class List>
std::size_t index_of(const List& list, const std::string& name, const std::string& effect) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError("The effect '" + effect + "' has no parameter '" + name + "'." +
                     (names.empty() ? "" : " " + suggestion(name, names, "parameter")));
  return found - names.begin();
}

bool inside(double value, const Range& range) {
  return value <= range.high && (range.low_open ? value > range.low : value >= range.low);
}

}  // namespace

Effect::Effect(EffectDefinition d) : definition(std::move(d)) {
  values.strength = record().standard_strength;
  for (const auto& number : record().numbers) values.numbers.push_back(number.published);
  for (const auto& choice : record().choices) values.choices.push_back(choice.standard);
  prepare();
}

void Effect::set_strength(double strength) {
  if (!(strength >= 0 && strength <= largest_strength)) {
    std::ostringstream text;
    text << "The strength of the effect '" << record().name << "' is " << strength << "; allowed are 0 to "
         << largest_strength << ".";
    throw InputError(text.str());
  }
  values.strength = strength;
}

void Effect::set_number(const std::string& name, double value) {
  const auto i = index_of(record().numbers, name, record().name);
  const auto& number = record().numbers[i];
  if (!inside(value, number.range)) {
    std::ostringstream text;
    text << "The parameter '" << name << "' of the effect '" << record().name << "' is " << value
         << "; allowed are " << (number.range.low_open ? "above " : "") << number.range.low << " to "
         << number.range.high << " (published: " << number.published << ").";
    throw InputError(text.str());
  }
  values.numbers[i] = value;
  prepare();
}

void Effect::set_choice(const std::string& name, const std::string& value) {
  const auto i = index_of(record().choices, name, record().name);
  const auto& options = record().choices[i].options;
  if (std::find(options.begin(), options.end(), value) == options.end())
    throw InputError("The parameter '" + name + "' of the effect '" + record().name + "' cannot be '" +
                     value + "'. " + suggestion(value, options, "value"));
  values.choices[i] = value;
  prepare();
}

double Effect::number(const std::string& name) const {
  return values.numbers[index_of(record().numbers, name, record().name)];
}

const std::string& Effect::choice(const std::string& name) const {
  return values.choices[index_of(record().choices, name, record().name)];
}

void Effect::declare(Parameters& parameters) {
  const auto& r = record();
  const auto section = parameters.section(r.name, r.summary + " " + r.equation);
  parameters.number("Strength", values.strength, "1", Range::between(0, largest_strength),
                    "0 adds exactly nothing, 1 the published effect. Valid for: " + r.validity);
  for (std::size_t i = 0; i < r.numbers.size(); ++i)
    parameters.number(r.numbers[i].name, values.numbers[i], r.numbers[i].unit, r.numbers[i].range,
                      r.numbers[i].doc);
  for (std::size_t i = 0; i < r.choices.size(); ++i)
    parameters.choice(r.choices[i].name, values.choices[i], r.choices[i].options, r.choices[i].doc);
}

void Effect::prepare() {
  law = definition.law(values);
}

void Effect::add(const FlowAtBody& flow, BodyForce& force) {
  const double s = values.strength;
  if (s == 0) return;
  EffectMemory none;
  BodyForce with = force;
  law(flow, record().has_memory ? memory[flow.body] : none, with);

  BodyForce change;
  change.drag_coefficient = s * (with.drag_coefficient - force.drag_coefficient);
  change.force = s * (with.force - force.force);
  change.torque = s * (with.torque - force.torque);
  change.added_mass = s * (with.added_mass - force.added_mass);

  force.drag_coefficient += change.drag_coefficient;
  force.force += change.force;
  force.torque += change.torque;
  force.added_mass += change.added_mass;

  ++done.evaluations;
  if (record().in_range(flow)) ++done.in_range;
  done.force += norm(change.drag_coefficient * slip(flow)) + norm(change.force) +
                norm(change.added_mass * flow.acceleration);
  done.torque += norm(change.torque);
}

EffectMemory Effect::pack(std::int64_t body) const {
  const auto found = memory.find(body);
  return found == memory.end() ? EffectMemory() : found->second;
}

void Effect::unpack(std::int64_t body, EffectMemory numbers) {
  if (numbers.empty())
    memory.erase(body);
  else
    memory[body] = std::move(numbers);
}

void Effect::save(std::ostream& out) const {
  write_binary(out, done);
  write_binary(out, static_cast<std::uint64_t>(memory.size()));
  for (const auto& [body, numbers] : memory) {
    write_binary(out, body);
    write_binary(out, numbers);
  }
}

void Effect::load(std::istream& in) {
  read_binary(in, done);
  memory.clear();
  std::uint64_t bodies = 0;
  for (read_binary(in, bodies); bodies > 0; --bodies) {
    std::int64_t body = 0;
    read_binary(in, body);
    read_binary(in, memory[body]);
  }
}

}  // namespace seedflow
