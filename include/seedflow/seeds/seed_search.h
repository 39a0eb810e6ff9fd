#pragma once

#include <vector>

#include "seedflow/seeds/numbering.h"

namespace seedflow {

struct Ball {
  Vec3 centre;        ///< [m]
  double radius = 0;  ///< [m]
};

/// Where the seeds are at the instant of a search: a ball around every seed, and, for those seeds that were
/// taken, all their sub-spheres, by their numbers.
struct SeedCloud {
  Numbering numbering;
  std::vector<double> x, y, z;  ///< [sub-sphere], and a few zeros behind [m]
  std::vector<Ball> ball;       ///< [seed]

  explicit SeedCloud(const std::vector<SeedStore>& stores);
  /// Takes the positions of a seed's sub-spheres, if that has not been done.
  void take(const std::vector<SeedStore>& stores, int seed);
  int first_sphere(const SeedStore& store, int t, int slot) const {
    return numbering.first_sphere[t] + slot * store.n_spheres();
  }
  Vec3 position(int sphere) const { return {x[sphere], y[sphere], z[sphere]}; }

 private:
  std::vector<char> taken;  ///< [seed]
};

struct SpherePair {
  int first, second;  ///< first < second
};
struct FoundPairs {
  std::vector<SpherePair> pair;  ///< sorted
  std::vector<char> close;       ///< [pair] nearer than the inner gap
  std::vector<int> begin;  ///< [seed] its first pair, of those whose first sub-sphere it owns; and the end
};

/// All pairs of sub-spheres of different seeds whose surfaces are nearer than the gap, of which at least one
/// belongs to a seed marked in `own`. Seeds are compared first, in linked cells of the size of the largest;
/// of two seeds whose balls come close, which are taken, only the sub-spheres in reach of the other's ball.
FoundPairs pairs_within(const std::vector<SeedStore>& stores, SeedCloud& cloud, double gap, double inner_gap,
                        const std::vector<char>& own);

}  // namespace seedflow
