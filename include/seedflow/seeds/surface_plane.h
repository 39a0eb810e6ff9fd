#pragma once

#include <string>
#include <vector>

#include "seedflow/seeds/polygon_surface.h"
#include "seedflow/seeds/wall_point.h"

namespace seedflow {

/// An infinite plane. Seeds belong on the side its normal points to: distance = (x - point) . normal.
struct Plane {
  Vec3 point;            ///< any point of the plane [m]
  Vec3 normal{0, 0, 1};  ///< into the room of the seeds; unit vector after check()

  /// InputError if it is no plane; `name` is the wall's.
  void check(const std::string& name);
  void points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const;
  /// Not larger than the distance of any point that points_near() may give [m].
  double clearance(const Vec3& x) const { return dot(x - point, normal); }
};

/// A flat rectangle without thickness. It pushes to the side a sphere's centre is on.
struct Rectangle {
  Vec3 centre;
  Vec3 normal{0, 0, 1};
  Vec3 along{1, 0, 0};  ///< direction of the length; made exactly perpendicular to the normal by check()
  double length = 0, width = 0;  ///< [m]

  void check(const std::string& name);
  void points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const;
  double clearance(const Vec3& x) const;
};

}  // namespace seedflow
