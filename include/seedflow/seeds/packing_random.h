#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "seedflow/base/vector.h"

namespace seedflow {

/// Random numbers that are the same on every machine and standard library: std::mt19937_64 is fixed by the
/// C++ standard, the distributions of <random> are not, so the transforms are written out here.
class PortableRandom {
 public:
  /// Stream `stream` of the random number `seed`: two streams share nothing, and stream k needs no other
  /// before it.
  explicit PortableRandom(std::uint64_t seed, std::uint64_t stream = 0) : engine(mix(mix(seed) + stream)) {}

  /// Uniform in [0, 1) with 53 random bits.
  double uniform() { return static_cast<double>(engine() >> 11) * 0x1.0p-53; }

  /// Normal with mean 0 and standard deviation 1 (Marsaglia's polar method).
  double normal() {
    for (;;) {
      const double a = 2 * uniform() - 1, b = 2 * uniform() - 1, s = a * a + b * b;
      if (s > 0 && s < 1) return a * std::sqrt(-2 * std::log(s) / s);
    }
  }

  /// A point uniform in the box between two corners.
  Vec3 in_box(const Vec3& low, const Vec3& high) {
    Vec3 x;
    for (int d = 0; d < 3; ++d) x[d] = low[d] + (high[d] - low[d]) * uniform();
    return x;
  }

 private:
  /// The finaliser of SplitMix64 (Steele, Lea & Flood 2014, doi 10.1145/2660193.2660195).
  static std::uint64_t mix(std::uint64_t a) {
    a += 0x9e3779b97f4a7c15ull;
    a = (a ^ (a >> 30)) * 0xbf58476d1ce4e5b9ull;
    a = (a ^ (a >> 27)) * 0x94d049bb133111ebull;
    return a ^ (a >> 31);
  }
  std::mt19937_64 engine;
};

}  // namespace seedflow
