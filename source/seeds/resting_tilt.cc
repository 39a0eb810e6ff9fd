#include "seedflow/seeds/resting_tilt.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace seedflow {

namespace {

constexpr int n_directions = 72;  // downhill, around the vertical

/// Sub-spheres on the convex hull: those farthest out in some direction of a Fibonacci lattice. A face so
/// small that no direction finds one of its corners is missed; the seed would not stand on it for long.
std::vector<Vec3> outer_places(const SeedTemplate& seed) {
  constexpr int n_looks = 20000;
  const double turn = M_PI * (3 - std::sqrt(5.0));
  std::set<int> outer;
  for (int k = 0; k < n_looks; ++k) {
    const double z = 1 - (2 * k + 1.0) / n_looks, r = std::sqrt(1 - z * z);
    const Vec3 look{r * std::cos(turn * k), r * std::sin(turn * k), z};
    int farthest = 0;
    for (int i = 1; i < seed.n_spheres(); ++i)
      if (dot(seed.position[i], look) > dot(seed.position[farthest], look)) farthest = i;
    outer.insert(farthest);
  }
  std::vector<Vec3> places;
  for (const int i : outer) places.push_back(seed.position[i]);
  return places;
}

/// Tilt at which a seed tips whose centre is `height` above a face with these corners, averaged over
/// directions; negative if the foot of the centre is outside. Corners need no order: the distance to the edge
/// of their convex hull along a direction is the smallest distance of the lines through two corners that have
/// all others on one side.
double mean_tilt(const std::vector<Vec3>& corner, const Vec3& normal, const Vec3& foot, double height) {
  struct Edge {
    double distance;
    Vec3 outward;
  };
  std::vector<Edge> edges;
  double size = 0;
  for (const Vec3& c : corner) size = std::max(size, norm(c - foot));
  for (std::size_t i = 0; i < corner.size(); ++i)
    for (std::size_t j = 0; j < corner.size(); ++j) {
      const Vec3 along = corner[j] - corner[i];
      if (i == j || norm(along) < 1e-9 * size) continue;
      const Vec3 outward = (1 / norm(along)) * cross(along, normal);
      if (std::all_of(corner.begin(), corner.end(),
                      [&](const Vec3& c) { return dot(c - corner[i], outward) < 1e-9 * size; }))
        edges.push_back({dot(corner[i] - foot, outward), outward});
    }
  for (const Edge& edge : edges)
    if (edge.distance < 0) return -1;
  const Vec3 u = edges.front().outward, v = cross(normal, u);
  double sum = 0;
  for (int k = 0; k < n_directions; ++k) {
    const double angle = 2 * M_PI * (k + 0.5) / n_directions;
    const Vec3 downhill = std::cos(angle) * u + std::sin(angle) * v;
    double tilt = 0.5 * M_PI;
    for (const Edge& edge : edges)
      if (const double towards = dot(edge.outward, downhill); towards > 1e-9)
        tilt = std::min(tilt, std::atan(edge.distance / towards / height));
    sum += tilt;
  }
  return sum / n_directions;
}

}  // namespace

std::optional<RestingTilt> resting_tilt(const SeedTemplate& seed) {
  if (seed.n_spheres() < 4) return {};
  const double radius = seed.radius.front();
  for (const double r : seed.radius)
    if (std::abs(r - radius) > 1e-9 * radius) return {};
  const std::vector<Vec3> place = outer_places(seed);
  const int n = static_cast<int>(place.size());
  const double small = 1e-9 * seed.bounding_radius;

  RestingTilt tilt;
  std::set<std::vector<int>> faces;  // each by all of its corners
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k) {
        Vec3 normal = cross(place[j] - place[i], place[k] - place[i]);
        if (norm(normal) < small * seed.bounding_radius) continue;
        normal = (1 / norm(normal)) * normal;
        if (dot(normal, place[i]) < 0) normal = -1 * normal;
        const double out = dot(normal, place[i]);
        std::vector<int> corners;
        bool is_face = true;
        for (int l = 0; l < n && is_face; ++l) {
          const double beyond = dot(normal, place[l]) - out;
          is_face = beyond < small;
          if (beyond > -small) corners.push_back(l);
        }
        if (!is_face || !faces.insert(corners).second) continue;
        std::vector<Vec3> corner;
        for (const int l : corners) corner.push_back(place[l]);
        const double one = mean_tilt(corner, normal, out * normal, out + radius);
        if (one < 0) continue;
        tilt.smallest = tilt.n_faces == 0 ? one : std::min(tilt.smallest, one);
        tilt.largest = std::max(tilt.largest, one);
        sum += one, ++tilt.n_faces;
      }
  if (tilt.n_faces == 0) return {};
  tilt.mean = sum / tilt.n_faces;
  return tilt;
}

}  // namespace seedflow
