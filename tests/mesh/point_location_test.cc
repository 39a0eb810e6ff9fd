#include "seedflow/mesh/point_location.h"

#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_generator.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

namespace seedflow {
namespace {

using dealii::Point;

/// A 3 x 4 x 5 box of cells, refined twice around a corner region, and the number of each owned cell.
struct RefinedBox {
  dealii::parallel::distributed::Triangulation<3> triangulation{MPI_COMM_WORLD};
  PointLocation<3> location;
  std::vector<dealii::Triangulation<3>::active_cell_iterator> owned;

  RefinedBox() {
    const Point<3> lower(-0.1, 0.2, 0.0), upper(0.2, 0.7, 1.1);
    dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, {3, 4, 5}, lower, upper);
    for (int cycle = 0; cycle < 2; ++cycle) {
      for (const auto& cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->center().distance(Point<3>(0, 0.4, 0.5)) < 0.25)
          cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
    }
    location.build(triangulation, lower, upper, {{3, 4, 5}});
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned()) owned.push_back(cell);
  }
};

TEST(PointLocationMpi, everyPointIsInTheCellThatContainsIt) {
  RefinedBox box;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 5000; ++i) {
    const Point<3> x(-0.1 + 0.3 * uniform(random), 0.2 + 0.5 * uniform(random), 1.1 * uniform(random));
    const int cell = box.location.cell_of(x);
    if (cell >= 0) {
      EXPECT_TRUE(box.owned.at(cell)->point_inside(x));
    }
    const int holders = dealii::Utilities::MPI::sum(cell >= 0 ? 1 : 0, MPI_COMM_WORLD);
    EXPECT_EQ(holders, 1) << "a point must belong to exactly one rank";
  }
}

TEST(PointLocationMpi, outsideAndBoundary) {
  RefinedBox box;
  EXPECT_EQ(box.location.cell_of({-0.11, 0.4, 0.5}), PointLocation<3>::not_here);
  EXPECT_EQ(box.location.cell_of({0.0, 0.4, std::nan("")}), PointLocation<3>::not_here);
  const int holders =
      dealii::Utilities::MPI::sum(box.location.cell_of({0.2, 0.7, 1.1}) >= 0 ? 1 : 0, MPI_COMM_WORLD);
  EXPECT_EQ(holders, 1);
}

TEST(PointLocationMpi, cellsInBoxAreThoseThatOverlap) {
  RefinedBox box;
  const Point<3> low(-0.03, 0.31, 0.28), high(0.07, 0.52, 0.64);
  std::set<int> found;
  box.location.cells_in_box(low, high,
                            [&](int c) { EXPECT_TRUE(found.insert(c).second) << "visited twice"; });
  for (unsigned int c = 0; c < box.owned.size(); ++c) {
    const auto bounds = box.owned[c]->bounding_box().get_boundary_points();
    bool overlaps = true;
    for (int d = 0; d < 3; ++d)
      overlaps = overlaps && bounds.first[d] <= high[d] && bounds.second[d] >= low[d];
    EXPECT_EQ(found.count(c) == 1, overlaps) << "cell " << c;
  }
}

}  // namespace
}  // namespace seedflow
