#include "seedflow/seeds/polygon_surface.h"

#include <cmath>

namespace seedflow {

int add_circle(PolygonSurface& polygons, const Vec3& centre, const Vec3& u, const Vec3& v, double radius,
               int corners) {
  const int first = static_cast<int>(polygons.vertex.size());
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners;
    polygons.add(centre + radius * std::cos(angle) * u + radius * std::sin(angle) * v);
  }
  return first;
}

void add_band(PolygonSurface& polygons, int first, int second, int corners) {
  for (int i = 0; i < corners; ++i) {
    const int j = (i + 1) % corners;
    polygons.polygon.push_back({first + i, first + j, second + j, second + i});
  }
}

void add_lid(PolygonSurface& polygons, int first, int corners) {
  std::vector<int> lid;
  for (int i = 0; i < corners; ++i) lid.push_back(first + i);
  polygons.polygon.push_back(lid);
}

}  // namespace seedflow
