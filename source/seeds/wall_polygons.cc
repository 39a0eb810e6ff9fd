#include "seedflow/seeds/wall_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "seedflow/seeds/frame.h"

namespace seedflow {
namespace {

constexpr int circle = 48, hole_circle = 24;

using Ring = std::vector<std::array<double, 2>>;

struct Draw {
  const Placement& place;
  const Vec3 low, high;  // in the lab
  PolygonSurface& out;

  void face(const std::vector<Vec3>& corners) const {
    std::vector<int> numbers;
    for (const Vec3& x : corners) numbers.push_back(out.add(x));
    out.polygon.push_back(numbers);
  }

  // The part of the plane inside the box: the intersections with its edges, in order around.
  void operator()(const Plane& s) const {
    const Vec3 normal = rotate(place.turn, s.normal), point = place.to_lab(s.point);
    std::vector<Vec3> corners;
    const auto corner = [&](int c) {
      return Vec3{c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z};
    };
    const double tolerance = 1e-9 * norm(high - low);
    const auto offer = [&](const Vec3& x) {
      for (const Vec3& known : corners)
        if (norm(known - x) <= tolerance) return;
      corners.push_back(x);
    };
    for (int a = 0; a < 8; ++a)
      for (int d = 0; d < 3; ++d) {
        if (a & 1 << d) continue;
        const Vec3 p = corner(a), q = corner(a | 1 << d);
        const double at_p = dot(p - point, normal), at_q = dot(q - point, normal);
        if (std::abs(at_p) <= tolerance) offer(p);
        if (std::abs(at_q) <= tolerance) offer(q);
        if (at_p * at_q < 0) offer(p + at_p / (at_p - at_q) * (q - p));
      }
    if (corners.size() < 3) return;
    Vec3 middle;
    for (const Vec3& x : corners) middle += x / static_cast<double>(corners.size());
    const Across plane = across(normal);
    std::sort(corners.begin(), corners.end(), [&](const Vec3& a, const Vec3& b) {
      return std::atan2(dot(a - middle, plane.v), dot(a - middle, plane.u)) <
             std::atan2(dot(b - middle, plane.v), dot(b - middle, plane.u));
    });
    for (Vec3& x : corners) x = place.to_wall(x);
    face(corners);
  }

  void operator()(const Rectangle& s) const {
    const Vec3 a = 0.5 * s.length * s.along, b = 0.5 * s.width * cross(s.normal, s.along);
    face({s.centre - a - b, s.centre + a - b, s.centre + a + b, s.centre - a + b});
  }

  void operator()(const Box& s) const {
    int corner[8];
    for (int c = 0; c < 8; ++c)
      corner[c] =
          out.add({c & 1 ? s.high.x : s.low.x, c & 2 ? s.high.y : s.low.y, c & 4 ? s.high.z : s.low.z});
    static const int faces[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
    for (const auto& f : faces)
      out.polygon.push_back({corner[f[0]], corner[f[1]], corner[f[2]], corner[f[3]]});
  }

  void operator()(const Cylinder& s) const {
    const Across plane = across(s.axis);
    const int a = add_circle(out, s.base, plane.u, plane.v, s.radius, circle);
    const int b = add_circle(out, s.base + s.length * s.axis, plane.u, plane.v, s.radius, circle);
    add_band(out, a, b, circle);
    if (s.base_cap) add_lid(out, a, circle);
    if (s.end_cap) add_lid(out, b, circle);
  }

  static Ring outline(const RectangleOutline& o) {
    const double a = 0.5 * o.length, b = 0.5 * o.width;
    return {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
  }
  static Ring outline(const DiscOutline& o) { return round({0, 0}, o.radius, circle); }
  static Ring round(const PlatePoint& centre, double radius, int corners) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * M_PI * i / corners;
      ring.push_back({centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)});
    }
    return ring;
  }

  void operator()(const Plate& s) const {
    const Vec3 side = cross(s.normal, s.along);
    const auto at = [&](const std::array<double, 2>& x, double z) {
      return s.centre + x[0] * s.along + x[1] * side + z * s.normal;
    };
    const double half = 0.5 * s.thickness;
    const auto ring = [&](const Ring& corners, double z) {
      const int first = static_cast<int>(out.vertex.size());
      for (const auto& x : corners) out.add(at(x, z));
      return first;
    };
    const Ring rim = std::visit([](const auto& o) { return outline(o); }, s.outline);
    std::vector<Ring> front, back;
    for (int h = 0; h < n_holes(s.holes); ++h) {
      const PlatePoint c = hole_centre(s.holes, h);
      back.push_back(round(c, s.hole_radius, hole_circle));
      front.push_back(round(c, s.hole_radius + s.chamfer_width, hole_circle));
      const int mouth = ring(front.back(), half), bottom = ring(back.back(), -half);
      const int neck = s.chamfer_depth > 0 ? ring(back.back(), half - s.chamfer_depth) : mouth;
      if (neck != mouth) add_band(out, mouth, neck, hole_circle);
      add_band(out, neck, bottom, hole_circle);
    }
    for (const double z : {half, -half})
      for (const Ring& piece : trapezoids(rim, z > 0 ? front : back)) {
        std::vector<Vec3> corners;
        for (const auto& x : piece) corners.push_back(at(x, z));
        face(corners);
      }
    add_band(out, ring(rim, half), ring(rim, -half), static_cast<int>(rim.size()));
  }

  void operator()(const Mesh& s) const {
    const int first = static_cast<int>(out.vertex.size());
    const TriangleSurface& t = s.surface->triangles();
    out.vertex.insert(out.vertex.end(), t.vertex.begin(), t.vertex.end());
    for (const auto& [a, b, c] : t.triangle) out.polygon.push_back({first + a, first + b, first + c});
  }
};

}  // namespace

PolygonSurface wall_polygons(const Wall& wall, double time, const Vec3& low, const Vec3& high) {
  PolygonSurface out;
  if (!wall.active) return out;
  const Placement place = placement(wall, time);
  std::visit(Draw{place, low, high, out}, wall.surface);
  for (Vec3& x : out.vertex) x = place.to_lab(x);
  return out;
}

}  // namespace seedflow
