#pragma once

#include "seedflow/base/vector.h"
#include "seedflow/seeds/cache_line.h"

namespace seedflow {

/// A sub-sphere that stands in a contact list, as the contacts see it: one record, whatever store it lives
/// in, so that a pair costs four cache lines and another rank's sub-sphere is sent as it is.
struct ContactSphere {
  CacheLine motion;   ///< position [m], radius [m], velocity [m/s], mass m in m*: the seed's if rigid [kg]
  CacheLine turning;  ///< angular velocity [rad/s], least moment of inertia of its body [kg m2], lever [m]

  /// `lever`: from the centre about which its body turns (its own, or the rigid seed's) to its centre.
  void place(const Vec3& position, const Vec3& velocity, const Vec3& spin, const Vec3& lever) {
    motion[0] = position.x, motion[1] = position.y, motion[2] = position.z;
    motion[4] = velocity.x, motion[5] = velocity.y, motion[6] = velocity.z;
    turning[0] = spin.x, turning[1] = spin.y, turning[2] = spin.z;
    turning[4] = lever.x, turning[5] = lever.y, turning[6] = lever.z;
  }
  Vec3 position() const { return {motion[0], motion[1], motion[2]}; }
  Vec3 velocity() const { return {motion[4], motion[5], motion[6]}; }
  Vec3 spin() const { return {turning[0], turning[1], turning[2]}; }
  double radius() const { return motion[3]; }
};

/// What contacts do to one body (a bonded sub-sphere or a rigid seed): force [N] in 0 to 2, torque about its
/// centre [N m] in 4 to 6.
using ContactSum = CacheLine;

/// What one contact remembers: tangential spring [m] in 0 to 2, normal force at the last substep [N] in 3,
/// rolling angle [rad] in 4 to 6, whether a cohesive contact holds (1 or 0) in 7.
using ContactLine = CacheLine;

}  // namespace seedflow
