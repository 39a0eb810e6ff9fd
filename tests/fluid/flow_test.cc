#include <gtest/gtest.h>

#include <iostream>

#include "manufactured.h"

// Flows with closed-form answers, the balances at open sides, moving void fractions, refinement.

namespace seedflow {
namespace {

FluidParameters parameters(const std::string& conditions, double viscosity = 0.1) {
  FluidParameters p;
  p.density = 1;
  p.viscosity = viscosity;
  p.boundary_conditions = conditions;
  return p;
}

template <int dim>
void expect_balanced(const Fluid<dim, 1>& fluid) {
  EXPECT_LT(fluid.mass_balance().largest, 1e-8);
  EXPECT_LT(fluid.mass_balance().total, 1e-8);
  EXPECT_LT(fluid.momentum_balance().residual, 1e-8);
}

/// u = 4 y (1 - y), dp/dx = -8 mu: nodally exact on uniform Q1 elements except for the midpoint rule of the
/// parabola.
TEST(Flow, PoiseuilleFromVelocityInletToPressureOutlet) {
  DomainParameters box;
  box.cells = {12, 16};
  box.upper = {2, 1, 0};
  Domain<2> domain(box, MPI_COMM_WORLD);
  Fluid<2> fluid(parameters("left: velocity inlet, 4*y*(1-y), 0; right: pressure outlet, 3; *: wall"),
                 domain);
  const Exchange<2> nothing;
  for (int s = 0; s < 60; ++s) {
    fluid.advance(0.2, nothing);
    expect_balanced(fluid);
  }
  const auto e = fluid.errors(
      [](const auto& x) {
        return dealii::Tensor<1, 2>({4 * x[1] * (1 - x[1]), 0});
      },
      [](const auto& x) { return 3 + 0.8 * (2 - x[0]); });
  EXPECT_LT(e.nodal_velocity, 0.005);  // interpolation error h^2/8 |u''| = 0.0039 at most
  EXPECT_LT(e.pressure, 0.02);         // 1 % of the pressure difference 1.6 over an area of 2
  // Forces on the air: steady, so the shear of both walls, 2 * mu * |du/dy| * L = 1.6, balances the pressure.
  const auto& m = fluid.momentum_balance();
  EXPECT_NEAR(m.reaction.at("bottom")[0] + m.reaction.at("top")[0], -1.6, 0.03);
  EXPECT_NEAR(m.pressure_force.at("left")[0] + m.pressure_force.at("right")[0], 1.6, 0.03);
}

/// Driven by the pressure difference alone: the same flow, now with its rate as the answer.
TEST(Flow, PoiseuilleFromPressureInlet) {
  DomainParameters box;
  box.cells = {12, 16};
  box.upper = {2, 1, 0};
  Domain<2> domain(box, MPI_COMM_WORLD);
  Fluid<2> fluid(parameters("left: pressure inlet, 1.6; right: pressure outlet, 0; *: wall"), domain);
  for (int s = 0; s < 80; ++s) fluid.advance(0.2, {});
  expect_balanced(fluid);
  const auto e = fluid.errors(
      [](const auto& x) {
        return dealii::Tensor<1, 2>({4 * x[1] * (1 - x[1]), 0});
      },
      [](const auto& x) { return 0.8 * (2 - x[0]); });
  EXPECT_LT(e.nodal_velocity, 0.015);
  EXPECT_LT(e.pressure, 0.02);
}

/// Couette flow between a moving wall and a wall, periodic along it: linear, so exact once the start has died
/// out. The slowest mode decays with pi^2 nu = 1/s, by exp(-30) = 1e-13 until t = 30 s.
TEST(Flow, CouettePeriodic) {
  const auto domain = unit_box<3>(4, true, {"left-right", "front-back"});
  Fluid<3> fluid(parameters("bottom: wall; top: moving wall, 1, 0.5, 0"), *domain);
  for (int s = 0; s < 150; ++s) fluid.advance(0.2, {});
  const auto e = fluid.errors(
      [](const auto& x) {
        return dealii::Tensor<1, 3>({x[2], 0.5 * x[2], 0});
      },
      [](const auto&) { return 0.0; });
  EXPECT_LT(e.velocity, 1e-8);
  EXPECT_LT(e.pressure, 1e-8);
  EXPECT_NEAR(fluid.momentum_balance().reaction.at("top")[0], 0.1, 1e-8);  // mu du/dz times area
}

/// Uniform flow through inlet, outlet, slip sides and hanging nodes, in air with a void fraction that jumps
/// nowhere but is below one: nothing may disturb it.
TEST(Flow, FreeStreamIsPreserved) {
  for (const std::string formulation : {"A", "B"}) {
    const auto domain = unit_box<3>(4, true);
    FluidParameters p = parameters("left: velocity inlet, 1, 0, 0; right: pressure outlet, 0; *: slip", 1e-3);
    p.formulation = formulation;
    Fluid<3> fluid(p, *domain);
    Exchange<3> exchange;
    exchange.void_fraction.assign(fluid.layout().size(), 0.6);
    fluid.set_initial(
        0,
        [](const auto&) {
          return dealii::Tensor<1, 3>({1, 0, 0});
        },
        [](const auto&) { return 0.0; }, exchange.void_fraction);
    for (int s = 0; s < 5; ++s) fluid.advance(0.1, exchange);
    const auto e = fluid.errors(
        [](const auto&) {
          return dealii::Tensor<1, 3>({1, 0, 0});
        },
        [](const auto&) { return 0.0; });
    EXPECT_LT(e.velocity, 1e-9);
    EXPECT_LT(e.pressure, 1e-9);
    expect_balanced(fluid);
  }
}

/// Darcy flow through a bed whose drag and void fraction jump between two cells: u = Q/eps, dp/dx = -beta u /
/// c. With the strongest drag the pressure is 4e7 Pa in the bed, and its round-off of 1e-8 Pa would move the
/// free air in front of it by dt/rho grad p = 3e-8 m/s if the velocity were not refined.
TEST(Flow, BedWithSharpFront) {
  for (const double beta : {1e2, 1e5, 1e8}) {
    DomainParameters box;
    box.cells = {32, 4};
    box.upper = {1, 0.125, 0};
    Domain<2> domain(box, MPI_COMM_WORLD);
    FluidParameters p = parameters("left: velocity inlet, 0.3, 0; right: pressure outlet, 0; *: slip", 1e-4);
    p.formulation = "B";
    Fluid<2> fluid(p, domain);
    Exchange<2> exchange;
    exchange.clear(fluid.layout().size());
    for (std::size_t i = 0; i < fluid.layout().size(); ++i)
      if (fluid.layout().position[i][0] > 0.5) {
        exchange.void_fraction[i] = 0.4;
        exchange.drag_coefficient[i] = beta;
      }
    double worst = 0;
    for (int s = 0; s < 40; ++s) {
      fluid.advance(0.1, exchange);
      worst = std::max({worst, fluid.mass_balance().largest, fluid.mass_balance().total});
      EXPECT_LT(fluid.mass_balance().largest, 1e-8) << beta;
      EXPECT_LT(fluid.mass_balance().total, 1e-8) << beta;
      EXPECT_LT(fluid.momentum_balance().residual, 1e-8) << beta;
    }
    std::cout << "drag " << beta << " kg/(m3 s): mass residual " << worst << " of the flow\n";
    const auto u = fluid.velocity();
    const auto g = fluid.pressure_gradient();
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double x = fluid.layout().position[i][0];
      const double exact = 0.3 / exchange.void_fraction[i];
      if (std::abs(x - 0.5) > 0.1) {
        EXPECT_NEAR(u[i][0], exact, 0.02 * exact) << beta << " at " << x;
      }
      if (x > 0.6) {
        EXPECT_NEAR(g[i][0], -beta * exact, 0.02 * beta * exact) << beta << " at " << x;
      }
    }
  }
}

/// A ball of low void fraction moves through a closed box of still air: void volume is kept, so mass must be
/// too, and the air must flow back by as much volume as the ball carries forward, int eps u = -int (1 - eps)
/// v.
TEST(Flow, MovingBallInClosedBox) {
  const auto domain = unit_box<2>(16, true);
  Fluid<2> fluid(parameters("*: wall", 1e-2), *domain);
  const auto& layout = fluid.layout();
  const auto exchange = [&](double t) {
    Exchange<2> e;
    e.clear(layout.size());
    double volume = 0;
    for (std::size_t i = 0; i < layout.size(); ++i) {
      const double r = layout.position[i].distance({0.3 + t, 0.5}) / 0.15;
      const double solid = r < 1 ? std::pow(1 - r * r, 2) : 0;
      volume += solid * layout.JxW[i];
      e.void_fraction[i] = solid;
      e.drag_coefficient[i] = 1e4 * solid;
      e.drag_source[i][0] = 1e4 * solid;  // the ball moves with velocity 1
    }
    for (double& v : e.void_fraction) v = 1 - v * 0.012 / volume;  // exact volume, as kernels give it
    return e;
  };
  fluid.set_initial(
      0, [](const auto&) { return dealii::Tensor<1, 2>(); }, [](const auto&) { return 0.0; },
      exchange(0).void_fraction);
  for (int s = 1; s <= 40; ++s) {
    fluid.advance(0.01, exchange(0.01 * s));
    expect_balanced(fluid);
    // The quadrature of the ball's volume wobbles by about a per cent as it crosses the cells.
    if (s > 1) {
      EXPECT_NEAR(fluid.momentum()[0], -0.012, 0.03 * 0.012) << s;
    }
    EXPECT_NEAR(fluid.momentum()[1], 0, 1e-6) << s;
  }
}

/// After refinement and coarsening mass is kept again in the next step, and the flow is still there.
TEST(Flow, RefinementKeepsFlowAndBalances) {
  const Manufactured<2> m;
  const auto domain = unit_box<2>(16);
  FluidParameters p = m.parameters();
  Fluid<2> fluid(p, *domain, m.conditions(*domain));
  m.start(fluid, 0.1);
  const auto momentum = [&] {
    dealii::Tensor<1, 2> sum;
    const auto u = fluid.velocity();
    const auto& layout = fluid.layout();
    for (std::size_t i = 0; i < u.size(); ++i)
      sum += m.density * m.eps(layout.position[i], fluid.time()) * layout.JxW[i] * u[i];
    return sum;
  };
  for (int s = 0; s < 20; ++s) {
    if (s % 6 == 5) {
      const auto before = momentum();
      for (const auto& cell : domain->triangulation().active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        if (cell->center().distance({0.1 * s / 2, 0.5}) < 0.25)
          cell->set_refine_flag();
        else if (cell->level() > 0)
          cell->set_coarsen_flag();
      }
      fluid.refine([&](const auto& layout) { return m.eps_at(layout, fluid.time()); });
      EXPECT_LT((momentum() - before).norm(), 1e-13) << s;  // the flow's is about 1
    }
    fluid.advance(0.0125, m.exchange(fluid.layout(), fluid.time() + 0.0125));
    EXPECT_LT(fluid.mass_balance().largest, 1e-8) << s;
    EXPECT_LT(fluid.momentum_balance().residual, 1e-8) << s;
  }
  EXPECT_LT(m.errors(fluid).velocity, 6e-3);  // 4e-3 on the uniform mesh, plus three first-order steps
}

/// Backflow at an outlet must not blow up: a strong vortex is pushed through it.
TEST(Flow, VortexLeavesThroughOutlet) {
  DomainParameters box;
  box.cells = {24, 12};
  box.upper = {2, 1, 0};
  Domain<2> domain(box, MPI_COMM_WORLD);
  Fluid<2> fluid(parameters("left: velocity inlet, 1, 0; right: pressure outlet, 0; *: slip", 1e-4), domain);
  fluid.set_initial(
      0,
      [](const dealii::Point<2>& x) {
        const dealii::Tensor<1, 2> r = x - dealii::Point<2>(1.4, 0.5);
        const double f = 25 * std::exp(-r.norm_square() / 0.02);
        return dealii::Tensor<1, 2>({1 - f * r[1], f * r[0]});
      },
      [](const auto&) { return 0.0; });
  for (int s = 0; s < 120; ++s) {
    fluid.advance(0.02, {});
    expect_balanced(fluid);
  }
  const auto e = fluid.errors(
      [](const auto&) {
        return dealii::Tensor<1, 2>({1, 0});
      },
      [](const auto&) { return 0.0; });
  EXPECT_LT(e.velocity, 0.3);  // the vortex itself had a velocity of 2
}

}  // namespace
}  // namespace seedflow
