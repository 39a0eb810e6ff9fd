#pragma once

#include <optional>

#include "seedflow/seeds/seed_template.h"

namespace seedflow {

/// How steep a plane must be before a rigid seed that stands on it with its outermost sub-spheres tips over
/// an edge of what it stands on, if it cannot slide: tan(tilt) = distance of the edge from the foot of the
/// centre of mass / height of the centre of mass. A sphere tips at 0; a clump of few sub-spheres stands
/// firmly, which acts like a coefficient of rolling friction tan(tilt) on top of that of the contacts.
struct RestingTilt {
  double mean = 0;      ///< over all faces it can stand on and all downhill directions [rad]
  double smallest = 0;  ///< of a face, averaged over directions [rad]
  double largest = 0;
  int n_faces = 0;  ///< on which it can stand
};

/// For sub-spheres of one size (their centres' convex hull has the faces); nothing otherwise, and nothing for
/// less than four sub-spheres or flat seeds. Takes milliseconds.
std::optional<RestingTilt> resting_tilt(const SeedTemplate& seed);

}  // namespace seedflow
