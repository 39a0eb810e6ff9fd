#pragma once

#include <iosfwd>

#include "seedflow/base/vector.h"

namespace seedflow {

/// Books every impulse [N s] of a run, so that nothing can be gained or lost unseen:
///   seeds:  change of momentum = gravity + buoyancy + walls + from the air + from still air outside the mesh
///   air:    change of momentum = sides + from the seeds
///   and     from the air + from the seeds + still on the way = 0.
/// "On the way" is the remainder of the last step: what the seeds received and the air will receive in the
/// next one. The air's change is that of its time scheme, summed over the steps.
class MomentumLedger {
 public:
  struct Entries {
    Vec3 seeds_change, gravity, buoyancy, walls, from_air;  ///< the seeds
    Vec3 air_change, sides, from_seeds;                     ///< the air
    Vec3 on_the_way;
    Vec3 still_air;  ///< to the seeds outside the mesh
  };
  Entries sum;

  /// Adds the absolute size of one step's exchange, the scale of all errors.
  void add_scale(double impulse) { scale += impulse; }

  double seeds_error() const;     ///< balance of the seeds alone, relative to the scale
  double air_error() const;       ///< balance of the air alone
  double exchange_error() const;  ///< between the two
  double total_error() const;     ///< seeds + air + walls

  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  double relative(const Vec3& imbalance) const;
  double scale = 0;
};

}  // namespace seedflow
