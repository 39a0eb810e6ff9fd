#include "seedflow/seeds/surface_plate.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/seeds/frame.h"

namespace seedflow {
namespace {

struct Flat {
  double s = 0, z = 0;
};
Flat operator-(const Flat& a, const Flat& b) {
  return {a.s - b.s, a.z - b.z};
}
double dot(const Flat& a, const Flat& b) {
  return a.s * b.s + a.z * b.z;
}

// The solid beside a hole in a half plane through the hole's axis: s is the distance from the axis, the
// solid lies at large s. Its boundary from the front face to the back face turns one way only (convex).
struct Profile {
  Flat corner[4];  // front edge, below the chamfer, back edge
  int n = 0;

  explicit Profile(const Plate& p) {
    const double a = p.hole_radius, half = 0.5 * p.thickness;
    corner[n++] = {a + p.chamfer_width, half};
    if (p.chamfer_depth > 0) corner[n++] = {a, half - p.chamfer_depth};
    corner[n++] = {a, -half};
  }

  struct Place {
    Flat point;       // of the boundary
    Flat outward;     // unit normal, used when the centre lies on the boundary or inside the solid
    double distance;  // signed, in the half plane
    bool front = false, back = false;
  };

  Place nearest(const Flat& x) const {
    Place best{{}, {}, 0};
    double least = 1e300, deepest = -1e300;
    bool inside = true;
    Place surface{{}, {}, 0};
    const auto part = [&](const Flat& a, const Flat& direction, double length, const Flat& outward,
                          bool front, bool back) {
      const double height = dot(x - a, outward);
      if (height > 0) inside = false;
      const double along = std::clamp(dot(x - a, direction), 0.0, length);
      const Flat point{a.s + along * direction.s, a.z + along * direction.z};
      const double square = dot(x - point, x - point);
      // The faces begin behind the hole's edge.
      if (square < least) least = square, best = {point, outward, 0, front && along > 0, back && along > 0};
      if (height > deepest)
        deepest = height,
        surface = {{x.s - height * outward.s, x.z - height * outward.z}, outward, height, front, back};
    };
    part(corner[0], {1, 0}, 1e300, {0, 1}, true, false);
    for (int i = 0; i + 1 < n; ++i) {
      const Flat d = corner[i + 1] - corner[i];
      const double length = std::sqrt(dot(d, d));
      part(corner[i], {d.s / length, d.z / length}, length, {d.z / length, -d.s / length}, false, false);
    }
    part(corner[n - 1], {1, 0}, 1e300, {0, -1}, false, true);
    if (inside) return surface;
    best.distance = std::sqrt(least);
    return best;
  }
};

int quarter(double angle) {
  return static_cast<int>(std::floor(angle / (0.5 * M_PI)) + 8) % 4;
}

double outside_of(const RectangleOutline& o, const PlatePoint& x, PlatePoint& nearest) {
  const double half[2] = {0.5 * o.length, 0.5 * o.width};
  const double out[2] = {std::abs(x[0]) - half[0], std::abs(x[1]) - half[1]};
  for (int d : {0, 1}) nearest[d] = std::clamp(x[d], -half[d], half[d]);
  if (out[0] > 0 || out[1] > 0) return std::hypot(std::max(out[0], 0.0), std::max(out[1], 0.0));
  const int side = out[0] > out[1] ? 0 : 1;
  nearest[side] = std::copysign(half[side], x[side]);
  return out[side];
}

double outside_of(const DiscOutline& o, const PlatePoint& x, PlatePoint& nearest) {
  const double r = std::hypot(x[0], x[1]);
  nearest = r > 0 ? PlatePoint{x[0] / r * o.radius, x[1] / r * o.radius} : PlatePoint{o.radius, 0};
  return r - o.radius;
}

double outline_distance(const Plate& p, const PlatePoint& x, PlatePoint& nearest) {
  return std::visit([&](const auto& o) { return outside_of(o, x, nearest); }, p.outline);
}

}  // namespace

double Plate::outside(const PlatePoint& x) const {
  PlatePoint nearest;
  return outline_distance(*this, x, nearest);
}

Vec3 Plate::to_plate(const Vec3& x) const {
  const Vec3 d = x - centre;
  return {seedflow::dot(d, along), seedflow::dot(d, cross(normal, along)), seedflow::dot(d, normal)};
}

Vec3 Plate::hole_position(int hole) const {
  const PlatePoint h = hole_centre(holes, hole);
  return centre + h[0] * along + h[1] * cross(normal, along);
}

void Plate::points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const {
  const Vec3 own = to_plate(x), side = cross(normal, along);
  const double half = 0.5 * thickness;
  if (std::abs(own.z) - half >= reach) return;
  const auto add = [&](const Vec3& n, double distance, int feature) {
    if (distance < reach) out.push_back({n.x * along + n.y * side + n.z * normal, distance, feature, {}});
  };

  PlatePoint rim;
  const double beyond = outline_distance(*this, {own.x, own.y}, rim);
  if (beyond > 0) {
    const Vec3 d = own - Vec3{rim[0], rim[1], std::clamp(own.z, -half, half)};
    const double distance = norm(d);
    return add(d / distance, distance, 2);
  }

  const double above = std::abs(own.z) - half;
  const int hole = nearest_hole(holes, {own.x, own.y});
  if (hole < 0) {
    if (above <= 0 && beyond > above) {  // inside the solid, the rim is nearer than the faces
      const double r = std::hypot(own.x - rim[0], own.y - rim[1]);
      if (r > 0) return add({(rim[0] - own.x) / r, (rim[1] - own.y) / r, 0}, beyond, 2);
    }
    return add({0, 0, own.z < 0 ? -1.0 : 1.0}, above, own.z < 0 ? 1 : 0);
  }

  const PlatePoint axis = hole_centre(holes, hole);
  const double du = own.x - axis[0], dv = own.y - axis[1], rho = std::hypot(du, dv);
  const double angle = std::atan2(dv, du), c = rho > 0 ? du / rho : 1, s = rho > 0 ? dv / rho : 0;
  const Profile profile(*this);
  const Profile::Place near = profile.nearest({rho, own.z});
  if (near.distance <= 0 && beyond > near.distance) {
    const double r = std::hypot(own.x - rim[0], own.y - rim[1]);
    if (r > 0) return add({(rim[0] - own.x) / r, (rim[1] - own.y) / r, 0}, beyond, 2);
  }
  Flat n = near.outward;
  if (near.distance > 0) n = {(rho - near.point.s) / near.distance, (own.z - near.point.z) / near.distance};
  const int feature = near.front ? 0 : near.back ? 1 : 3 + 4 * hole + quarter(angle);
  add({n.s * c, n.s * s, n.z}, near.distance, feature);
  if (near.distance <= 0 || near.front || near.back || rho >= hole_radius + chamfer_width) return;

  // The other three places of a sphere that sits in the hole. In the half plane k quarters on, the centre
  // projects to rho cos(k pi/2) and stands off by rho sin(k pi/2).
  for (int k = 1; k < 4; ++k) {
    const double ck = k == 1 ? -s : k == 2 ? -c : s, sk = k == 1 ? c : k == 2 ? -s : -c;
    const double project = k == 2 ? -rho : 0;
    const Flat point = profile.nearest({project, own.z}).point;
    const Vec3 d{du - point.s * ck, dv - point.s * sk, own.z - point.z};
    const double distance = norm(d);
    if (distance > 0) add(d / distance, distance, 3 + 4 * hole + (quarter(angle) + k) % 4);
  }
}

double Plate::clearance(const Vec3& x) const {
  const Vec3 own = to_plate(x);
  const double beyond = outside({own.x, own.y}), above = std::abs(own.z) - 0.5 * thickness;
  if (beyond > 0 && above > 0) return std::hypot(beyond, above);
  return std::max(beyond, above);
}

}  // namespace seedflow
