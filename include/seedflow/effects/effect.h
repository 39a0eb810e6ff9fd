#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "seedflow/base/parameters.h"
#include "seedflow/effects/slots.h"

namespace seedflow {

/// A number of an effect: the published value is the default.
struct EffectNumber {
  std::string name;
  double published = 0;
  std::string unit;
  Range range;
  std::string doc;
};

/// A named form of an effect (which drag law, which kernel): the published or recommended one is the default.
struct EffectChoice {
  std::string name;
  std::string standard;
  std::vector<std::string> options;
  std::string doc;
};

/// The entry of a model that stands for an effect without a strength of its own.
struct EffectEntry {
  std::string path;    ///< "Coupling/Drag on"; empty: the effect has its own, Effects/NAME/Strength
  std::string absent;  ///< value without the effect: an option, true or false, or a number [SI]
  std::string present;
  /// Path of a number that `present` is a share of (5 % of the diameter), or "".
  std::string of = "";
};

/// What is known of one physical effect. Data, not code: the .prm entries, the listing, the manual and the
/// diagnosis all come from it.
struct EffectRecord {
  std::string name;
  std::string slot;      ///< where it acts: "force on a body"
  std::string summary;   ///< one line
  std::string equation;  ///< with its symbols
  std::vector<EffectNumber> numbers;
  std::vector<EffectChoice> choices;
  std::vector<std::string> references;              ///< with DOI where one exists
  std::string validity;                             ///< in words
  std::function<bool(const FlowAtBody&)> in_range;  ///< the same as a test of one state
  std::string signature;                            ///< what a measurement shows when the effect is missing
  bool has_memory = false;                          ///< keeps numbers of every body from step to step
  bool random = false;           ///< one realisation says little: compare the mean or spread of many
  double standard_strength = 0;  ///< of a fresh run
  EffectEntry entry = {};        ///< of a choice of the model
};

/// The user's settings of one effect.
struct EffectSettings {
  double strength = 0;               ///< in [0, 2]; 0 adds exactly nothing, 1 as published
  std::vector<double> numbers;       ///< in the order of the record
  std::vector<std::string> choices;  ///< in the order of the record
};

/// What an effect remembers of one body, as plain numbers (empty until the effect first sees the body).
using EffectMemory = std::vector<double>;

/// Adds the effect at full strength to `force`, which already holds what the effects before it in the
/// catalogue added: factors on the drag (shape, crowding, walls) multiply the drag coefficient found there.
using EffectLaw = std::function<void(const FlowAtBody&, EffectMemory&, BodyForce&)>;

/// One line of the catalogue: the record, and the law made from settings.
struct EffectDefinition {
  EffectRecord record;
  std::function<EffectLaw(const EffectSettings&)> law;
};

/// How much an effect did so far, summed over bodies and evaluations: |force| including drag (k |u - v|) and
/// added mass (m |dv/dt|) [N], |torque| [N m].
struct EffectActivity {
  std::int64_t evaluations = 0, in_range = 0;
  double force = 0, torque = 0;
  bool acted() const { return force > 0 || torque > 0; }
};

/// One effect of a run: record, settings, memory of every body, activity.
class Effect {
 public:
  explicit Effect(EffectDefinition definition);

  const EffectRecord& record() const { return definition.record; }
  const EffectSettings& settings() const { return values; }
  const EffectActivity& activity() const { return done; }

  /// InputError if the strength is outside [0, 2], the name unknown, or the value outside its bounds.
  void set_strength(double strength);
  void set_number(const std::string& name, double value);
  void set_choice(const std::string& name, const std::string& value);
  double number(const std::string& name) const;
  const std::string& choice(const std::string& name) const;

  /// Section of this name with Strength and the record's parameters. The object must not move between this
  /// and Parameters::read.
  void declare(Parameters& parameters);
  /// To be called after Parameters::read; makes the law from the settings.
  void prepare();

  /// Adds strength times the effect. The first call for a body with a new time is the state at that time and
  /// enters the memory; further calls with the same time are trial evaluations of the same step and leave it
  /// alone.
  void add(const FlowAtBody& flow, BodyForce& force);

  /// Forgets a body that left; moves one to another rank (numbers to be sent as they are).
  void forget(std::int64_t body) { memory.erase(body); }
  EffectMemory pack(std::int64_t body) const;
  void unpack(std::int64_t body, EffectMemory numbers);
  /// Binary, bitwise. RunError if the stream ends early.
  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  EffectDefinition definition;
  EffectSettings values;
  EffectLaw law;
  std::map<std::int64_t, EffectMemory> memory;
  EffectActivity done;
};

}  // namespace seedflow
