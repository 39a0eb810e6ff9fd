#pragma once

#include <cmath>

#include "seedflow/base/vector.h"

namespace seedflow {

/// Two unit vectors at right angles to the unit vector `axis` and to each other: (u, v, axis) is
/// right-handed. If `wish` has a part across the axis, u points along it.
struct Across {
  Vec3 u, v;
};

inline Across across(const Vec3& axis, const Vec3& wish = {}) {
  Vec3 u = wish - dot(wish, axis) * axis;
  if (!(norm(u) > 1e-9 * norm(wish)) || !(norm(u) > 0)) {
    const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
    const Vec3 other = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    u = other - dot(other, axis) * axis;
  }
  u /= norm(u);
  return {u, cross(axis, u)};
}

}  // namespace seedflow
