#pragma once

#include <string>
#include <vector>

#include "seedflow/seeds/polygon_surface.h"
#include "seedflow/seeds/wall_point.h"

namespace seedflow {

/// Six planes around the room of the seeds. Features 0 to 5: low x, high x, low y, ... high z.
struct Box {
  Vec3 low, high;  ///< corners [m]

  void check(const std::string& name);
  void points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const;
  double clearance(const Vec3& x) const;
};

}  // namespace seedflow
