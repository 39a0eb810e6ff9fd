#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/effects/effect.h"

namespace seedflow {

/// The table of contents: every effect, in the order in which they are added to a body.
std::vector<EffectDefinition> effect_catalogue();
std::vector<std::string> effect_names();

/// Generated text: the list of all effects, or everything about one. InputError with the nearest name if
/// unknown.
void describe_effects(std::ostream& out, const std::string& name = "");

/// The effects of one run. An object is independent of every other; nothing is shared.
class EffectSet {
 public:
  /// The whole catalogue at its standard strengths (drag and buoyancy 1, all others 0).
  EffectSet();

  /// Section "Effects" with one subsection per effect.
  void declare(Parameters& parameters);
  /// After Parameters::read. InputError if two effects would count the same physics twice.
  void prepare();

  /// Adds every effect of non-zero strength, see Effect::add.
  void add(const FlowAtBody& flow, BodyForce& force);

  /// InputError with the nearest name if unknown.
  Effect& operator[](const std::string& name);
  const Effect& operator[](const std::string& name) const;
  std::vector<Effect>& all() { return effects; }
  const std::vector<Effect>& all() const { return effects; }

  /// What every effect did, as numbers that can be summed over ranks: per effect evaluations, in range,
  /// force, torque.
  std::vector<double> activity() const;
  /// Names of effects with strength > 0 that were evaluated and added nothing at all, by the numbers of
  /// activity().
  std::vector<std::string> idle(const std::vector<double>& activity) const;
  std::vector<std::string> idle() const { return idle(activity()); }
  /// Names of effects that were ever evaluated outside their range of validity.
  std::vector<std::string> out_of_range(const std::vector<double>& activity) const;
  std::vector<std::string> out_of_range() const { return out_of_range(activity()); }

  void forget(std::int64_t body);
  /// All memories of one body, to be sent to another rank.
  std::vector<double> pack(std::int64_t body) const;
  void unpack(std::int64_t body, const std::vector<double>& numbers);
  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  std::vector<Effect> effects;
};

}  // namespace seedflow
