#include "seedflow/seeds/walls.h"

#include <algorithm>
#include <cmath>

namespace seedflow {

Wall::Wall(std::string name, Surface surface, int material, WallMotion motion)
    : name(std::move(name)), surface(std::move(surface)), motion(std::move(motion)), material(material) {}

Wall::Wall(std::string name, const Vec3& point, const Vec3& normal, const Vec3& velocity, int material)
    : name(std::move(name)),
      surface(Plane{point, normal}),
      motion(WallMotion::constant(velocity)),
      material(material) {}

void Wall::check() {
  std::visit([&](auto& s) { s.check(name); }, surface);
  motion.check(name);
}

Placement placement(const Wall& wall, double time) {
  return placement(wall.motion, time);
}

void contacts_near(const Wall& wall, const Placement& place, const Vec3& x, double reach,
                   std::vector<WallPoint>& out) {
  if (!wall.active) return;
  const std::size_t first = out.size();
  const bool turned = norm_square(place.turn.v) > 0;  // most walls are not
  const Vec3 own = turned ? place.to_wall(x) : place.pivot + (x - place.shift - place.pivot);
  std::visit([&](const auto& s) { s.points_near(own, reach, out); }, wall.surface);
  for (std::size_t i = first; i < out.size(); ++i) {
    if (turned) out[i].normal = rotate(place.turn, out[i].normal);
    out[i].velocity = place.velocity_at(x - out[i].distance * out[i].normal);
  }
}

void contacts_near(const Wall& wall, const Vec3& x, double reach, double time, std::vector<WallPoint>& out) {
  contacts_near(wall, placement(wall, time), x, reach, out);
}

bool may_touch(const Wall& wall, const Placement& place, const Vec3& centre, double radius) {
  if (!wall.active) return false;
  const Vec3 own = place.to_wall(centre);
  return std::visit([&](const auto& s) { return s.clearance(own) < radius; }, wall.surface);
}

bool may_touch(const Wall& wall, const Vec3& centre, double radius, double time) {
  return may_touch(wall, placement(wall, time), centre, radius);
}

namespace {

// Whether turning about this axis leaves the surface where it is.
bool is_turned_into_itself(const Plane& s, const Vec3&, const Vec3& axis) {
  return norm(cross(s.normal, axis)) < 1e-12;
}
template <class Other>
bool is_turned_into_itself(const Other&, const Vec3&, const Vec3&) {
  return false;
}
bool is_turned_into_itself(const Plate& s, const Vec3& pivot, const Vec3& axis) {
  return n_holes(s.holes) == 0 && std::holds_alternative<DiscOutline>(s.outline) &&
         norm(cross(s.normal, axis)) < 1e-12 && norm(cross(pivot - s.centre, axis)) < 1e-12 * s.thickness;
}
bool is_turned_into_itself(const Cylinder& s, const Vec3& pivot, const Vec3& axis) {
  return norm(cross(s.axis, axis)) < 1e-12 && norm(cross(pivot - s.base, axis)) < 1e-12 * s.radius;
}

}  // namespace

double largest_speed(const Wall& wall, double time, const Vec3& low, const Vec3& high) {
  if (!wall.active) return 0;
  const Placement place = placement(wall, time);
  double speed = norm(place.velocity);
  const bool still =
      std::visit([&](const auto& s) { return is_turned_into_itself(s, wall.motion.pivot, wall.motion.axis); },
                 wall.surface);
  if (norm(place.spin) > 0 && !still) {
    double farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 x{corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z};
      farthest = std::max(farthest, norm(cross(place.spin, x - place.pivot - place.shift)));
    }
    speed += farthest;
  }
  return speed;
}

}  // namespace seedflow
