#include "seedflow/mesh/refinement.h"

#include <gtest/gtest.h>

#include "manufactured.h"

// The criteria of mesh/refinement together with the solver that follows them.

namespace seedflow {
namespace {

/// Cells near a seed reach the highest level, far cells the lowest, neighbours differ by one level at most,
/// the same cells on any number of ranks; when the seed leaves, the mesh becomes coarse again.
TEST(RefinementMpi, FollowsASeed) {
  DomainParameters box;
  box.cells = {4, 4};
  const auto domain = std::make_unique<Domain<2>>(box, MPI_COMM_WORLD);
  Domain<2> alone(box, MPI_COMM_SELF);
  Fluid<2> fluid({}, *domain), fluid_alone({}, alone);
  RefinementParameters p;
  p.seed_distance = 0.05;
  p.max_level = 3;
  const std::vector<dealii::Point<2>> seed = {{0.52, 0.52}};
  for (int i = 0; i < 4; ++i) {
    if (flag_cells(p, *domain, fluid.layout(), {}, {}, seed)) fluid.refine({});
    if (flag_cells(p, alone, fluid_alone.layout(), {}, {}, seed)) fluid_alone.refine({});
  }
  double fine = 0;
  for (const auto& cell : domain->triangulation().active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    const double d = cell->center().distance(seed[0]);
    if (d < 0.05) {
      EXPECT_EQ(cell->level(), 3);
    }
    if (d > 0.5) {
      EXPECT_EQ(cell->level(), 0);
    }
    fine += cell->level() == 3;
    for (const unsigned int f : cell->face_indices())
      if (!cell->at_boundary(f) && cell->neighbor(f)->is_active()) {
        EXPECT_LE(std::abs(cell->neighbor(f)->level() - cell->level()), 1);
      }
  }
  fine = dealii::Utilities::MPI::sum(fine, MPI_COMM_WORLD);
  EXPECT_GE(fine, 8);  // the area of the disc alone, pi 0.05^2 32^2
  EXPECT_EQ(domain->triangulation().n_global_active_cells(), alone.triangulation().n_global_active_cells());
  for (int i = 0; i < 5; ++i)
    if (flag_cells(p, *domain, fluid.layout(), {}, {}, {{9, 9}})) fluid.refine({});
  EXPECT_EQ(domain->triangulation().n_global_active_cells(), 16u);
}

/// A void fraction constant in each cell that jumps at x = 0.5: both rows of cells along the jump are
/// refined, no other.
TEST(RefinementMpi, SeesJumpsBetweenCells) {
  const auto domain = unit_box<2>(8);
  Fluid<2> fluid({}, *domain);
  RefinementParameters p;
  p.void_fraction_jump = 0.1;
  p.max_level = 1;
  std::vector<double> eps;
  for (const auto& x : fluid.layout().position) eps.push_back(x[0] < 0.5 ? 1.0 : 0.6);
  ASSERT_TRUE(flag_cells(p, *domain, fluid.layout(), eps, {}, {}));
  for (const auto& cell : domain->triangulation().active_cell_iterators())
    if (cell->is_locally_owned()) {
      EXPECT_EQ(static_cast<unsigned int>(cell->refine_flag_set()) > 0,
                std::abs(cell->center()[0] - 0.5) < 0.1);
    }
}

TEST(RefinementMpi, SeesVelocityJumps) {
  const auto domain = unit_box<2>(8);
  Fluid<2> fluid({}, *domain);
  fluid.set_initial(
      0,
      [](const auto& x) {
        return dealii::Tensor<1, 2>({x[1] < 0.45 ? 0.0 : 1.0, 0});
      },
      [](const auto&) { return 0.0; });
  RefinementParameters p;
  p.velocity_jump = 0.5;
  p.max_level = 1;
  ASSERT_TRUE(flag_cells(p, *domain, fluid.layout(), {}, fluid.velocity_jump(), {}));
  for (const auto& cell : domain->triangulation().active_cell_iterators())
    if (cell->is_locally_owned()) {
      EXPECT_EQ(static_cast<unsigned int>(cell->refine_flag_set()) > 0,
                cell->center()[1] > 0.375 && cell->center()[1] < 0.5);
    }
}

}  // namespace
}  // namespace seedflow
