#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "seedflow/mesh/point_location.h"

namespace seedflow {
namespace {

using dealii::Point;
using Coarse = dealii::Triangulation<3>;
using Cell = Domain<3>::Triangulation::active_cell_iterator;

Domain<3> domain_of(const Coarse& coarse) {
  std::map<dealii::types::boundary_id, std::string> names;
  for (const auto id : coarse.get_boundary_ids()) names[id] = "side " + std::to_string(id);
  return Domain<3>(coarse, names, {}, MPI_COMM_WORLD);
}

void refine_near(Domain<3>& domain, const Point<3>& centre, double radius, int times) {
  for (int i = 0; i < times; ++i) {
    for (const auto& cell : domain.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && cell->center().distance(centre) < radius) cell->set_refine_flag();
    domain.triangulation().execute_coarsening_and_refinement();
  }
}

std::vector<Cell> owned_cells(const Domain<3>& domain) {
  std::vector<Cell> cells;
  for (const auto& cell : domain.triangulation().active_cell_iterators())
    if (cell->is_locally_owned()) cells.push_back(cell);
  return cells;
}

/// A cube whose cells are trilinear without a pair of parallel faces, refined twice in a corner.
Domain<3> distorted_cube() {
  Coarse coarse;
  dealii::GridGenerator::subdivided_hyper_cube(coarse, 5, 0, 1);
  dealii::GridTools::transform(
      [](const Point<3>& x) {
        return x + 0.06 * Point<3>(std::sin(5 * x[1] + 3 * x[2]), std::sin(7 * x[2]) * std::cos(4 * x[0]),
                                   std::sin(6 * x[0] + 2 * x[1] * x[2]));
      },
      coarse);
  Domain<3> domain = domain_of(coarse);
  refine_near(domain, {0.2, 0.3, 0.2}, 0.35, 2);
  return domain;
}

/// A cylinder of radius 1 about x, |x| <= 1, whose new vertices lie on the cylinder.
Domain<3> cylinder() {
  Coarse coarse;
  dealii::GridGenerator::cylinder(coarse, 1.0, 1.0);
  coarse.refine_global(1);
  Coarse flat;
  dealii::GridGenerator::flatten_triangulation(coarse, flat);
  flat.set_all_manifold_ids(0);
  flat.set_manifold(0, dealii::CylindricalManifold<3>(0));
  for (const auto& cell : flat.active_cell_iterators())
    if (std::hypot(cell->center()[1], cell->center()[2]) < 0.5)
      cell->set_all_manifold_ids(dealii::numbers::flat_manifold_id);
  return domain_of(flat);
}

int holders(int cell) {
  return dealii::Utilities::MPI::sum(cell != PointLocation<3>::not_here ? 1 : 0, MPI_COMM_WORLD);
}

TEST(HexahedraLocationMpi, everyQuadraturePointIsInItsCell) {
  const Domain<3> domain = distorted_cube();
  PointLocation<3> location;
  location.build(domain);
  const dealii::QGauss<3> rule(2);
  const dealii::FE_Q<3> fe(1);
  dealii::FEValues<3> values(domain.mapping(), fe, rule, dealii::update_quadrature_points);
  int number = 0;
  for (const Cell& cell : owned_cells(domain)) {
    values.reinit(cell);
    for (const auto& x : values.get_quadrature_points()) {
      EXPECT_EQ(location.cell_of(x), number);
      EXPECT_EQ(location.cell_of(x, number), number);
      EXPECT_EQ(location.cell_of(x, 0), number) << "a wrong guess must not matter";
    }
    ++number;
  }
}

TEST(HexahedraLocationMpi, everyPointBelongsToOneRankAndItsCell) {
  const Domain<3> domain = distorted_cube();
  PointLocation<3> location;
  location.build(domain);
  const auto cells = owned_cells(domain);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.08, 0.92);
  for (int i = 0; i < 3000; ++i) {
    const Point<3> x(uniform(random), uniform(random), uniform(random));
    const int cell = location.cell_of(x);
    EXPECT_EQ(holders(cell), 1) << x;
    if (cell < 0) continue;
    const auto s = domain.mapping().transform_real_to_unit_cell(cells.at(cell), x);
    EXPECT_LT(dealii::GeometryInfo<3>::distance_to_unit_cell(s), 1e-9) << x;
  }
}

TEST(HexahedraLocationMpi, verticesBelongToOneRank) {
  const Domain<3> domain = distorted_cube();
  PointLocation<3> location;
  location.build(domain);
  // All ranks ask for all vertices of the first rank's cells.
  std::vector<Point<3>> vertices;
  for (const Cell& cell : owned_cells(domain))
    for (const unsigned int v : cell->vertex_indices()) vertices.push_back(cell->vertex(v));
  vertices = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, vertices, 0);
  for (const auto& x : vertices) EXPECT_EQ(holders(location.cell_of(x)), 1) << x;
}

TEST(HexahedraLocationMpi, noPointIsLostOrDoubledAtHangingNodesOfCurvedFaces) {
  Domain<3> domain = cylinder();
  refine_near(domain, {0, 0.7, 0.3}, 0.4, 2);
  PointLocation<3> location;
  location.build(domain);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int asked = 0, lost = 0, doubled = 0;
  while (asked < 4000) {
    const Point<3> x(uniform(random), uniform(random), uniform(random));
    if (std::hypot(x[1], x[2]) > 0.9) continue;  // the facets of eighths of a circle lie beyond 0.92
    ++asked;
    const int n = holders(location.cell_of(x));
    lost += n == 0;
    doubled += n > 1;
  }
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(doubled, 0);
  EXPECT_EQ(location.cell_of({0, 1.2, 0}), PointLocation<3>::not_here);
  EXPECT_EQ(location.cell_of({std::nan(""), 0, 0}), PointLocation<3>::not_here);
}

TEST(HexahedraLocationMpi, cellsInBoxAreThoseWhoseBoundingBoxOverlaps) {
  const Domain<3> domain = distorted_cube();
  PointLocation<3> location;
  location.build(domain);
  const Point<3> low(0.15, 0.2, 0.1), high(0.45, 0.42, 0.33);
  std::set<int> found;
  location.cells_in_box(low, high, [&](int c) { EXPECT_TRUE(found.insert(c).second) << "visited twice"; });
  const auto cells = owned_cells(domain);
  for (unsigned int c = 0; c < cells.size(); ++c) {
    const auto bounds = cells[c]->bounding_box().get_boundary_points();
    bool overlaps = true;
    for (int d = 0; d < 3; ++d)
      overlaps = overlaps && bounds.first[d] <= high[d] && bounds.second[d] >= low[d];
    // Boxes of cells at hanging nodes are larger by the gap on every side.
    if (overlaps) {
      EXPECT_EQ(found.count(c), 1u) << "cell " << c;
    } else if (found.count(c)) {
      const double width = cells[c]->diameter();
      for (int d = 0; d < 3; ++d)
        EXPECT_TRUE(bounds.first[d] <= high[d] + PointLocation<3>::gap * width &&
                    bounds.second[d] >= low[d] - PointLocation<3>::gap * width);
    }
  }
}

TEST(HexahedraLocationMpi, aTurningPartIsFoundWhereItIsWithoutBuildingAgain) {
  // Inner disc (material 1) turns within the outer ring.
  Coarse inner, outer, both;
  const Point<3> on_axis(0, 0, 0);
  dealii::Triangulation<2> disc, ring;
  dealii::GridGenerator::hyper_ball_balanced(disc, Point<2>(), 0.999);
  dealii::GridGenerator::hyper_shell(ring, Point<2>(), 1.0, 2.0, 16);
  disc.refine_global(2);
  dealii::Triangulation<2> flat;
  dealii::GridGenerator::flatten_triangulation(disc, flat);
  dealii::GridGenerator::extrude_triangulation(flat, 3, 1.0, inner);
  dealii::GridGenerator::extrude_triangulation(ring, 3, 1.0, outer);
  for (const auto& cell : inner.active_cell_iterators()) cell->set_material_id(1);
  dealii::GridGenerator::merge_triangulations(inner, outer, both, 0);
  Domain<3> domain = domain_of(both);
  domain.set_rotor({});
  PointLocation<3> location;
  location.build(domain);
  const double angle = 0.7;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1.9, 1.9);
  for (int i = 0; i < 2000; ++i) {
    const Point<3> x(uniform(random), uniform(random), 0.25 * (uniform(random) + 2));
    const double r = std::hypot(x[0], x[1]);
    if (r > 1.9 || std::abs(r - 1) < 0.03) continue;  // facets of the interface do not match when turned
    location.turn_to(0);
    const int before = location.cell_of(x);
    location.turn_to(angle);
    const Point<3> turned(std::cos(angle) * x[0] - std::sin(angle) * x[1],
                          std::sin(angle) * x[0] + std::cos(angle) * x[1], x[2]);
    EXPECT_EQ(location.cell_of(r < 1 ? turned : x), before);
    EXPECT_EQ(location.cell_of(r < 1 ? turned : x, before), before);
    bool visited = before == PointLocation<3>::not_here;
    const Point<3> at = r < 1 ? turned : x;
    location.cells_in_box(at, at, [&](int c) { visited = visited || c == before; });
    EXPECT_TRUE(visited);
  }
  // Built where the rotor has turned to, it finds the same.
  domain.turn_to(angle);
  PointLocation<3> anew;
  anew.build(domain);
  for (int i = 0; i < 2000; ++i) {
    const Point<3> x(uniform(random), uniform(random), 0.25 * (uniform(random) + 2));
    if (std::abs(std::hypot(x[0], x[1]) - 1) < 0.03) continue;
    EXPECT_EQ(anew.cell_of(x), location.cell_of(x));
  }
}

TEST(HexahedraLocation, aMeshOfBoxesGivesTheSameCellsAsTheLattice) {
  DomainParameters box;
  box.upper = {0.3, 0.2, 0.4};
  box.cells = {3, 4, 5};
  Domain<3> domain(box, MPI_COMM_SELF);
  refine_near(domain, {0.1, 0.1, 0.1}, 0.1, 2);
  PointLocation<3> lattice, general;
  lattice.build(domain.triangulation(), {0, 0, 0}, {0.3, 0.2, 0.4}, {{3, 4, 5}});
  general.build(domain);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  int guess = PointLocation<3>::not_here;
  for (int i = 0; i < 5000; ++i) {
    const Point<3> x(0.3 * uniform(random), 0.2 * uniform(random), 0.4 * uniform(random));
    guess = general.cell_of(x, guess);
    EXPECT_EQ(guess, lattice.cell_of(x));
  }
}

}  // namespace
}  // namespace seedflow
