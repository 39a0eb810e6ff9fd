#pragma once

#include <algorithm>
#include <vector>

#include "seedflow/seeds/seed_share.h"

namespace seedflow {

/// How far the seeds have come since the contact lists were made.
///
/// Cheap bound first: the largest speed times the step, summed. When this reaches the skin, the displacements
/// of all own seeds are measured, and the sum of the two largest takes its place.
///
/// The speeds of the other ranks may come one substep late. Until then it is foreseen that no seed moves more
/// than three times as far as in the substep before (from rest under a constant force it is three times), or
/// than 1/32 of the skin: only when this may reach the skin the ranks have to wait for each other's speeds.
class Travel {
 public:
  /// The lists hold all pairs with gaps below the skin at the present positions.
  void begin(const std::vector<SeedStore>& stores, const SeedShare& share, double skin);
  /// No seed has moved farther in one substep [m].
  void add(double way) { of_pair += 2 * way, of_seed += way, last = way; }
  void add_of_walls(double way) { of_walls += way; }
  /// A pair that is not listed might touch after a substep that has not been added yet.
  bool may_exceed() const { return bound() + std::max(6 * last, reach / 16) > reach; }
  /// A pair that is not listed may touch soon. All ranks give the same answer.
  bool exceeds(const std::vector<SeedStore>& stores, const SeedShare& share) {
    return bound() >= reach && way(stores, share) > 0.75 * reach;
  }
  /// A pair that is not listed may have touched: what was foreseen was wrong.
  bool exceeded(const std::vector<SeedStore>& stores, const SeedShare& share) {
    return bound() > reach && way(stores, share) > reach;
  }
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
  double last = 0;                                ///< way of a seed in the last substep [m]
};

}  // namespace seedflow
