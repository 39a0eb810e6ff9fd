#pragma once

#include "seedflow/seeds/polygon_surface.h"
#include "seedflow/seeds/walls.h"

namespace seedflow {

/// The polygons of a wall at a time, for pictures; circles have 48 corners (holes 24). What is infinite is
/// cut off at the box from `low` to `high` [m]. Nothing for an inactive wall.
PolygonSurface wall_polygons(const Wall& wall, double time, const Vec3& low, const Vec3& high);

/// A flat region between an outer polygon and polygons cut out of it, all convex and counter-clockwise, as
/// trapezoids. The inner ones must lie inside and apart from each other. Points are [m] in the plane.
std::vector<std::vector<std::array<double, 2>>> trapezoids(
    const std::vector<std::array<double, 2>>& outer,
    const std::vector<std::vector<std::array<double, 2>>>& inner);

}  // namespace seedflow
