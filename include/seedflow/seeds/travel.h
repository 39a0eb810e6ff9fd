#pragma once

#include <algorithm>
#include <vector>

#include "seedflow/seeds/seed_share.h"

namespace seedflow {

/// How far the seeds have come since the contact lists were made.
///
/// Cheap bound first: the largest speed times the step, summed. When this reaches the skin, the displacements
/// of all own seeds are measured, and the sum of the two largest takes its place.
class Travel {
 public:
  /// The lists hold all pairs with gaps below the skin at the present positions.
  void begin(const std::vector<SeedStore>& stores, const SeedShare& share, double skin);
  /// The seeds have moved with at most `speed` and the walls with at most `wall_speed` for a step. True when
  /// a pair that is not listed may touch. All ranks give the same answer.
  bool exceeds(const std::vector<SeedStore>& stores, const SeedShare& share, double speed, double wall_speed,
               double step);
  /// How far the two fastest seeds, or a seed and a wall, may have approached each other since begin() [m].
  double way(const std::vector<SeedStore>& stores, const SeedShare& share);
  std::size_t bytes() const;

 private:
  double bound() const { return std::max(of_pair, of_seed + of_walls); }
  struct Reference {
    std::vector<LaneVec3> sphere;  ///< of bonded seeds [own block * n_spheres + sub-sphere]
    std::vector<LaneVec3> centre;  ///< of rigid seeds [own block]
    std::vector<LaneQuaternion> orientation;
  };
  std::vector<double> two_longest(const std::vector<SeedStore>& stores, const SeedShare& share) const;

  std::vector<Reference> reference;  ///< [store]
  double reach = 0;
  double of_pair = 0, of_seed = 0, of_walls = 0;  ///< bounds of the way [m]
};

}  // namespace seedflow
