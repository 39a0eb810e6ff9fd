#include "seedflow/seeds/surface_plane.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/seeds/frame.h"

namespace seedflow {

void Plane::check(const std::string& name) {
  const double size = norm(normal);
  if (!(size > 0) || !std::isfinite(size))
    throw InputError("Wall '" + name + "': the normal is zero. Give the direction into the domain.");
  normal /= size;
}

void Plane::points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const {
  const double distance = clearance(x);
  if (distance < reach) out.push_back({normal, distance, 0, {}});
}

void Rectangle::check(const std::string& name) {
  const double size = norm(normal);
  if (!(size > 0) || !std::isfinite(size))
    throw InputError("Wall '" + name + "': the normal is zero. Give the direction across the rectangle.");
  normal /= size;
  if (!(length > 0 && width > 0))
    throw InputError("Wall '" + name + "': a rectangle needs a length and a width above 0 m; they are " +
                     std::to_string(length) + " m and " + std::to_string(width) + " m.");
  if (!(norm(cross(along, normal)) > 1e-6 * norm(along)))
    throw InputError(
        "Wall '" + name +
        "': the direction of the length is zero or parallel to the normal. Give one that lies in "
        "the rectangle.");
  along = across(normal, along).u;
}

namespace {
Vec3 nearest_point(const Rectangle& r, const Vec3& x) {
  const Vec3 d = x - r.centre, side = cross(r.normal, r.along);
  const double a = std::clamp(dot(d, r.along), -0.5 * r.length, 0.5 * r.length),
               b = std::clamp(dot(d, side), -0.5 * r.width, 0.5 * r.width);
  return r.centre + a * r.along + b * side;
}
}  // namespace

void Rectangle::points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const {
  const Vec3 d = x - nearest_point(*this, x);
  const double distance = norm(d);
  if (distance < reach) out.push_back({distance > 0 ? d / distance : normal, distance, 0, {}});
}

double Rectangle::clearance(const Vec3& x) const {
  return norm(x - nearest_point(*this, x));
}

}  // namespace seedflow
