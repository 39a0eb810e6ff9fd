#include "seedflow/seeds/device_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "seedflow/base/error.h"
#include "seedflow/base/parameters.h"
#include "seedflow/seeds/surface_mesh.h"

namespace seedflow {

void DeviceSurfaces::declare(Parameters& p) {
  const auto section = p.section("Device", "");
  p.file(
      "Disc surface", disc,
      "STL file of your own disc, a closed surface, in place of the one made from the entries above; these "
      "must still say where its holes are. It turns about z. See doc/own_device.md.");
  p.file(
      "Housing surface", housing,
      "STL file of what stands around the disc, in place of the seed chamber's wall, divider and hub and of "
      "the guide tube. The front cover at Chamber depth and the catch bin remain.");
  p.file("Blade surface", blade, "STL file of the cleaning blade, in place of the one with teeth.");
  p.number("Surface unit", unit, "m", Range::positive(), "What 1 means in these files.");
}

namespace {

constexpr double off_face = 0.05;  // of the thickness

std::string mm(double metres) {
  std::ostringstream text;
  text.precision(4);
  text << 1e3 * metres << " mm";
  return text.str();
}

double cross_z(const Vec3& a, const Vec3& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

double distance_to_segment(const Vec3& a, const Vec3& b, double x, double y) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double s = square > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(x - a.x - s * dx, y - a.y - s * dy);
}

/// Whether the line along z through (x, y) passes a convex polygon, its edges included; false if it stands
/// upright.
bool passes(const std::vector<Vec3>& corner, double x, double y) {
  double longest = 0, area = 0, least = 1e300, most = -1e300;
  for (std::size_t c = 0; c < corner.size(); ++c) {
    const Vec3 &a = corner[c], &b = corner[(c + 1) % corner.size()];
    const double side = cross_z(a, b, x, y);
    area += cross_z(corner[0], a, b.x, b.y);
    longest = std::max(longest, norm_square(b - a));
    least = std::min(least, side), most = std::max(most, side);
  }
  const double round_off = 1e-9 * longest;
  return std::abs(area) > round_off && (least >= -round_off || most <= round_off);
}

/// Least distance of a convex polygon from the line along z through (x, y).
double distance(const std::vector<Vec3>& corner, double x, double y) {
  if (passes(corner, x, y)) return 0;
  double least = 1e300;
  for (std::size_t c = 0; c < corner.size(); ++c)
    least = std::min(least, distance_to_segment(corner[c], corner[(c + 1) % corner.size()], x, y));
  return least;
}

std::vector<Vec3> corners(const TriangleSurface& s, const std::array<int, 3>& t) {
  return {s.vertex[t[0]], s.vertex[t[1]], s.vertex[t[2]]};
}

/// Heights at which the line along z through (x, y) meets the surface, from below.
std::vector<double> heights(const TriangleSurface& s, double x, double y) {
  std::vector<double> z;
  for (const auto& t : s.triangle) {
    const Vec3 &a = s.vertex[t[0]], &b = s.vertex[t[1]], &c = s.vertex[t[2]];
    if (std::max({a.x, b.x, c.x}) < x || std::min({a.x, b.x, c.x}) > x || std::max({a.y, b.y, c.y}) < y ||
        std::min({a.y, b.y, c.y}) > y)
      continue;
    if (!passes({a, b, c}, x, y)) continue;
    const Vec3 n = cross(b - a, c - a);
    z.push_back(a.z - (n.x * (x - a.x) + n.y * (y - a.y)) / n.z);
  }
  std::sort(z.begin(), z.end());
  return z;
}

/// The part of a polygon with sign (z - height) >= 0.
std::vector<Vec3> beyond(const std::vector<Vec3>& polygon, double height, double sign) {
  std::vector<Vec3> part;
  for (std::size_t c = 0; c < polygon.size(); ++c) {
    const Vec3 &a = polygon[c], &b = polygon[(c + 1) % polygon.size()];
    const double at_a = sign * (a.z - height), at_b = sign * (b.z - height);
    if (at_a >= 0) part.push_back(a);
    if (at_a * at_b < 0) part.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return part;
}

class DiscCheck {
 public:
  DiscCheck(const TriangleSurface& surface, const DeviceGeometry& geometry, const std::string& name)
      : surface(surface), device(geometry), name(name) {}

  void holes() const {
    const double r = device.hole_radius(), mouth = r + device.chamfer;
    const double room = std::min(device.pitch_radius * std::sin(0.5 * device.pitch_angle()) - mouth,
                                 device.disc_radius - device.pitch_radius - mouth);
    for (int k = 0; k < device.n_holes(); ++k) {
      const Vec3 c = device.hole_centre(k, 0);
      const std::string hole = "hole " + std::to_string(k) + " (at x = " + mm(c.x) + ", y = " + mm(c.y) + ")";
      double free = 1e300, at = 0;
      for (const auto& t : surface.triangle) {
        const std::vector<Vec3> polygon = corners(surface, t);
        if (const double d = distance(polygon, c.x, c.y); d < free)
          free = d, at = (polygon[0].z + polygon[1].z + polygon[2].z) / 3;
      }
      if (free < 0.9 * r)
        refuse("is not open at " + hole + ": a triangle at z = " + mm(at) +
               (free > 0 ? " comes within " + mm(free) + " of the hole's axis" : " lies across its axis") +
               "; Device/Hole diameter leaves " + mm(r) + " free");
      if (free > 1.1 * r)
        refuse("has no hole of the declared size at " + hole + ": the nearest triangle is " + mm(free) +
               " from its axis, Device/Hole diameter puts the wall at " + mm(r));
      const double beside = mouth + 0.3 * std::min(room, mouth);
      int good = 0;
      std::string found;
      for (int i = 0; i < 8; ++i)
        good += is_solid(c.x + beside * std::cos(i * M_PI / 4), c.y + beside * std::sin(i * M_PI / 4), found);
      if (good < 4)
        refuse("is not where it should be beside " + hole + ": " + mm(beside) +
               " from its axis the faces should be at z = 0 and " + mm(device.thickness) + ", and are at " +
               found);
      chamfer(c, hole);
    }
  }

  /// Half way down the chamfer, or without one just beside the hole, in front.
  void chamfer(const Vec3& c, const std::string& hole) const {
    const double depth = 0.5 * device.chamfer;
    const double away = device.hole_radius() + (depth > 0 ? depth : 0.1 * device.hole_radius());
    const double tolerance = depth > 0 ? 0.8 * depth : off_face * device.thickness;
    int good = 0;
    double found = 0;
    for (int i = 0; i < 8; ++i) {
      const std::vector<double> z =
          heights(surface, c.x + away * std::cos(i * M_PI / 4), c.y + away * std::sin(i * M_PI / 4));
      const auto nearest = std::min_element(
          z.begin(), z.end(), [&](double a, double b) { return std::abs(a - depth) < std::abs(b - depth); });
      if (nearest == z.end()) continue;
      if (std::abs(*nearest - depth) <= tolerance)
        ++good;
      else
        found = *nearest;
    }
    if (good < 4)
      refuse("has no edge as Device/Chamfer says at " + hole + ": " + mm(away) +
             " from its axis the front should be at z = " + mm(depth) + " and is at " + mm(found));
  }

  void between() const {
    for (int i = 0; i < 2 * device.holes; ++i) {
      if (i % 2 == 0 && i / 2 < device.n_holes()) continue;  // a hole
      const double angle = device.first_angle + 0.5 * i * device.pitch_angle();
      const double x = device.pitch_radius * std::cos(angle), y = device.pitch_radius * std::sin(angle);
      std::string found;
      if (!is_solid(x, y, found))
        refuse("has no solid on the circle of the holes at " + mm(x) + ", " + mm(y) +
               ", where Device/Holes and Drilled put no hole: faces at z = " + found);
    }
  }

 private:
  /// Adds what is there to `found` if not.
  bool is_solid(double x, double y, std::string& found) const {
    const std::vector<double> z = heights(surface, x, y);
    const auto near = [&](double height) {
      return std::any_of(z.begin(), z.end(), [&](double value) {
        return std::abs(value - height) <= off_face * device.thickness;
      });
    };
    if (near(0) && near(device.thickness)) return true;
    std::string here, last;
    for (const double value : z)
      if (mm(value) != last)  // a point on an edge meets two triangles
        last = mm(value), here += (here.empty() ? "" : " and ") + last;
    found = here.empty() ? "no height (nothing is there)" : here;
    return false;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(
        "the disc of \"" + name + "\" " + what +
        ". The file shows the disc not turned, its axis is z, its front z = 0, seeds are at z < 0; "
        "mend it, Device/Surface unit, or the entries of Device that say where the holes are");
  }

  const TriangleSurface& surface;
  const DeviceGeometry& device;
  const std::string& name;
};

}  // namespace

void check_disc(const TriangleSurface& surface, const DeviceGeometry& g, const std::string& name) {
  const DiscCheck check(surface, g, name);
  check.holes();
  check.between();
}

void check_standing(const TriangleSurface& surface, const DeviceGeometry& g, const std::string& name) {
  const double tolerance = off_face * g.thickness;
  for (const auto& t : surface.triangle) {
    const std::vector<Vec3> inside =
        beyond(beyond(corners(surface, t), tolerance, 1), g.thickness - tolerance, -1);
    if (inside.size() < 2) continue;
    double farthest = 0;
    Vec3 place;
    for (const Vec3& x : inside)
      if (std::hypot(x.x, x.y) > farthest) farthest = std::hypot(x.x, x.y), place = x;
    if (farthest > g.chamber_inner_radius + tolerance && distance(inside, 0, 0) < g.disc_radius - tolerance)
      throw InputError("\"" + name + "\" cuts into the disc near (" + mm(place.x) + ", " + mm(place.y) +
                       ", " + mm(place.z) + "): the disc turns between z = 0 and " + mm(g.thickness) +
                       " up to " + mm(g.disc_radius) +
                       " from the axis (Device/Disc thickness, Disc radius). Leave a gap, or mend "
                       "Device/Surface unit.");
  }
}

void DeviceSurfaces::check(const DeviceGeometry& g, const Parameters& p) const {
  const auto file = [&](const std::string& entry, const std::string& name, const auto& work) {
    if (name.empty()) return;
    try {
      TriangleSurface surface = read_wall_triangles(name, unit, {});
      work(surface);
    } catch (const InputError& error) {
      p.reject(entry, error.what(), "see doc/own_device.md");
    }
  };
  file("Device/Disc surface", disc, [&](TriangleSurface& surface) {
    require_closed(surface, disc);
    check_disc(surface, g, disc);
  });
  file("Device/Housing surface", housing, [&](TriangleSurface& s) { check_standing(s, g, housing); });
  file("Device/Blade surface", blade, [&](TriangleSurface& s) { check_standing(s, g, blade); });
}

}  // namespace seedflow
