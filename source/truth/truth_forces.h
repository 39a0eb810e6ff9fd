#pragma once

#include "seedflow/truth/truth_seed.h"

namespace seedflow {

/// Everything that acts on the seed at one instant except weight, added mass and the memory of the past.
struct TruthForces {
  Vec3 force;   ///< [N]
  Vec3 torque;  ///< [N m]
};

TruthForces truth_forces(const TruthSeed& seed, const TruthState& state, double time);

/// m plus the mass of fluid that is carried along [kg].
double truth_moving_mass(const TruthSeed& seed);

}  // namespace seedflow
