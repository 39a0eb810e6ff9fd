#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/seeds/stl.h"
#include "seedflow/seeds/stl_distance.h"

namespace seedflow {
namespace {

/// Centre and radius of the largest sphere inside: the best of a grid, then a pattern search around it.
void find_deepest(Shape& shape) {
  const auto depth = [&](const Vec3& x) {
    Vec3 outward;
    return -shape.signed_distance(x, outward);
  };
  const int n = 12;
  const Vec3 step = (shape.high - shape.low) / n;
  shape.inscribed_radius = 0;
  const auto offer = [&](const Vec3& x) {
    const double d = depth(x);
    if (d <= shape.inscribed_radius) return false;
    shape.deepest = x;
    shape.inscribed_radius = d;
    return true;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        offer(shape.low + Vec3{(i + 0.5) * step.x, (j + 0.5) * step.y, (k + 0.5) * step.z});
  offer({});
  for (double size = norm(step); size > 1e-10 * norm(shape.high - shape.low);) {
    bool better = false;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          better = offer(shape.deepest + size * Vec3{double(i), double(j), double(k)}) || better;
    if (!better) size *= 0.5;
  }
}

}  // namespace

Shape surface_shape(const TriangleSurface& surface, double diameter) {
  if (!(diameter > 0) || !std::isfinite(diameter)) {
    std::ostringstream message;
    message << "Shape of a triangulated surface: the diameter " << diameter << " m must be positive.";
    throw InputError(message.str());
  }
  const SurfaceMoments m = moments(surface);
  Eigen::Matrix3d tensor;
  tensor << m.square.x, m.mixed.x, m.mixed.y, m.mixed.x, m.square.y, m.mixed.z, m.mixed.y, m.mixed.z,
      m.square.z;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse();  // longest first
  if (axes.determinant() < 0) axes.col(2) *= -1;

  Shape shape;
  shape.volume = M_PI / 6 * diameter * diameter * diameter;
  const double scale = std::cbrt(shape.volume / m.volume);
  TriangleSurface placed = surface;
  const double big = std::numeric_limits<double>::max();
  shape.low = {big, big, big};
  shape.high = -shape.low;
  for (Vec3& x : placed.vertex) {
    const Vec3 from = scale * (x - m.centroid);
    for (int d = 0; d < 3; ++d) x[d] = dot(from, {axes(0, d), axes(1, d), axes(2, d)});
    for (int d = 0; d < 3; ++d) {
      shape.low[d] = std::min(shape.low[d], x[d]);
      shape.high[d] = std::max(shape.high[d], x[d]);
    }
  }
  for (int d = 0; d < 3; ++d) shape.second_moment[d] = scale * scale * solver.eigenvalues()[2 - d];
  const Vec3& s = shape.second_moment;
  const double longest = std::sqrt(s.x), middle = std::sqrt(s.y), shortest = std::sqrt(s.z);
  shape.semi_axes = 0.5 * diameter / std::cbrt(longest * middle * shortest) * Vec3{longest, middle, shortest};
  shape.support = [corner = placed.vertex](const Vec3& n) {
    double reach = -std::numeric_limits<double>::max();
    for (const Vec3& x : corner) reach = std::max(reach, dot(n, x));
    return reach;
  };
  const auto distance = std::make_shared<const SurfaceDistance>(std::move(placed));
  shape.signed_distance = [distance](const Vec3& x, Vec3& outward) { return (*distance)(x, outward); };
  find_deepest(shape);
  return shape;
}

}  // namespace seedflow
