#pragma once

#include "seedflow/base/vector.h"
#include "seedflow/seeds/cache_line.h"

namespace seedflow {

/// Where a sub-sphere that stands in a contact list is: centre [m] in 0 to 2, radius [m] in 3. All that the
/// test for touching needs.
using ContactSphere = HalfLine;

/// How the body moves that a sub-sphere belongs to (a bonded sub-sphere itself or a rigid seed): velocity of
/// its centre of mass [m/s] in 0 to 2, mass m in m* [kg] in 3, angular velocity [rad/s] in 4 to 6, least
/// moment of inertia [kg m2] in 7.
using ContactMotion = CacheLine;

/// What contacts do to one body: force [N] in 0 to 2, torque about its centre [N m] in 4 to 6.
using ContactSum = CacheLine;

inline Vec3 centre_of(const ContactSphere& s) {
  return {s[0], s[1], s[2]};
}
inline double radius_of(const ContactSphere& s) {
  return s[3];
}

}  // namespace seedflow
