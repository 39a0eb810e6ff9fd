#include "seedflow/effects/catalogue.h"

#include <algorithm>
#include <ostream>

#include "seedflow/base/nearest_name.h"
#include "seedflow/effects/definitions.h"
#include "seedflow/effects/device_effects.h"
#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

[[noreturn]] void unknown(const std::string& name) {
  std::vector<std::string> names;
  for (const EffectRecord& record : all_effect_records()) names.push_back(record.name);
  throw InputError("There is no effect '" + name + "'. " + suggestion(name, names, "effect") +
                   " 'seedflow effects' lists all.");
}

template <class Effects>
auto& find(Effects& effects, const std::string& name) {
  for (auto& effect : effects)
    if (effect.record().name == name) return effect;
  unknown(name);
}

void describe(std::ostream& out, const EffectRecord& r) {
  out << r.name << "\n  " << r.summary << "\n\n  Equation:   " << r.equation << "\n  Acts as:    " << r.slot
      << "\n  Valid for:  " << r.validity << "\n  Signature:  " << r.signature << '\n';
  if (r.entry.path.empty())
    out << "  Strength:   0 to " << (r.slot == "contact" ? 1 : 2) << ", 1 as published, in a fresh run "
        << r.standard_strength << '\n';
  else
    out << "  Entry:      " << r.entry.path << " = " << r.entry.present
        << (r.entry.of.empty() ? "" : " x " + r.entry.of) << ", without the effect " << r.entry.absent
        << '\n';
  for (const auto& n : r.numbers)
    out << "  Parameter:  " << n.name << " = " << n.published << (n.unit == "1" ? "" : " " + n.unit) << " ("
        << n.range.low << " to " << n.range.high << "): " << n.doc << '\n';
  for (const auto& c : r.choices) {
    out << "  Parameter:  " << c.name << " = " << c.standard << ": " << c.doc << " One of:";
    for (const auto& option : c.options) out << (option == c.options.front() ? " " : ", ") << option;
    out << '\n';
  }
  for (const auto& reference : r.references) out << "  Reference:  " << reference << '\n';
}

}  // namespace

std::vector<EffectDefinition> effect_catalogue() {
  return {
      drag(),
      nonspherical_drag(),
      hindered_settling(),
      tube_wall_drag(),
      plane_wall_drag(),  // the five above make the drag coefficient, in this order; those below add to it
      turbulent_dispersion(),
      faxen_force(),
      pressure_gradient(),
      added_mass(),
      history_force(),
      saffman_lift(),
      wall_lift(),
      magnus_lift(),
      rotational_drag(),
      inferred_law(),
  };
}

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (const auto& definition : effect_catalogue()) names.push_back(definition.record.name);
  return names;
}

void describe_effects(std::ostream& out, const std::string& name) {
  bool found = false;
  for (const EffectRecord& r : all_effect_records()) {
    if (name.empty())
      out << r.name << std::string(r.name.size() < 24 ? 24 - r.name.size() : 1, ' ') << r.summary << '\n';
    else if (r.name == name)
      describe(out, r), found = true;
  }
  if (!name.empty() && !found) unknown(name);
}

EffectSet::EffectSet() {
  for (auto& definition : effect_catalogue()) effects.emplace_back(std::move(definition));
}

void EffectSet::declare(Parameters& parameters) {
  const auto section =
      parameters.section("Effects", "Physical effects on every dragged body, each with a strength.");
  for (auto& effect : effects) effect.declare(parameters);
}

void EffectSet::prepare() {
  for (auto& effect : effects) effect.prepare();
  const auto on = [&](const char* name) { return (*this)[name].settings().strength > 0; };
  if (!on("Drag")) return;
  const DragLaw& law = drag_law((*this)["Drag"].choice("Law"));
  const auto refuse_twice = [&](const char* effect, const char* physics) {
    throw InputError(
        "Effects/Drag/Law = " + law.name + " already holds " + physics + ", and Effects/" + effect +
        "/Strength is above 0: it would count twice. Remedy: Law = Schiller-Naumann, or Strength = 0.");
  };
  if (law.uses_void_fraction && on("Hindered settling"))
    refuse_twice("Hindered settling", "the void fraction");
  if (law.uses_sphericity && on("Nonspherical drag")) refuse_twice("Nonspherical drag", "the sphericity");
}

void EffectSet::add(const FlowAtBody& flow, BodyForce& force) {
  for (auto& effect : effects) effect.add(flow, force);
}

Effect& EffectSet::operator[](const std::string& name) {
  return find(effects, name);
}
const Effect& EffectSet::operator[](const std::string& name) const {
  return find(effects, name);
}

std::vector<double> EffectSet::activity() const {
  std::vector<double> numbers;
  for (const auto& effect : effects) {
    const EffectActivity& a = effect.activity();
    numbers.insert(numbers.end(),
                   {static_cast<double>(a.evaluations), static_cast<double>(a.in_range), a.force, a.torque});
  }
  return numbers;
}

std::vector<std::string> EffectSet::idle(const std::vector<double>& activity) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < effects.size(); ++i)
    if (effects[i].settings().strength > 0 && activity[4 * i] > 0 && activity[4 * i + 2] == 0 &&
        activity[4 * i + 3] == 0)
      names.push_back(effects[i].record().name);
  return names;
}

std::vector<std::string> EffectSet::out_of_range(const std::vector<double>& activity) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < effects.size(); ++i)
    if (activity[4 * i + 1] < activity[4 * i]) names.push_back(effects[i].record().name);
  return names;
}

void EffectSet::forget(std::int64_t body) {
  for (auto& effect : effects) effect.forget(body);
}

std::vector<double> EffectSet::pack(std::int64_t body) const {
  std::vector<double> numbers;
  for (const auto& effect : effects) {
    if (!effect.record().has_memory) continue;
    const EffectMemory memory = effect.pack(body);
    numbers.push_back(static_cast<double>(memory.size()));
    numbers.insert(numbers.end(), memory.begin(), memory.end());
  }
  return numbers;
}

void EffectSet::unpack(std::int64_t body, const std::vector<double>& numbers) {
  auto next = numbers.begin();
  for (auto& effect : effects) {
    if (!effect.record().has_memory) continue;
    if (next == numbers.end() || *next > numbers.end() - next - 1)
      throw RunError(
          "The packed memory of a body is shorter than it says. Remedy: report this, with the run.");
    const auto size = static_cast<std::ptrdiff_t>(*next++);
    effect.unpack(body, EffectMemory(next, next + size));
    next += size;
  }
}

void EffectSet::save(std::ostream& out) const {
  for (const auto& effect : effects) effect.save(out);
}

void EffectSet::load(std::istream& in) {
  for (auto& effect : effects) effect.load(in);
}

}  // namespace seedflow
