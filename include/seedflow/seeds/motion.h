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

/// Moves every sub-sphere of block b by itself under `forces`. After a drift forces and torques are set to
/// zero for the next summation. Returns the largest square of a sub-sphere's speed [m2/s2].
double move_bonded(SeedStore& store, int b, ForceLanes* forces, const MotionStep& step);

/// Moves the seeds of block b as rigid bodies and carries their sub-spheres along. `forces` may be none.
double move_rigid(SeedStore& store, int b, ForceLanes* forces, const MotionStep& step);

/// Sets the sub-spheres of block b from the bodies.
void place_spheres(SeedStore& store, int b);

}  // namespace seedflow
