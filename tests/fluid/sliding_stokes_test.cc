#include <gtest/gtest.h>

#include <cmath>

#include "../mesh/rotor_mesh.h"
#include "seedflow/fluid/fluid.h"

// A slow flow made by a known force, with the sliding interface inside.

namespace seedflow {
namespace {

constexpr double inner = 0.4, middle = 0.7, outer = 1, height = 0.4;

/// Derivative by fourth-order differences; h^4 times the fifth derivative is below 1e-8 here.
template <typename F>
auto slope(const F& f, double h = 4e-3) {
  return (8.0 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

/// u = curl(psi A) between two cylinders, psi zero on both and in space on the ends too, so that u is along
/// all walls; A = e_z in the plane, (-y, x, x + 2y) in space. There the flow turns over in planes through
/// the axis as well. Viscosity 0.2, density 0.1: a Reynolds number of about 0.1.
template <int dim>
struct SlowFlow {
  using Vector = dealii::Tensor<1, dim>;
  using Point = dealii::Point<dim>;
  static constexpr double density = 0.1, viscosity = 0.2, scale = dim == 2 ? 2 : 60;

  static Vector velocity(const Point& x) {
    const double r2 = x[0] * x[0] + x[1] * x[1];
    const double w = scale * (r2 - inner * inner) * (outer * outer - r2);
    const double dw = scale * 2 * (outer * outer + inner * inner - 2 * r2);  // gradient is dw (x, y)
    Vector u;
    if constexpr (dim == 2) {
      // psi = w (1 + x)
      u[0] = dw * x[1] * (1 + x[0]);
      u[1] = -dw * x[0] * (1 + x[0]) - w;
    } else {
      const double g = x[2] * (height - x[2]), dg = height - 2 * x[2];
      const Vector gradient({dw * x[0] * g, dw * x[1] * g, w * dg}), a({-x[1], x[0], x[0] + 2 * x[1]});
      u = cross_product_3d(gradient, a) + w * g * Vector({2, -1, 2});
    }
    return u;
  }
  static double pressure(const Point& x) { return std::sin(2 * x[0]) * std::cos(x[1] + x[dim - 1]); }
  static Vector force(const Point& x) {
    const auto moved = [&](int d, double s) {
      Point y = x;
      y[d] += s;
      return y;
    };
    const Vector u = velocity(x);
    Vector f;
    for (int d = 0; d < dim; ++d) {
      f += density * u[d] * slope([&](double s) { return velocity(moved(d, s)); });
      f -= viscosity * slope([&](double s) {
             const Point y = moved(d, s);
             return slope([&](double t) {
               Point z = y;
               z[d] += t;
               return velocity(z);
             });
           });
      f[d] += slope([&](double s) { return pressure(moved(d, s)); });
    }
    return f;
  }
};

/// Errors after the flow has settled. The interface stands at `angle`, or turns from there with `speed`
/// through a flow that stands.
template <int dim>
typename Fluid<dim>::Errors settle(Domain<dim>& domain, double angle, double speed, int steps) {
  using Flow = SlowFlow<dim>;
  FluidParameters p;
  p.density = Flow::density;
  p.viscosity = Flow::viscosity;
  p.momentum_preconditioner = "ilu";
  p.pressure_tolerance = p.momentum_tolerance = 1e-11;
  BoundaryConditions<dim> conditions;
  for (const auto& [id, name] : domain.sides())
    if (!domain.is_sliding(name))
      conditions[name] = {
          BoundaryType::velocity_inlet, [](const auto& x, double) { return Flow::velocity(x); }, {}};
  Fluid<dim> fluid(p, domain, conditions);
  fluid.set_rotor_motion({RotorMotion::Mode::sliding, speed});
  fluid.turn_to(angle);
  fluid.set_initial(0, Flow::velocity, Flow::pressure);
  const double dt = 0.02;
  for (int s = 1; s <= steps; ++s) {
    fluid.turn_to(angle + speed * dt * s);
    Exchange<dim> exchange;
    for (const auto& x : fluid.layout().position) exchange.force.push_back(Flow::force(x));
    fluid.advance(dt, exchange);
    EXPECT_LT(fluid.mass_balance().largest, 1e-8);
    const auto [out, in] = fluid.interface_flow();
    EXPECT_LT(std::abs(out - in), 1e-8 * fluid.mass_balance().flow);
    EXPECT_LT(fluid.momentum_balance().residual, 1e-8);
  }
  return fluid.errors(Flow::velocity, Flow::pressure);
}

struct Placement {
  double angle, speed;
};

/// Order 2 of velocity and pressure, at every angle alike. `mesh(refinements)` makes the domain. When the
/// mesh turns through a pressure that stands, a node's pressure changes from step to step; what the splitting
/// then adds to the pressure is of first order in the step and here as large as the rest, so that only the
/// velocity is compared.
template <int dim, typename Mesh>
void expect_order_two(const Mesh& mesh, const std::vector<int>& refinements,
                      const std::vector<Placement>& placements, int steps) {
  typename Fluid<dim>::Errors coarse, first;
  for (const int r : refinements) {
    for (const auto& [angle, speed] : placements) {
      const auto domain = mesh(r);
      const auto e = settle<dim>(*domain, angle, speed, steps);
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << dim << "D angle " << angle << " speed " << speed << " refinements " << r << " u "
                  << e.velocity << " p " << e.pressure << "\n";
      if (angle == placements.front().angle) {
        first = e;
      } else {
        EXPECT_NEAR(e.velocity, first.velocity, 0.03 * first.velocity);
        if (speed == 0) {
          EXPECT_NEAR(e.pressure, first.pressure, 0.01 * first.pressure);
        }
      }
      if (r == refinements.front()) continue;
      EXPECT_LT(e.velocity, coarse.velocity / 3.4);
      if (speed == 0) {
        EXPECT_LT(e.pressure, coarse.pressure / 3);
      }
    }
    coarse = first;
  }
}

TEST(SlidingStokesMpi, RingOrderTwoAtAnyAngle) {
  expect_order_two<2>([](int r) { return ring(inner, middle, outer, 9, 14, 2, r); }, {1, 2, 3},
                      {{0, 0}, {0.777, 0}, {2.5, 0}, {0.3, 1.5}}, 8);
}

TEST(SlidingStokes, CylinderOrderTwoAtAnyAngle) {
  expect_order_two<3>([](int r) { return tube(inner, middle, outer, 16, 24, r); }, {1, 2},
                      {{0.1, 0}, {2.5, 0}, {0.3, 1.5}}, 6);
}

}  // namespace
}  // namespace seedflow
