#include <gtest/gtest.h>

#include <sstream>

#include "manufactured.h"

// One answer on any number of ranks, by either backend, with and without a checkpoint between.

namespace seedflow {
namespace {

struct Answer {
  std::vector<double> values;
};

/// Norms and balances of a few steps with hanging nodes; the same on all ranks.
template <int dim>
Answer run(const std::string& backend, const std::string& preconditioner, MPI_Comm comm) {
  DomainParameters box;
  box.cells.assign(dim, dim == 2 ? 8 : 4);
  Domain<dim> domain(box, comm);
  for (const auto& cell : domain.triangulation().active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[0] + cell->center()[1] < 0.8) cell->set_refine_flag();
  domain.triangulation().execute_coarsening_and_refinement();
  FluidParameters p;
  p.density = 1;
  p.viscosity = 0.01;
  p.backend = backend;
  p.momentum_preconditioner = preconditioner;
  p.pressure_tolerance = p.momentum_tolerance = 1e-13;
  const std::string zero = dim == 3 ? ", 0" : "";
  p.boundary_conditions =
      "left: velocity inlet, 1+0.2*t, 0.3*y" + zero + "; right: pressure outlet, y; top: slip; *: wall";
  Fluid<dim> fluid(p, domain);
  Answer a;
  for (int s = 1; s <= 4; ++s) {
    Exchange<dim> e;
    e.clear(fluid.layout().size());
    for (std::size_t i = 0; i < e.void_fraction.size(); ++i) {
      const auto& x = fluid.layout().position[i];
      e.void_fraction[i] = 0.8 + 0.15 * std::cos(3 * x[0] + 2 * x[1] + 0.1 * s);
      e.drag_coefficient[i] = 100 * (1 - e.void_fraction[i]);
      e.force[i][1] = x[0];
    }
    fluid.advance(0.05, e);
    EXPECT_LT(fluid.mass_balance().largest, 1e-8);
    EXPECT_LT(fluid.momentum_balance().residual, 1e-8);
  }
  const auto norms =
      fluid.errors([](const auto&) { return dealii::Tensor<1, dim>(); }, [](const auto&) { return 0.0; });
  a.values = {norms.velocity, norms.nodal_velocity, norms.pressure};
  for (int d = 0; d < dim; ++d) a.values.push_back(fluid.momentum()[d]);
  for (const auto& [name, r] : fluid.momentum_balance().reaction) a.values.push_back(r[0]);
  for (const auto& [name, r] : fluid.momentum_balance().pressure_force) a.values.push_back(r[0]);
  return a;
}

void expect_same(const Answer& a, const Answer& b, double tolerance) {
  ASSERT_EQ(a.values.size(), b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i)
    EXPECT_NEAR(a.values[i], b.values[i], tolerance * std::max(1.0, std::abs(b.values[i]))) << i;
}

/// Rank 0 computes the reference alone on its own communicator.
template <int dim>
void expect_same_as_alone() {
  const Answer together = run<dim>("trilinos", "jacobi", MPI_COMM_WORLD),
               alone = run<dim>("trilinos", "jacobi", MPI_COMM_SELF);
  expect_same(together, alone, 1e-8);
}
TEST(FluidMpi, AnyNumberOfRanks2d) {
  expect_same_as_alone<2>();
}
TEST(FluidMpi, AnyNumberOfRanks3d) {
  expect_same_as_alone<3>();
}

TEST(FluidMpi, BackendsAgree) {
  const Answer reference = run<3>("trilinos", "jacobi", MPI_COMM_WORLD);
  expect_same(run<3>("trilinos", "ilu", MPI_COMM_WORLD), reference, 1e-8);
  expect_same(run<3>("petsc", "jacobi", MPI_COMM_WORLD), reference, 1e-8);
  expect_same(run<3>("petsc", "ilu", MPI_COMM_WORLD), reference, 1e-8);
}

/// Saved in the middle of a run with a changing matrix and an adapted mesh, loaded into a new domain and
/// continued: not one bit differs.
void expect_restart_equals_no_restart(const std::string& backend) {
  const Manufactured<2> m;
  const auto conditions = [&](const Domain<2>& d) { return m.conditions(d); };
  FluidParameters p = m.parameters();
  p.backend = backend;
  const auto domain = unit_box<2>(8);
  Fluid<2> fluid(p, *domain, conditions(*domain));
  m.start(fluid, 0.1);
  const auto advance = [&](Fluid<2>& f) { f.advance(0.02, m.exchange(f.layout(), f.time() + 0.02)); };
  for (int s = 0; s < 8; ++s) {
    if (s == 2 || s == 4) {
      for (const auto& cell : domain->triangulation().active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        if (cell->center().distance({0.2 * s, 0.5}) < 0.25) cell->set_refine_flag();
        if (s == 4 && cell->level() > 0 && cell->center()[0] < 0.4) cell->set_coarsen_flag();
      }
      fluid.refine([&](const auto& layout) { return m.eps_at(layout, fluid.time()); });
    }
    advance(fluid);
  }
  const std::string prefix = testing::TempDir() + "air_" + backend + "_" +
                             std::to_string(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  domain->save(prefix);
  std::stringstream state;
  fluid.save(state);

  const auto domain2 = unit_box<2>(8);
  domain2->load(prefix);
  Fluid<2> fluid2(p, *domain2, conditions(*domain2));
  fluid2.load(state);
  for (int s = 0; s < 6; ++s) {
    advance(fluid);
    advance(fluid2);
  }
  ASSERT_EQ(fluid.time(), fluid2.time());
  const auto e = m.errors(fluid), e2 = m.errors(fluid2);
  // Sums over points in the layout's order may differ in the last bit; each value may not.
  EXPECT_EQ(fluid.momentum(), fluid2.momentum());
  EXPECT_EQ(e.velocity, e2.velocity);
  EXPECT_EQ(e.pressure, e2.pressure);
  EXPECT_EQ(fluid.statistics().pressure_iterations, fluid2.statistics().pressure_iterations);
}
TEST(FluidMpi, RestartEqualsNoRestartTrilinos) {
  expect_restart_equals_no_restart("trilinos");
}
TEST(FluidMpi, RestartEqualsNoRestartPetsc) {
  expect_restart_equals_no_restart("petsc");
}

}  // namespace
}  // namespace seedflow
