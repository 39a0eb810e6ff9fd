#include "seedflow/seeds/caliper.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seedflow {
namespace {

template <typename Width>
Caliper over_directions(int n, const Width& width) {
  Caliper c;
  c.smallest = std::numeric_limits<double>::max();
  for (const Vec3& direction : even_directions(n)) {
    const double w = width(direction);
    c.mean += w / n;
    c.smallest = std::min(c.smallest, w);
    c.largest = std::max(c.largest, w);
  }
  return c;
}

}  // namespace

std::vector<Vec3> even_directions(int n) {
  const double golden_angle = M_PI * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions(n);
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, s = std::sqrt(1 - z * z);
    directions[i] = {s * std::cos(golden_angle * i), s * std::sin(golden_angle * i), z};
  }
  return directions;
}

Caliper caliper(const SeedTemplate& seed, int n_directions) {
  return over_directions(n_directions, [&](const Vec3& n) {
    double low = std::numeric_limits<double>::max(), high = -low;
    for (int i = 0; i < seed.n_spheres(); ++i) {
      const double s = dot(n, seed.position[i]);
      low = std::min(low, s - seed.radius[i]);
      high = std::max(high, s + seed.radius[i]);
    }
    return high - low;
  });
}

Caliper caliper(const Shape& shape, int n_directions) {
  return over_directions(n_directions, [&](const Vec3& n) { return shape.support(n) + shape.support(-n); });
}

SurfaceRoughness surface_roughness(const SeedTemplate& seed, const Shape& shape, int n_directions) {
  // In the shape's own axes, from its centre.
  std::vector<Vec3> centre(seed.n_spheres());
  SurfaceRoughness result;
  for (int i = 0; i < seed.n_spheres(); ++i) {
    centre[i] = rotate_back(seed.seed_frame, seed.position[i] - seed.seed_centre);
    result.bs += 2 * seed.radius[i] / seed.n_spheres();
  }
  result.bs /= std::cbrt(6 * shape.volume / M_PI);

  const double layer = 2 * *std::max_element(seed.radius.begin(), seed.radius.end());
  std::vector<double> depth;
  for (const Vec3& n : even_directions(n_directions)) {
    double reach = -1;
    for (int i = 0; i < seed.n_spheres(); ++i) {
      const double along = dot(n, centre[i]);
      const double half_chord = seed.radius[i] * seed.radius[i] - norm_square(centre[i] - along * n);
      if (half_chord > 0) reach = std::max(reach, along + std::sqrt(half_chord));
    }
    if (reach <= 0) continue;
    Vec3 outward;
    const double below = -shape.signed_distance(reach * n, outward);
    if (below <= layer) depth.push_back(below);
  }
  if (depth.empty()) return result;
  result.covered = static_cast<double>(depth.size()) / n_directions;
  for (const double d : depth) result.mean_depth += d / depth.size();
  for (const double d : depth) result.rms += std::pow(d - result.mean_depth, 2) / depth.size();
  result.rms = std::sqrt(result.rms);
  return result;
}

SurfaceRoughness surface_roughness(const SeedTemplate& seed, int n_directions) {
  return surface_roughness(seed, ellipsoid_shape(seed.seed_semi_axes), n_directions);
}

}  // namespace seedflow
