#pragma once

#include "seedflow/seeds/seed_store.h"

namespace seedflow {

/// One kick and one drift of velocity Verlet.
struct MotionStep {
  double kick = 0;    ///< h: time over which forces change velocities [s]
  double drift = 0;   ///< time over which velocities move positions [s]; 0: forces are kept
  bool half = false;  ///< which relaxation factor of LoadLanes belongs to h
  Vec3 gravity;       ///< [m/s2]
};

/// Largest speeds met so far, by lane.
struct FastestSpeeds {
  Lanes velocity = {};  ///< square of that of a bonded sub-sphere or a rigid seed's centre [m2/s2]
  Lanes turning = {};   ///< square of a rigid seed's spin times the arm of its outermost sub-sphere [m2/s2]
  /// No sub-sphere is faster [m/s].
  double bound() const;
};

/// Moves every sub-sphere of block b by itself under `forces`. After a drift forces and torques are set to
/// zero for the next summation.
void move_bonded(SeedStore& store, int b, ForceLanes* forces, const MotionStep& step, FastestSpeeds& fastest);

/// Moves the seeds of block b as rigid bodies under the forces and torques of contacts on them.
void move_rigid(SeedStore& store, int b, const ForceLanes& contacts, const MotionStep& step,
                FastestSpeeds& fastest);

/// The axes of the template in the lab frame and the spins of block b's rigid seeds.
struct RigidFrame {
  LaneVec3 x, y, z;
  LaneVec3 spin;  ///< [rad/s]
  RigidFrame(const BodyLanes& body, const Vec3& inertia);
};

}  // namespace seedflow
