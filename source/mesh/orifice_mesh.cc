#include "seedflow/mesh/orifice_mesh.h"

#include <deal.II/grid/grid_tools.h>

#include <cmath>

#include "seedflow/mesh/hole_plane.h"

namespace seedflow {

using dealii::Point;

void OrificeGeometry::declare(Parameters& p) {
  const auto section =
      p.section("Orifice", "A round hole through a plate between two cylindrical chambers, and its mesh.");
  p.number("Diameter", diameter, "m", Range::positive(), "Of the hole.");
  p.number("Length", length, "m", Range::positive(), "Of the hole: the plate's thickness.");
  p.number("Chamfer", chamfer, "m", Range::non_negative(),
           "Of the upstream edge: width = depth. 0: sharp edge.");
  p.number("Chamber radius", chamber_radius, "m", Range::positive(), "Of both chambers.");
  p.number("Upstream depth", upstream_depth, "m", Range::positive(), "Of the chamber the air comes from.");
  p.number("Downstream depth", downstream_depth, "m", Range::positive(), "Of the chamber the jet enters.");
  p.flag("Quarter", quarter, "Only a quarter between two planes of symmetry is computed.");
  p.integer("Hole sides", hole_sides, Range::between(2, 64),
            "Cells along a quarter of the circumference; even.");
  p.integer("Hole rings", hole_rings, Range::between(1, 64), "Rings of cells between core and wall.");
  p.integer("Hole layers", hole_layers, Range::between(2, 256), "Cells along the hole.");
  p.number("Growth", growth, "1", Range::between(1, 3), "From a cell to the next one away from the hole.");
  p.number("Largest cell", largest_cell, "m", Range::positive(), "Width of cells far from the hole.");
}

void OrificeGeometry::check(const Parameters& p) const {
  if (hole_sides % 2 != 0)
    p.reject("Orifice/Hole sides", "planes of symmetry need an even number", "use the next even number");
  if (chamfer >= length)
    p.reject("Orifice/Chamfer", "it is as deep as the plate", "use less than Orifice/Length");
  if (chamber_radius < 2 * (0.5 * diameter + chamfer))
    p.reject("Orifice/Chamber radius", "the chamber is hardly wider than the hole",
             "use at least twice the radius of the hole's mouth");
}

namespace {

enum Side : dealii::types::boundary_id { upstream, downstream, chamber, plate, hole, symmetry };

}  // namespace

OrificeMesh::OrificeMesh(const OrificeGeometry& g)
    : sides{{upstream, "upstream"},
            {downstream, "downstream"},
            {chamber, "chamber"},
            {plate, "plate"},
            {hole, "hole"}} {
  if (g.quarter) sides[symmetry] = "symmetry";
  const double radius = 0.5 * g.diameter, mouth = radius + g.chamfer;
  const double cell = g.length / g.hole_layers;

  HolePlane plane;
  std::vector<unsigned int> loop;
  for (int i = 0; i < 4 * g.hole_sides; ++i) {
    const double angle = -0.75 * M_PI + 2 * M_PI * i / (4 * g.hole_sides);
    loop.push_back(plane.add_node({g.chamber_radius * std::cos(angle), g.chamber_radius * std::sin(angle)}));
  }
  const double width = g.chamber_radius - mouth;
  std::vector<double> outside = graded_layers(1, cell / width, g.growth, g.largest_cell / width);
  outside.pop_back();
  plane.add_hole({}, dealii::Tensor<1, 2>({1, 0}), g.hole_rings, outside, loop);

  std::vector<HolePlane::Level> levels;
  for (const double d : graded_layers(g.upstream_depth, cell, g.growth, g.largest_cell))
    levels.insert(levels.begin(), {-d, mouth, false});
  const int chamfer_layers = g.chamfer > 0 ? std::max(1, static_cast<int>(std::lround(g.chamfer / cell))) : 0;
  for (int i = 0; i < chamfer_layers; ++i) {
    const double z = g.chamfer * i / chamfer_layers;
    levels.push_back({z, mouth - z, true});
  }
  const int straight_layers = std::max(1, static_cast<int>(std::lround((g.length - g.chamfer) / cell)));
  for (int i = 0; i < straight_layers; ++i)
    levels.push_back({g.chamfer + (g.length - g.chamfer) * i / straight_layers, radius, true});
  levels.push_back({g.length, radius, false});
  for (const double d : graded_layers(g.downstream_depth, cell, g.growth, g.largest_cell))
    levels.push_back({g.length + d, radius, false});

  std::vector<Point<3>> vertices;
  std::vector<dealii::CellData<3>> cells;
  plane.extrude(
      levels, 0, [&](const Point<2>& x) { return !g.quarter || (x[0] > 0 && x[1] > 0); }, vertices, cells);
  dealii::SubCellData none;
  dealii::GridTools::delete_unused_vertices(vertices, cells, none);
  coarse.create_triangulation(vertices, cells, none);

  const double tiny = 1e-9 * g.length;
  for (const auto& c : coarse.active_cell_iterators())
    for (const unsigned int f : c->face_indices()) {
      if (!c->face(f)->at_boundary()) continue;
      const Point<3> x = c->face(f)->center();
      Side side = chamber;
      if (g.quarter && (std::abs(x[0]) < tiny || std::abs(x[1]) < tiny))
        side = symmetry;
      else if (x[2] < -g.upstream_depth + tiny)
        side = upstream;
      else if (x[2] > g.length + g.downstream_depth - tiny)
        side = downstream;
      else if (std::abs(x[2]) < tiny || std::abs(x[2] - g.length) < tiny)
        side = plate;
      else if (x[2] > 0 && x[2] < g.length)
        side = hole;
      c->face(f)->set_boundary_id(side);
    }
}

}  // namespace seedflow
