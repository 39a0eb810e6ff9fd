#pragma once

#include <array>
#include <vector>

namespace seedflow {

inline constexpr double pi = 3.14159265358979323846;

/// Geometry of convex polygons in the parameters of a sliding surface.
using Corner = std::array<double, 2>;

inline double cross(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

inline double area_of(const std::vector<Corner>& polygon) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += cross(polygon[0], polygon[i - 1], polygon[i]);
  return sum / 2;
}

/// Counter-clockwise order of the corners of a quadrilateral numbered lexicographically.
inline constexpr int around[4] = {0, 1, 3, 2};

}  // namespace seedflow
