#pragma once

#include <vector>

#include "seedflow/base/vector.h"

namespace seedflow {

/// A surface to look at: polygons (numbers of their corners) over a list of points [m].
struct PolygonSurface {
  std::vector<Vec3> vertex;
  std::vector<std::vector<int>> polygon;

  int add(const Vec3& x) { return vertex.push_back(x), static_cast<int>(vertex.size()) - 1; }
};

/// Corners of the circle of this radius around `centre` in the plane of u and v (unit vectors). Returns the
/// first.
int add_circle(PolygonSurface& polygons, const Vec3& centre, const Vec3& u, const Vec3& v, double radius,
               int corners);
/// Quadrilaterals between two rings of corners that begin at `first` and `second`.
void add_band(PolygonSurface& polygons, int first, int second, int corners);
/// One polygon over a ring of corners.
void add_lid(PolygonSurface& polygons, int first, int corners);

}  // namespace seedflow
