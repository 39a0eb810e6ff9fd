#pragma once

#include <vector>

#include "seedflow/seeds/lane_vector.h"
#include "seedflow/seeds/seed_template.h"

namespace seedflow {

/// The state of one sub-sphere of lane_width seeds (lab frame, SI units).
struct SphereLanes {
  LaneVec3 position;           ///< [m]
  LaneQuaternion orientation;  ///< template frame to lab frame
  LaneVec3 velocity;           ///< [m/s]
  LaneVec3 angular_velocity;   ///< [rad/s]
  LaneVec3 force;              ///< of bonds and contacts at the present positions [N]
  LaneVec3 torque;             ///< of bonds and contacts [N m]
};

/// What acts on one sub-sphere from outside: force + drag (flow - velocity) - added_mass d velocity/dt.
struct LoadLanes {
  LaneVec3 force;           ///< [N]
  LaneVec3 torque;          ///< [N m]
  LaneVec3 flow;            ///< flow velocity [m/s]
  Lanes drag = {};          ///< [kg/s]
  Lanes added_mass = {};    ///< [kg]
  Lanes relaxed_half = {};  ///< (1 - exp(-z))/z with z = drag h/(mass + added mass) and h half a substep
  Lanes relaxed_full = {};  ///< the same for a whole substep
  LaneVec3 impulse;         ///< received through drag and added mass since advance() began [N s]
};

/// A rigid seed in each lane.
struct BodyLanes {
  LaneVec3 position;  ///< centre of mass [m]
  LaneQuaternion orientation;
  LaneVec3 velocity;          ///< [m/s]
  LaneVec3 angular_momentum;  ///< lab frame [kg m2/s]
};

/// All seeds of one template. Lane = seed: lane_width seeds make a block, and the sub-spheres of a block
/// stand one after the other, [block][sub-sphere][component][lane], so that one bond of the template is the
/// same pair of addresses for all seeds of the block. Empty lanes of the last block rest in the template's
/// reference position.
struct SeedStore {
  SeedTemplate model;
  int material = 0;
  bool rigid = false;
  std::vector<int> seed;            ///< [slot] global seed number; slot = block * lane_width + lane
  std::vector<Lanes> occupied;      ///< [block] 1 where the lane holds a seed, else 0
  std::vector<SphereLanes> sphere;  ///< [block * n_spheres + sub-sphere]
  std::vector<LoadLanes> load;      ///< as sphere; empty while nothing acts from outside
  std::vector<BodyLanes> body;      ///< [block], rigid seeds only

  int n_blocks() const { return static_cast<int>(occupied.size()); }
  int n_spheres() const { return model.n_spheres(); }
  SphereLanes* block(int b) { return sphere.data() + static_cast<std::size_t>(b) * n_spheres(); }
  const SphereLanes* block(int b) const { return sphere.data() + static_cast<std::size_t>(b) * n_spheres(); }
  LoadLanes* loads(int b) {
    return load.empty() ? nullptr : load.data() + static_cast<std::size_t>(b) * n_spheres();
  }

  /// Puts a seed into the next free lane and returns its slot.
  int add(int seed_number, const Vec3& centre, const Quaternion& orientation, const Vec3& velocity,
          const Vec3& spin);
  std::size_t bytes() const;
};

}  // namespace seedflow
