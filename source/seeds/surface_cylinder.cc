#include "seedflow/seeds/surface_cylinder.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/seeds/frame.h"

namespace seedflow {
namespace {

// x in cylinder coordinates; `radial` is the unit vector away from the axis.
struct Polar {
  double r, z;
  Vec3 radial;
};

Polar polar(const Cylinder& c, const Vec3& x) {
  const Vec3 d = x - c.base;
  const double z = dot(d, c.axis);
  const Vec3 across_axis = d - z * c.axis;
  const double r = norm(across_axis);
  return {r, z, r > 0 ? across_axis / r : across(c.axis).u};
}

// Distance and normal of one part of the surface in the half plane (r, z).
struct Part {
  double distance, normal_r, normal_z;
  int feature;
};

// From the point (r, z) of the surface to the centre.
Part from_point(const Polar& p, double r, double z, int feature) {
  const double dr = p.r - r, dz = p.z - z, distance = std::hypot(dr, dz);
  if (!(distance > 0)) return {0, 1, 0, feature};
  return {distance, dr / distance, dz / distance, feature};
}

// Signed distance to a solid rod: one place.
int rod(const Cylinder& c, const Polar& p, Part* parts) {
  const double out_r = p.r - c.radius, low = -p.z, high = p.z - c.length;
  const int end = low > high ? 1 : 2;
  const double out_z = std::max(low, high), sign = low > high ? -1 : 1;
  if (out_r > 0 && out_z > 0)
    parts[0] = from_point(p, c.radius, end == 1 ? 0 : c.length, end);
  else if (out_r >= out_z)
    parts[0] = {out_r, 1, 0, 0};
  else
    parts[0] = {out_z, 0, sign, end};
  return 1;
}

int tube(const Cylinder& c, const Polar& p, Part* parts) {
  int n = 0;
  const bool thin = c.side == Cylinder::Side::both;
  const bool below = p.z<0, above = p.z> c.length, outside = p.r > c.radius;
  // Barrel, or the rim of an open end. A one-sided capped end: beyond it the cap pushes back, and the barrel
  // goes on.
  if ((below && !c.base_cap) || (above && !c.end_cap)) {
    parts[n++] = from_point(p, c.radius, below ? 0 : c.length, below ? 1 : 2);
  } else if (c.side == Cylinder::Side::outside) {
    parts[n++] = {p.r - c.radius, 1, 0, 0};
  } else if (!thin) {
    parts[n++] = {c.radius - p.r, -1, 0, 0};
  } else if (!below && !above) {
    parts[n++] = {std::abs(p.r - c.radius), outside ? 1.0 : -1.0, 0, 0};
  }
  for (const int end : {1, 2}) {
    if (!(end == 1 ? c.base_cap : c.end_cap)) continue;
    const double height = end == 1 ? p.z : c.length - p.z, up = end == 1 ? 1 : -1;
    if (!thin) {
      parts[n++] = {height, 0, up, end};
    } else if (!outside) {
      parts[n++] = {std::abs(height), 0, height < 0 ? -up : up, end};
    } else if (height < 0) {
      parts[n++] = from_point(p, c.radius, end == 1 ? 0 : c.length, 2 + end);
    }
  }
  return n;
}

int parts_of(const Cylinder& c, const Polar& p, Part* parts) {
  return c.side == Cylinder::Side::outside && c.base_cap ? rod(c, p, parts) : tube(c, p, parts);
}

}  // namespace

void Cylinder::check(const std::string& name) {
  const double size = norm(axis);
  if (!(size > 0) || !std::isfinite(size))
    throw InputError("Wall '" + name + "': the axis is zero. Give the direction of the cylinder.");
  axis /= size;
  if (!(radius > 0 && length > 0))
    throw InputError("Wall '" + name + "': a cylinder needs a radius and a length above 0 m; they are " +
                     std::to_string(radius) + " m and " + std::to_string(length) + " m.");
  if (side == Side::outside && base_cap != end_cap)
    throw InputError("Wall '" + name +
                     "': a cylinder with seeds outside is a rod (both caps) or a pipe (no cap), not one end "
                     "open. Set both caps alike, or let it be thin (side both).");
}

void Cylinder::points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const {
  const Polar p = polar(*this, x);
  Part parts[3];
  const int n = parts_of(*this, p, parts);
  for (int i = 0; i < n; ++i)
    if (parts[i].distance < reach)
      out.push_back(
          {parts[i].normal_r * p.radial + parts[i].normal_z * axis, parts[i].distance, parts[i].feature, {}});
}

double Cylinder::clearance(const Vec3& x) const {
  Part parts[3];
  const int n = parts_of(*this, polar(*this, x), parts);
  double least = 1e300;
  for (int i = 0; i < n; ++i) least = std::min(least, parts[i].distance);
  return least;
}

}  // namespace seedflow
