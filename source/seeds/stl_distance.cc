#include "seedflow/seeds/stl_distance.h"

#include <cmath>
#include <limits>

namespace seedflow {

SurfaceDistance::SurfaceDistance(TriangleSurface s)
    : surface(std::move(s)), tree(surface), normals(surface) {}

double SurfaceDistance::operator()(const Vec3& x, Vec3& outward) const {
  double square = std::numeric_limits<double>::max();
  Vec3 point, pseudonormal;
  tree.nearer_than(x, square, [&](int triangle) {
    const auto& t = surface.triangle[triangle];
    const Vec3 corner[3] = {surface.vertex[t[0]], surface.vertex[t[1]], surface.vertex[t[2]]};
    const TrianglePoint near = nearest_on_triangle(corner, normals.face[triangle], x);
    if (!(near.square < square)) return;
    square = near.square;
    point = near.point;
    pseudonormal = normals.at(surface, triangle, near);
  });
  const double distance = std::sqrt(square);
  const Vec3 normal = pseudonormal / norm(pseudonormal);
  const double side = dot(x - point, normal) < 0 ? -1 : 1;
  // On the surface the direction to it is lost in round-off; the pseudonormal stands for it.
  const double size = norm(tree.high() - tree.low());
  outward = distance > 1e-12 * size ? side / distance * (x - point) : normal;
  return side * distance;
}

}  // namespace seedflow
