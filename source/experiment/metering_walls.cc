// The walls of the metering device, and its picture.

#include <array>
#include <cmath>

#include "seedflow/experiment/granular_view.h"
#include "seedflow/experiment/metering.h"

namespace seedflow {

namespace {

using Point = std::array<double, 2>;

/// Seen from the seeds' side: the disc turns clockwise, so +x is on the left.
const View front{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}};

Point on_circle(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// A strip between two curves of equally many points, as a solid between two heights.
TriangleSurface strip(const std::vector<Point>& front_edge, const std::vector<Point>& back_edge, double low,
                      double high) {
  TriangleSurface s;
  const int n = static_cast<int>(front_edge.size());
  for (int j = 0; j < n; ++j)
    for (const Point& p : {front_edge[j], back_edge[j]})
      for (const double z : {low, high}) s.vertex.push_back({p[0], p[1], z});
  const auto quad = [&](int a, int b, int c, int d) {
    s.triangle.push_back({a, b, c});
    s.triangle.push_back({a, c, d});
  };
  const auto v = [](int j, int back, int top) { return 4 * j + 2 * back + top; };
  for (int j = 0; j + 1 < n; ++j) {
    quad(v(j, 0, 1), v(j + 1, 0, 1), v(j + 1, 1, 1), v(j, 1, 1));
    quad(v(j, 0, 0), v(j, 1, 0), v(j + 1, 1, 0), v(j + 1, 0, 0));
    quad(v(j, 0, 0), v(j + 1, 0, 0), v(j + 1, 0, 1), v(j, 0, 1));
    quad(v(j, 1, 0), v(j, 1, 1), v(j + 1, 1, 1), v(j + 1, 1, 0));
  }
  quad(v(0, 0, 0), v(0, 0, 1), v(0, 1, 1), v(0, 1, 0));
  quad(v(n - 1, 0, 0), v(n - 1, 1, 0), v(n - 1, 1, 1), v(n - 1, 0, 1));
  if (moments(s).volume < 0)
    for (auto& t : s.triangle) std::swap(t[1], t[2]);
  return s;
}

/// A part of a cylinder about the z axis as triangles, 2 degrees each: off the circle by 0.015 % of R.
TriangleSurface arc(double radius, double from, double to, double low, double high) {
  TriangleSurface s;
  const int n = std::max(1, static_cast<int>(std::ceil((to - from) / (M_PI / 90))));
  for (int j = 0; j <= n; ++j) {
    const Point p = on_circle(radius, from + (to - from) * j / n);
    s.vertex.push_back({p[0], p[1], low});
    s.vertex.push_back({p[0], p[1], high});
  }
  for (int j = 0; j < n; ++j) {
    s.triangle.push_back({2 * j, 2 * j + 2, 2 * j + 3});
    s.triangle.push_back({2 * j, 2 * j + 3, 2 * j + 1});
  }
  return s;
}

PictureLine line(const std::vector<Point>& points, const std::string& colour, double width) {
  PictureLine l;
  l.colour = colour, l.width = width;
  for (const Point& p : points) l.x.push_back(-p[0]), l.y.push_back(p[1]);
  return l;
}

std::vector<Point> circle_points(double radius, double from, double to, const Point& centre = {0, 0}) {
  std::vector<Point> points;
  const int n = 90;
  for (int i = 0; i <= n; ++i) {
    const Point p = on_circle(radius, from + (to - from) * i / n);
    points.push_back({centre[0] + p[0], centre[1] + p[1]});
  }
  return points;
}

}  // namespace

std::vector<std::array<double, 2>> Metering::blade_teeth(int side) const {
  // Each tooth rises slowly in the sense of the rotation and ends in a tip; the passage narrows from tip to
  // tip.
  std::vector<Point> edge;
  for (int i = 0; i < parts.teeth; ++i) {
    const double at = parts.teeth > 1 ? static_cast<double>(i) / (parts.teeth - 1) : 1;
    const double tip = parts.passage_in + (parts.passage_out - parts.passage_in) * at;
    const double begin = parts.blade_angle + parts.blade_length * i / parts.teeth;
    const double end = parts.blade_angle + parts.blade_length * (i + 0.95) / parts.teeth;
    edge.push_back(on_circle(device.pitch_radius + side * (tip + parts.tooth_depth), begin));
    edge.push_back(on_circle(device.pitch_radius + side * tip, end));
  }
  return edge;
}

Surface Metering::disc_surface() const {
  if (!surfaces.disc.empty())
    return Mesh(read_wall_triangles(surfaces.disc, surfaces.unit, {}), Mesh::Side::outside, surfaces.disc);
  Plate plate;
  plate.centre = {0, 0, 0.5 * device.thickness};
  plate.normal = {0, 0, -1};  // the chamfers are on the seeds' side
  plate.along = {1, 0, 0};
  plate.thickness = device.thickness;
  plate.outline = DiscOutline{device.disc_radius};
  HoleList holes;
  for (int k = 0; k < device.n_holes(); ++k) {
    const Vec3 c = device.hole_centre(k, 0);
    holes.centre.push_back({c.x, -c.y});  // the plate's second direction is normal x along = -y
  }
  plate.holes = holes;
  plate.hole_radius = device.hole_radius();
  plate.chamfer_width = plate.chamfer_depth = device.chamfer;
  return plate;
}

std::vector<Wall> Metering::walls() const {
  const int disc = granular.materials.number(disc_material);
  const int housing = granular.materials.number(housing_material);
  const double depth = device.chamber_depth, r = device.chamber_outer_radius, d = granular.model.diameter;
  Cylinder filling;
  filling.base = {0, 0, -depth - d};
  filling.radius = r;
  filling.length = depth + d;
  filling.base_cap = filling.end_cap = false;
  const double edge = device.disc_radius + 3 * d;
  std::vector<Wall> all = {
      Wall("disc", disc_surface(), disc), Wall("wall while filling", filling, housing),
      Wall("housing", Box{{-edge, parts.floor, -depth}, {edge, edge, device.thickness}}, housing)};
  const auto from_file = [&](const std::string& name, const std::string& file) {
    all.emplace_back(name, Mesh(read_wall_triangles(file, surfaces.unit, {}), Mesh::Side::both, file),
                     housing);
  };
  if (surfaces.housing.empty())
    add_chamber(all, housing);
  else
    from_file("own housing", surfaces.housing);
  if (surfaces.blade.empty())
    add_blade(all, housing);
  else
    from_file("own blade", surfaces.blade);
  return all;
}

void Metering::add_chamber(std::vector<Wall>& all, int housing) const {
  const double depth = device.chamber_depth, r = device.chamber_outer_radius, d = granular.model.diameter;
  Cylinder hub;
  hub.base = {0, 0, -depth - d};
  hub.radius = device.chamber_inner_radius;
  hub.length = depth + d + 0.5 * device.thickness;
  hub.side = Cylinder::Side::outside;
  all.emplace_back("hub", hub, housing);
  all.emplace_back(
      "chamber wall",
      Mesh(arc(r, parts.chamber_from, parts.chamber_to, -depth - d, 0), Mesh::Side::both, "chamber wall"),
      housing);
  // The divider stands on the chamber wall's beginning and leaves the disc free.
  const Point foot = on_circle(r, parts.chamber_from);
  const double top = -0.2 * r, gap = 0.2e-3;
  all.emplace_back("divider",
                   Rectangle{{foot[0], 0.5 * (foot[1] + top), -0.5 * (depth + gap)},
                             {1, 0, 0},
                             {0, 1, 0},
                             top - foot[1],
                             depth - gap},
                   housing);
  for (const int side : {-1, 1})
    all.emplace_back(side < 0 ? "tube, outer side" : "tube, inner side",
                     Rectangle{{parts.tube_position + side * 0.5 * parts.tube_width,
                                0.5 * (parts.tube_top + parts.floor), -0.5 * (depth + gap)},
                               {1, 0, 0},
                               {0, 1, 0},
                               parts.tube_top - parts.floor,
                               depth - gap},
                     housing);
}

void Metering::add_blade(std::vector<Wall>& all, int housing) const {
  for (const int side : {1, -1}) {
    if (parts.blade_sides != "both" && parts.blade_sides != (side > 0 ? "outer" : "inner")) continue;
    const std::vector<Point> teeth = blade_teeth(side);
    std::vector<Point> back;
    for (const Point& p : teeth)
      back.push_back(on_circle(device.pitch_radius + side * (parts.passage_in + parts.tooth_depth + 2e-3),
                               std::atan2(p[1], p[0])));
    const double low = -parts.blade_clearance - parts.blade_height, high = -parts.blade_clearance;
    const std::string name = side > 0 ? "outer blade" : "inner blade";
    all.emplace_back(name, Mesh(strip(teeth, back, low, high), Mesh::Side::outside, name), housing);
  }
}

SeedPicture Metering::picture(const Dem& dem, double turned, const std::string& title) const {
  SeedPicture p;
  p.title = title;
  const double edge = 1.06 * device.disc_radius;
  p.window = {-edge, parts.tube_end - 10e-3, edge, edge};
  p.width = 430;
  p.discs = seeds_from(front, dem);
  p.group = groups_of(dem);
  const double r = device.chamber_outer_radius;
  p.behind = {line(circle_points(device.disc_radius, 0, 2 * M_PI), "#999", 2),
              line(circle_points(device.chamber_inner_radius, 0, 2 * M_PI), "#999", 1),
              line(circle_points(0.5 * (device.vacuum_inner_radius + device.vacuum_outer_radius),
                                 device.vacuum_from, device.vacuum_to),
                   "#d6e6f5", (device.vacuum_outer_radius - device.vacuum_inner_radius) * 430 / (2 * edge)),
              line(circle_points(r, parts.chamber_from, parts.chamber_to), "#333", 3)};
  for (int k = 0; k < device.n_holes(); ++k) {
    const Vec3 c = device.hole_centre(k, turned);
    p.behind.push_back(line(circle_points(device.hole_radius(), 0, 2 * M_PI, {c.x, c.y}),
                            device.exposure(device.hole_angle(k, turned)) > 0 ? "#1b62a5" : "#aaa", 1.5));
  }
  const Point foot = on_circle(r, parts.chamber_from);
  p.behind.push_back(line({foot, {foot[0], -0.2 * r}}, "#333", 3));
  for (const int side : {-1, 1}) {
    const double x = parts.tube_position + side * 0.5 * parts.tube_width;
    p.behind.push_back(line({{x, parts.tube_top}, {x, parts.tube_end}}, "#333", 3));
    if (parts.blade_sides == "both" || parts.blade_sides == (side > 0 ? "outer" : "inner"))
      p.before.push_back(line(blade_teeth(side), "#000", 2.5));
  }
  return p;
}

}  // namespace seedflow
