#pragma once

#include <string>
#include <variant>
#include <vector>

#include "seedflow/seeds/hole_pattern.h"
#include "seedflow/seeds/polygon_surface.h"
#include "seedflow/seeds/wall_point.h"

namespace seedflow {

struct RectangleOutline {
  double length = 0, width = 0;  ///< along the plate's first and second direction [m]
};
struct DiscOutline {
  double radius = 0;  ///< [m]
};

/// A plate or disc of finite thickness, with or without circular holes (sieve, suction disc).
///
/// Coordinates of the plate: u `along`, v = normal x along, z along the normal from the middle plane. The
/// solid is the outline times [-t/2, t/2] less the holes. A hole has radius a; with a chamfer it widens by
/// `chamfer_width` over `chamfer_depth` towards the front (the side of the normal).
///
/// Distances are exact to faces, holes, chamfers and their circular edges: in the half plane through the axis
/// of the nearest hole the solid is a convex polygon. Away from the axis of a hole a sphere touches its edge
/// where it is nearest. A sphere larger than the hole that sits in it touches all around, and there the
/// nearest place loses its meaning: four places, the nearest one and those 90, 180 and 270 degrees on, carry
/// it; they act only if they are within the sphere, too, and make the force continuous at the axis.
/// Features: 0 front, 1 back, 2 outer rim, 3 + 4 hole + quarter of the circle.
struct Plate {
  Vec3 centre;                           ///< of the middle plane [m]
  Vec3 normal{0, 0, 1}, along{1, 0, 0};  ///< made orthonormal by check()
  double thickness = 0;                  ///< t [m]
  std::variant<RectangleOutline, DiscOutline> outline;
  HolePattern holes;
  double hole_radius = 0;                       ///< a [m]
  double chamfer_width = 0, chamfer_depth = 0;  ///< [m]

  /// InputError: no thickness, a hole larger than the plate, outside it (pitch radius outside the disc) or
  /// overlapping another one (chamfers included), a chamfer deeper than the plate.
  void check(const std::string& name);
  void points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const;
  double clearance(const Vec3& x) const;

  /// (u, v, z) of a point.
  Vec3 to_plate(const Vec3& x) const;
  /// Centre of a hole in the middle plane.
  Vec3 hole_position(int hole) const;
  /// Distance to the outline in the plate's plane, negative inside [m].
  double outside(const PlatePoint& x) const;
};

}  // namespace seedflow
