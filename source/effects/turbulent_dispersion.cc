#include <algorithm>
#include <cmath>
#include <cstdint>

#include "seedflow/effects/definitions.h"

namespace seedflow {
namespace {

/// A well-mixed 64-bit number of another (the finaliser of SplitMix64, Steele, Lea & Flood 2014).
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Three independent standard normal numbers of an eddy: a pure function, so that a run can be repeated to
/// the last bit on any number of ranks.
Vec3 normal_numbers(std::uint64_t number, std::uint64_t body, std::uint64_t eddy) {
  const std::uint64_t key = mix(mix(mix(number) ^ body) ^ eddy);
  const auto uniform = [&](std::uint64_t i) {  // in (0, 1)
    return (static_cast<double>(mix(key + i) >> 11) + 0.5) * 0x1p-53;
  };
  const double r = std::sqrt(-2 * std::log(uniform(0))), s = std::sqrt(-2 * std::log(uniform(2)));
  return {r * std::cos(2 * M_PI * uniform(1)), r * std::sin(2 * M_PI * uniform(1)),
          s * std::cos(2 * M_PI * uniform(3))};
}

enum : std::size_t { eddies, began, crossed, last, slots };  // memory of a body

}  // namespace

EffectDefinition turbulent_dispersion() {
  EffectRecord r;
  r.name = "Turbulent dispersion";
  r.slot = "force on a body";
  r.summary = "Random drag by unresolved eddies that the body meets one after the other.";
  r.equation =
      "F = k u', every component of u' normal with standard deviation 'Velocity fluctuation' and constant "
      "while "
      "the body is in one eddy: until 'Eddy lifetime' is over or the slip has carried it through 'Eddy "
      "size'. "
      "Of k-eps turbulence: sqrt(2 k/3), 0.30 k/eps and 0.164 k^1.5/eps";
  r.numbers = {
      {"Velocity fluctuation", 0.01, "m/s", Range::non_negative(),
       "Root mean square of one component of u'."},
      {"Eddy lifetime", 0.1, "s", Range::positive(), "Longest time in one eddy."},
      {"Eddy size", 0.01, "m", Range::positive(), "Slip times time after which the body has left the eddy."},
      {"Seed number", 1, "1", Range::between(0, 1e9),
       "Picks the realisation; the same number gives the same run."}};
  r.references = {"Gosman & Ioannides (1983), J. Energy 7, 482-490, doi:10.2514/3.62687"};
  r.validity =
      "homogeneous turbulence with eddies larger than the body; no force by the gradient of turbulence";
  r.in_range = [](const FlowAtBody&) { return true; };
  r.signature = "like bodies scatter: their spread grows like the root of time; the mean is left alone";
  r.has_memory = true;
  r.random = true;
  return {r, [](const EffectSettings& settings) {
            const double rms = settings.numbers[0], lifetime = settings.numbers[1],
                         size = settings.numbers[2];
            const auto number = static_cast<std::uint64_t>(settings.numbers[3]);
            return [=](const FlowAtBody& flow, EffectMemory& memory, BodyForce& force) {
              if (memory.empty()) {
                memory.assign(slots, 0.0);
                memory[began] = memory[last] = flow.time;
              }
              if (flow.time > memory[last]) {  // otherwise a trial of the same step
                memory[crossed] += norm(slip(flow)) * (flow.time - memory[last]);
                memory[last] = flow.time;
                // Round-off of the sum of steps must not make an eddy one step longer.
                const double age = flow.time - memory[began];
                if (age >= lifetime * (1 - 1e-9) || memory[crossed] >= size * (1 - 1e-9)) {
                  memory[eddies] += 1;
                  memory[began] = flow.time, memory[crossed] = 0;
                }
              }
              const Vec3 u = normal_numbers(number, static_cast<std::uint64_t>(flow.body),
                                            static_cast<std::uint64_t>(memory[eddies]));
              force.force += (force.drag_coefficient * rms) * u;
            };
          }};
}

}  // namespace seedflow
