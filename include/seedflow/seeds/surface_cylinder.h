#pragma once

#include <string>
#include <vector>

#include "seedflow/seeds/polygon_surface.h"
#include "seedflow/seeds/wall_point.h"

namespace seedflow {

/// A circular cylinder of finite length. With r the distance from the axis, z the height above the base:
///   inside   seeds are inside a tube: barrel distance R - r, caps z and L - z;
///   outside  seeds are outside a rod: capped, the exact distance to the solid, its rims included;
///   both     a thin tube that pushes to the side a sphere's centre is on.
/// An open end has a rim, where spheres touch the circle r = R.
/// Features: 0 barrel, 1 cap or rim at the base, 2 cap or rim at the other end, 3 and 4 rims of a thin capped
/// tube.
struct Cylinder {
  enum class Side { inside, outside, both };

  Vec3 base;           ///< centre of one end [m]
  Vec3 axis{0, 0, 1};  ///< towards the other end; unit vector after check()
  double radius = 0;   ///< R [m]
  double length = 0;   ///< L [m]
  Side side = Side::inside;
  bool base_cap = true, end_cap = true;

  /// InputError: no size, an outside cylinder with one cap only.
  void check(const std::string& name);
  void points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const;
  double clearance(const Vec3& x) const;
};

}  // namespace seedflow
