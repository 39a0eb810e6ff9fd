#include "seedflow/diagnose/candidate.h"

#include <cctype>
#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/base/trim.h"
#include "seedflow/base/units.h"
#include "seedflow/effects/device_effects.h"

namespace seedflow {

namespace {

bool is_option(const std::string& value) {
  return !value.empty() && std::isalpha(static_cast<unsigned char>(value[0]));
}

}  // namespace

Candidate candidate_of(const EffectRecord& effect) {
  const EffectEntry& entry = effect.entry;
  if (entry.path.empty()) return {effect.name, {{"Effects/" + effect.name + "/Strength", 0, 1}}};
  if (is_option(entry.present)) return {effect.name, {}, {entry.path + "=" + entry.present}};
  return {effect.name, {{entry.path, std::stod(entry.absent), std::stod(entry.present), entry.of}}};
}

Candidate read_candidate(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos) {
    const std::string path = trim(text.substr(0, equals)), value = trim(text.substr(equals + 1));
    const std::string last = path.substr(path.rfind('/') + 1);
    if (is_option(value)) return {last + " = " + value, {}, {path + "=" + value}};
    NumberWithUnit parts;
    try {
      parts = split_unit(text.substr(equals + 1));
    } catch (const InputError& error) {
      throw InputError("Candidates: \"" + text + "\": " + error.what());
    }
    const Unit unit = parts.unit.empty() ? Unit() : parse_unit(parts.unit);
    const double published = std::stod(parts.number) * unit.factor * std::pow(10.0, unit.exponent);
    return {last, {{path, 0, published, "", parts.unit}}};
  }
  std::vector<std::string> names;
  for (const EffectRecord& record : all_effect_records()) {
    if (record.name == text) return candidate_of(record);
    names.push_back(record.name);
  }
  throw InputError("Candidates: there is no effect \"" + text + "\". " + suggestion(text, names, "effect"));
}

}  // namespace seedflow
