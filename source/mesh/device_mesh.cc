#include "seedflow/mesh/device_mesh.h"

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

#include "seedflow/mesh/hole_plane.h"

namespace seedflow {

using dealii::Point;
using dealii::Tensor;

void DeviceMeshParameters::declare(Parameters& p) {
  const auto section = p.section(
      "Device mesh",
      "Cells of the air in the device, before any refinement. With a File the other entries than Unit "
      "are without effect.");
  p.file("File", file,
         "Gmsh file (.msh, ASCII, hexahedra) with the air of your own device, in place of the mesh made from "
         "the entries of Device and those below: doc/own_device.md.");
  p.number("Unit", unit, "m", Range::positive(), "What 1 means in the file.");
  p.integer("Hole sides", hole_sides, Range::between(2, 32),
            "Cells along a quarter of a hole's circumference.");
  p.integer("Hole rings", hole_rings, Range::between(1, 32),
            "Rings of cells between core and wall of a hole.");
  p.integer("Mouth rings", mouth_rings, Range::between(1, 32), "Rings around a hole's mouth on the disc.");
  p.integer("Hole layers", hole_layers, Range::between(1, 64), "Cells along the straight part of a hole.");
  p.integer("Chamfer layers", chamfer_layers, Range::between(1, 32), "Cells along the chamfer.");
  p.number("Face cell", face_cell, "m", Range::positive(), "Depth of the first cells in front of the disc.");
  p.number("Vacuum cell", vacuum_cell, "m", Range::positive(),
           "Width of the vacuum chamber's cells along the holes' path.");
  p.number("Largest cell", largest_cell, "m", Range::positive(), "Width of cells far from the holes.");
  p.number("Growth", growth, "1", Range::between(1, 3), "From a cell to the next one away from the holes.");
}

namespace {

/// Distances on both sides of a strip: places[0] = low ... places.back() = high, those of the strip
/// included.
std::vector<double> around_strip(double low, const std::vector<double>& strip, double high, double growth,
                                 double largest) {
  std::vector<double> places;
  const double first = growth * (strip[1] - strip[0]),
               last = growth * (strip.back() - strip[strip.size() - 2]);
  for (const double d : graded_layers(strip.front() - low, first, growth, largest))
    places.insert(places.begin(), strip.front() - d);
  places.insert(places.end(), strip.begin(), strip.end());
  for (const double d : graded_layers(high - strip.back(), last, growth, largest))
    places.push_back(strip.back() + d);
  return places;
}

/// Quadrilaterals between circles of the given radii and rays of the given angles, without those for which
/// `leave_out(row, column)`. Closed: the last ray is followed by the first. Returns the numbers of the nodes,
/// [row][column].
template <typename LeaveOut>
std::vector<std::vector<unsigned int>> add_polar_grid(HolePlane& plane, const std::vector<double>& radii,
                                                      const std::vector<double>& angles, bool closed,
                                                      const LeaveOut& leave_out) {
  std::vector<std::vector<unsigned int>> node(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i)
    for (const double a : angles)
      node[i].push_back(plane.add_node({radii[i] * std::cos(a), radii[i] * std::sin(a)}));
  for (std::size_t i = 0; i + 1 < radii.size(); ++i)
    for (std::size_t j = 0; j + (closed ? 0 : 1) < angles.size(); ++j) {
      const std::size_t next = (j + 1) % angles.size();
      if (!leave_out(i, j)) plane.add_quad(node[i][j], node[i + 1][j], node[i][next], node[i + 1][next]);
    }
  return node;
}

/// The vacuum chamber seen along the axis.
HolePlane back_plane(const DeviceGeometry& g, const DeviceMeshParameters& p) {
  const double reach = std::min({1.5 * g.hole_diameter, g.pitch_radius - g.vacuum_inner_radius,
                                 g.vacuum_outer_radius - g.pitch_radius}) *
                       (1 - 1e-6);
  const int across = std::max(2, static_cast<int>(std::lround(2 * reach / p.vacuum_cell)));
  std::vector<double> strip, angles;
  for (int i = 0; i <= across; ++i) strip.push_back(g.pitch_radius + reach * (2.0 * i / across - 1));
  const double arc = g.vacuum_to - g.vacuum_from;
  const int along = std::max(1, static_cast<int>(std::lround(arc * g.pitch_radius / p.vacuum_cell)));
  for (int i = 0; i <= along; ++i) angles.push_back(g.vacuum_from + arc * i / along);
  HolePlane plane;
  add_polar_grid(plane,
                 around_strip(g.vacuum_inner_radius, strip, g.vacuum_outer_radius, p.growth, p.largest_cell),
                 angles, false, [](std::size_t, std::size_t) { return false; });
  return plane;
}

}  // namespace

HolePlane seed_chamber_plane(const DeviceGeometry& g, const DeviceMeshParameters& p) {
  const int m = p.hole_sides, n_holes = g.n_holes();
  const double mouth = g.hole_radius() + g.chamfer, pitch = g.pitch_radius * g.pitch_angle();
  // Half the width of the square around a hole that its rings fill.
  const double room = std::min(
      {0.5 * pitch, g.pitch_radius - g.chamber_inner_radius, g.chamber_outer_radius - g.pitch_radius});
  const double half = std::min(2.5 * mouth, mouth + 0.6 * (room - mouth));

  std::vector<double> strip, square;
  for (const double t : HolePlane::side_positions(m)) {
    strip.push_back(g.pitch_radius + half * t);
    square.push_back(half * t / g.pitch_radius);
  }
  const double beside = strip[1] - strip[0];
  const std::vector<double> radii =
      around_strip(g.chamber_inner_radius, strip, g.chamber_outer_radius, p.growth, p.largest_cell);
  const std::size_t first_row = std::find(radii.begin(), radii.end(), strip.front()) - radii.begin();

  std::vector<double> angles;
  std::vector<int> hole_of;  // column -> hole whose square it crosses, or -1
  for (int k = 0; k < n_holes; ++k) {
    const double centre = g.hole_angle(k, 0);
    for (int i = 0; i <= m; ++i) {
      angles.push_back(centre + square[i]);
      hole_of.push_back(i < m ? k : -1);
    }
    // From this square to the next one, which may be far where places are not drilled.
    const double begin = centre + square.back();
    const double end = g.hole_angle((k + 1) % n_holes, 0) + (k + 1 < n_holes ? 0 : 2 * M_PI) + square.front();
    const std::vector<double> half_way = graded_layers(0.5 * (end - begin), beside / g.pitch_radius, p.growth,
                                                       p.largest_cell / g.pitch_radius);
    for (const double d : half_way) angles.push_back(begin + d);
    for (std::size_t i = half_way.size() - 1; i-- > 0;) angles.push_back(end - half_way[i]);
    hole_of.resize(angles.size(), -1);
  }

  HolePlane plane;
  const auto node = add_polar_grid(plane, radii, angles, true, [&](std::size_t row, std::size_t column) {
    return hole_of[column] >= 0 && row >= first_row && row < first_row + m;
  });
  std::vector<double> outside =
      graded_layers(1, (1.0 / p.mouth_rings) * 0.7, std::pow(1 / 0.7, 2.0 / p.mouth_rings), 1);
  outside.pop_back();
  for (int k = 0; k < n_holes; ++k) {
    const std::size_t column = std::find(hole_of.begin(), hole_of.end(), k) - hole_of.begin();
    std::vector<unsigned int> loop;
    for (int i = 0; i < m; ++i) loop.push_back(node[first_row + i][column]);
    for (int i = 0; i < m; ++i) loop.push_back(node[first_row + m][column + i]);
    for (int i = 0; i < m; ++i) loop.push_back(node[first_row + m - i][column + m]);
    for (int i = 0; i < m; ++i) loop.push_back(node[first_row][column + m - i]);
    const double angle = g.hole_angle(k, 0);
    const Vec3 centre = g.hole_centre(k, 0);
    plane.add_hole({centre.x, centre.y}, Tensor<1, 2>({std::cos(angle), std::sin(angle)}), p.hole_rings,
                   outside, loop);
  }
  return plane;
}

const std::map<dealii::types::boundary_id, std::string>& DeviceMesh::side_names() {
  static const std::map<dealii::types::boundary_id, std::string> names = {
      {ambient, "ambient"}, {housing, "housing"},        {disc, "disc"},
      {hole, "hole"},       {hole_end, "hole end"},      {vacuum_face, "vacuum face"},
      {suction, "suction"}, {vacuum_wall, "vacuum wall"}};
  return names;
}

const std::map<dealii::types::material_id, std::string>& DeviceMesh::part_names() {
  static const std::map<dealii::types::material_id, std::string> names = {{standing, "standing"},
                                                                          {turning, "turning"}};
  return names;
}

DeviceMesh::DeviceMesh(const DeviceGeometry& g, const DeviceMeshParameters& p) {
  if (!p.file.empty()) {
    read_device_mesh(p.file, p.unit, g, coarse);
    return;
  }
  std::vector<Point<3>> vertices;
  std::vector<dealii::CellData<3>> cells;
  const auto all = [](const Point<2>&) { return true; };
  const double t = g.thickness, radius = g.hole_radius(), tiny = 1e-9 * t;

  std::vector<HolePlane::Level> levels;
  const double mouth = radius + g.chamfer;
  for (const double d : graded_layers(g.chamber_depth, p.face_cell, p.growth, p.largest_cell))
    levels.insert(levels.begin(), {-d, mouth, false});
  for (int i = 0; g.chamfer > 0 && i < p.chamfer_layers; ++i) {
    const double z = g.chamfer * i / p.chamfer_layers;
    levels.push_back({z, mouth - z, true});
  }
  for (int i = 0; i <= p.hole_layers; ++i)
    levels.push_back({g.chamfer + (t - g.chamfer) * i / p.hole_layers, radius, true});
  seed_chamber_plane(g, p).extrude(levels, turning, all, vertices, cells);

  levels = {{t, radius, false}};
  for (const double d : graded_layers(g.vacuum_depth, p.vacuum_cell, p.growth, p.largest_cell))
    levels.push_back({t + d, radius, false});
  back_plane(g, p).extrude(levels, standing, all, vertices, cells);

  dealii::SubCellData none;
  dealii::GridTools::delete_unused_vertices(vertices, cells, none);
  coarse.create_triangulation(vertices, cells, none);
  for (const auto& cell : coarse.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary()) continue;
      const double z = cell->face(f)->center()[2];
      const bool turns = cell->material_id() == turning;
      Side side = vacuum_wall;
      if (turns)
        side = z < -g.chamber_depth + tiny ? ambient
               : z < -tiny                 ? housing
               : z < tiny                  ? disc
               : z < t - tiny              ? hole
                                           : hole_end;
      else if (z < t + tiny)
        side = vacuum_face;
      else if (z > t + g.vacuum_depth - tiny)
        side = suction;
      cell->face(f)->set_boundary_id(side);
    }
}

Domain<3> device_domain(const DeviceGeometry& g, const DeviceMeshParameters& p, MPI_Comm comm) {
  const DeviceMesh mesh(g, p);
  Domain<3> domain(mesh.coarse, mesh.sides, {}, comm);
  domain.require_cells_for_all_ranks();
  Rotor<3> rotor;
  rotor.material = DeviceMesh::turning;
  rotor.pairs = {{mesh.sides.at(DeviceMesh::hole_end), mesh.sides.at(DeviceMesh::vacuum_face)}};
  domain.set_rotor(rotor);
  return domain;
}

}  // namespace seedflow
