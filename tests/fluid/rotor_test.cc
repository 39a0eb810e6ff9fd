#include <gtest/gtest.h>

#include <cmath>

#include "../mesh/rotor_mesh.h"
#include "seedflow/fluid/fluid.h"

// The air with a part of its mesh that turns.

namespace seedflow {
namespace {

using Mode = RotorMotion::Mode;

FluidParameters parameters(const std::string& conditions, double viscosity) {
  FluidParameters p;
  p.density = 1;
  p.viscosity = viscosity;
  p.boundary_conditions = conditions;
  p.pressure_tolerance = 1e-13;
  p.momentum_tolerance = 1e-13;
  return p;
}

template <int dim>
void expect_mass_kept(const Fluid<dim>& fluid) {
  EXPECT_LT(fluid.mass_balance().largest, 1e-8);
  EXPECT_LT(fluid.mass_balance().total, 1e-8);
  const auto [out, in] = fluid.interface_flow();
  EXPECT_LT(std::abs(out - in), 1e-8 * fluid.mass_balance().flow);
}
template <int dim>
void expect_balanced(const Fluid<dim>& fluid) {
  expect_mass_kept(fluid);
  EXPECT_LT(fluid.momentum_balance().residual, 1e-8);
}

/// A uniform stream does not notice that part of the mesh turns, though the cells of both sides end at chords
/// and there are hanging nodes at the interface. (A sector is refined over its whole depth: elsewhere a
/// curved mesh with hanging nodes would have gaps of its own.)
TEST(RotorMpi, FreeStreamThroughTurningRing) {
  const auto domain = ring(0.4, 0.7, 1, 9, 14, 1, 1);
  for (const auto& cell : domain->triangulation().active_cell_iterators())
    if (cell->is_locally_owned() && std::abs(std::atan2(cell->center()[1], cell->center()[0])) < 1)
      cell->set_refine_flag();
  domain->triangulation().execute_coarsening_and_refinement();
  Fluid<2> fluid(parameters("*: velocity inlet, 1, 0.5", 1e-3), *domain);
  const dealii::Tensor<1, 2> stream({1, 0.5});
  fluid.set_rotor_motion({Mode::sliding, 3.0});
  fluid.set_initial(
      0, [&](const auto&) { return stream; }, [](const auto&) { return 0.0; });
  for (int s = 1; s <= 8; ++s) {
    fluid.turn_to(3.0 * 0.05 * s);
    fluid.advance(0.05, {});
    expect_mass_kept(fluid);  // forces are nothing but round-off here
    double largest = 0;
    for (const auto& u : fluid.velocity()) largest = std::max(largest, (u - stream).norm());
    EXPECT_LT(largest, 1e-10) << s;
  }
}

/// The same in space, through a cylinder with hanging nodes at arbitrary angles, and through a plane; there
/// the square turns by quarters, so that no part of it is without partner (it would be a wall).
TEST(RotorMpi, FreeStreamInSpace) {
  const dealii::Tensor<1, 3> stream({1, 0.5, 0.3});
  const auto expect_kept = [&](Domain<3>& domain, double turn) {
    const double dt = 0.05;
    Fluid<3> fluid(parameters("*: velocity inlet, 1, 0.5, 0.3", 1e-3), domain);
    fluid.set_rotor_motion({Mode::sliding, turn / dt});
    fluid.set_initial(
        0, [&](const auto&) { return stream; }, [](const auto&) { return 0.0; });
    for (int s = 1; s <= 5; ++s) {
      fluid.turn_to(turn * s);
      fluid.advance(dt, {});
      expect_mass_kept(fluid);
      double largest = 0;
      for (const auto& u : fluid.velocity()) largest = std::max(largest, (u - stream).norm());
      EXPECT_LT(largest, 1e-10) << turn << " step " << s;
    }
  };
  const auto cylinder = tube(0.4, 0.7, 1, 16, 24, 0);
  for (const auto& cell : cylinder->triangulation().active_cell_iterators())
    if (cell->is_locally_owned() && std::abs(std::atan2(cell->center()[1], cell->center()[0])) < 1)
      cell->set_refine_flag();
  cylinder->triangulation().execute_coarsening_and_refinement();
  expect_kept(*cylinder, 0.15);
  const auto plane = blocks(1, 3, 1, 4, 0.1);
  refine_some(*plane);
  expect_kept(*plane, dealii::numbers::PI / 2);
}

/// Air blown across a turning cylinder: mass and momentum balance although the interface cuts through the
/// wake.
TEST(RotorMpi, CrossFlowBalances) {
  for (const Mode mode : {Mode::frozen, Mode::sliding}) {
    const auto domain = ring(0.4, 0.7, 1, 9, 14, 1, 1);
    Fluid<2> fluid(parameters("inner: rotor wall; outer: velocity inlet, 1 + 0.2*y, 0.5", 1e-2), *domain);
    fluid.set_rotor_motion({mode, 3.0});
    for (int s = 1; s <= 8; ++s) {
      fluid.turn_to(mode == Mode::sliding ? 3.0 * 0.05 * s : 0.4);
      fluid.advance(0.05, {});
      expect_balanced(fluid);
    }
  }
}

/// Air that turns like a solid body with the rotor: steady in a frozen rotor, steady in a sliding one, with
/// the pressure rho (omega r)^2 / 2.
TEST(RotorMpi, SolidBodyRotation) {
  for (const Mode mode : {Mode::frozen, Mode::sliding}) {
    double before = 0;
    for (int refinements : {1, 2}) {
      const auto domain = ring(0.4, 0.7, 1, 9, 14, 2, refinements);
      Fluid<2> fluid(parameters("inner: rotor wall; outer: velocity inlet, -2*y, 2*x", 1e-2), *domain);
      const auto exact = [](const dealii::Point<2>& x) {
        return dealii::Tensor<1, 2>({-2 * x[1], 2 * x[0]});
      };
      const auto pressure = [](const dealii::Point<2>& x) { return 2 * x.norm_square(); };
      fluid.set_rotor_motion({mode, 2.0});
      fluid.set_initial(0, exact, pressure);
      const double dt = 0.04 / refinements;  // the first, first-order step must not hide the order
      for (int s = 1; s * dt < 0.81; ++s) {
        if (mode == Mode::sliding) fluid.turn_to(2 * dt * s);
        fluid.advance(dt, {});
        expect_mass_kept(fluid);
      }
      const auto e = fluid.errors(exact, pressure);
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << (mode == Mode::frozen ? "frozen " : "sliding ") << refinements << " u " << e.velocity
                  << " p " << e.pressure << "\n";
      if (before > 0) {
        EXPECT_LT(e.velocity, before / 3);
      }
      before = e.velocity;
    }
    EXPECT_LT(before, 0.01);  // the speed is about 1.5
  }
}

/// Flow between concentric cylinders, the inner one turning at 1 rad/s, u = a r + b/r, with the sliding
/// interface in the middle of the gap. The outer wall feels the moment 4 pi mu b per length.
TEST(RotorMpi, TaylorCouette) {
  const double inner = 0.5, outer = 1, b = 1 / (1 / (inner * inner) - 1 / (outer * outer)), a = -b, mu = 0.1;
  for (const Mode mode : {Mode::frozen, Mode::sliding}) {
    double before = 0, outer_before = 0;
    for (int refinements : {0, 1, 2}) {
      const auto domain = ring(inner, 0.75, outer, 16, 20, 2, refinements);
      Fluid<2> fluid(parameters("inner: rotor wall; outer: wall", mu), *domain);
      const auto exact = [&](const dealii::Point<2>& x) {
        const double f = a + b / x.norm_square();
        return dealii::Tensor<1, 2>({-f * x[1], f * x[0]});
      };
      const auto pressure = [&](const dealii::Point<2>& x) {
        const double r2 = x.norm_square();
        return a * a * r2 / 2 + a * b * std::log(r2) - b * b / (2 * r2);
      };
      fluid.set_rotor_motion({mode, 1.0});
      fluid.set_initial(0, exact, pressure);
      const double dt = 0.1;
      for (int s = 1; s <= 20; ++s) {
        if (mode == Mode::sliding) fluid.turn_to(dt * s);
        fluid.advance(dt, {});
        expect_mass_kept(fluid);
      }
      const auto e = fluid.errors(exact, pressure);
      const double torque = 4 * dealii::numbers::PI * mu * b;
      const double outer_error = std::abs(fluid.momentum_balance().torque.at("outer") / torque + 1);
      EXPECT_NEAR(fluid.momentum_balance().torque.at("inner"), torque, 0.02 * torque);
      EXPECT_LT(outer_error, 0.02);
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << (mode == Mode::frozen ? "frozen " : "sliding ") << refinements << " u " << e.velocity
                  << " " << e.nodal_velocity << " p " << e.pressure << " torque inner "
                  << fluid.momentum_balance().torque.at("inner") / torque << " outer "
                  << fluid.momentum_balance().torque.at("outer") / torque << "\n";
      if (before > 0) {
        EXPECT_LT(e.velocity, before / 3);
        EXPECT_LT(outer_error, outer_before / 3);
      }
      before = e.velocity;
      outer_before = outer_error;
    }
  }
}

/// A block turning under a larger one, air blown through: what leaves the rotor enters the stator, mass and
/// momentum balance, in both modes, at general faces with hanging nodes that only partly have partners.
TEST(RotorMpi, BlownThroughBlocks) {
  double inflow = 0;
  for (const Mode mode : {Mode::frozen, Mode::sliding}) {
    const auto domain = blocks(0.5, 3, 1, 4, 0.1);
    refine_some(*domain);
    Fluid<3> fluid(
        parameters("rotor wall: rotor wall; floor: velocity inlet, 0, 0, 1; lid: pressure outlet, 0; "
                   "stator wall: wall",
                   1e-2),
        *domain);
    fluid.set_rotor_motion({mode, 2.0});
    for (int s = 1; s <= 4; ++s) {
      fluid.turn_to(mode == Mode::sliding ? 0.1 * s : 0.6);
      fluid.advance(0.05, {});
      expect_balanced(fluid);
      // What enters at the floor: 1, less what the walls around it hold back in the outermost cells.
      if (inflow == 0) inflow = fluid.interface_flow()[0];
      EXPECT_NEAR(fluid.interface_flow()[0], inflow, 1e-8);
      EXPECT_GT(inflow, 0.4);
      EXPECT_LT(inflow, 1);
    }
  }
}

/// The same numbers on all ranks together as on each alone.
TEST(RotorMpi, SameOnAnyNumberOfRanks) {
  const auto run = [](MPI_Comm comm) {
    const auto domain = blocks(0.5, 3, 1, 4, 0.1, comm);
    refine_some(*domain);
    Fluid<3> fluid(
        parameters("rotor wall: rotor wall; floor: velocity inlet, 0, 0, 1; lid: pressure outlet, 0; "
                   "stator wall: wall",
                   1e-2),
        *domain);
    fluid.set_rotor_motion({Mode::sliding, 2.0});
    for (int s = 1; s <= 3; ++s) {
      fluid.turn_to(0.1 * s);
      fluid.advance(0.05, {});
    }
    const auto e =
        fluid.errors([](const auto&) { return dealii::Tensor<1, 3>(); }, [](const auto&) { return 0.0; });
    std::vector<double> values{e.velocity, e.nodal_velocity, e.pressure, fluid.interface_flow()[0]};
    for (const auto& [name, f] : fluid.momentum_balance().reaction) values.push_back(f[2]);
    for (const auto& [name, f] : fluid.momentum_balance().pressure_force) values.push_back(f[2]);
    return values;
  };
  const auto together = run(MPI_COMM_WORLD), alone = run(MPI_COMM_SELF);
  ASSERT_EQ(together.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i)
    EXPECT_NEAR(together[i], alone[i], 1e-9 * (std::abs(alone[i]) + 1)) << i;
}

}  // namespace
}  // namespace seedflow
