#include <gtest/gtest.h>

#include <iostream>

#include "manufactured.h"

namespace seedflow {
namespace {

/// A flow that the elements hold exactly in space, u = A(t) x with tr A = 0 and p linear, so that every error
/// is one of the time scheme: A = ((s, r), (r, -s)), so (u . grad) u = A^2 x = (s^2 + r^2) x.
struct LinearFlow {
  using Vector = dealii::Tensor<1, 2>;
  using Point = dealii::Point<2>;
  static constexpr double density = 1.3, drag = 2, eps = 0.8;

  static double s(double t) { return 0.5 + 0.5 * std::sin(3 * t); }
  static double r(double t) { return 0.7 * std::cos(2 * t); }
  static double slope_of_s(double t) { return 1.5 * std::cos(3 * t); }
  static double slope_of_r(double t) { return -1.4 * std::sin(2 * t); }
  static Vector apply(double a, double b, const Point& x) {
    Vector u;
    u[0] = a * x[0] + b * x[1];
    u[1] = b * x[0] - a * x[1];
    return u;
  }
  static Vector velocity(const Point& x, double t) { return apply(s(t), r(t), x); }
  static double pressure(const Point& x, double t) { return std::cos(2 * t) * (x[0] + 2 * x[1]); }
  static Vector force(const Point& x, double t) {
    Vector f = density * eps * apply(slope_of_s(t), slope_of_r(t), x) + drag * velocity(x, t);
    f += density * eps * (s(t) * s(t) + r(t) * r(t)) * static_cast<const Vector&>(x);
    f[0] += eps * std::cos(2 * t);
    f[1] += eps * 2 * std::cos(2 * t);
    return f;
  }
};

Fluid<2, 1>::Errors errors_after(double end, int steps) {
  auto domain = unit_box<2>(8);
  FluidParameters p;
  p.density = LinearFlow::density;
  p.viscosity = 0.05;
  p.pressure_tolerance = 1e-11;
  BoundaryConditions<2> conditions;
  for (const auto& [id, name] : domain->sides()) {
    conditions[name].type = BoundaryType::velocity_inlet;
    conditions[name].velocity = LinearFlow::velocity;
  }
  Fluid<2, 1> fluid(p, *domain, conditions);
  const std::vector<double> eps(fluid.layout().size(), LinearFlow::eps);
  const auto at = [](const auto& f, double t) { return [=](const LinearFlow::Point& x) { return f(x, t); }; };
  fluid.set_initial(0, at(LinearFlow::velocity, 0), at(LinearFlow::pressure, 0), eps);
  const double dt = end / steps;
  for (int n = 1; n <= steps; ++n) {
    Exchange<2> exchange;
    exchange.void_fraction = eps;
    exchange.drag_coefficient.assign(eps.size(), LinearFlow::drag);
    for (const auto& x : fluid.layout().position) exchange.force.push_back(LinearFlow::force(x, n * dt));
    fluid.advance(dt, exchange);
  }
  return fluid.errors(at(LinearFlow::velocity, end), at(LinearFlow::pressure, end));
}

TEST(TimeOrder, VelocitySecondPressureFirst) {
  // Incremental projection with BDF2: velocity of order 2, pressure at least 1 (Guermond, Minev & Shen 2006,
  // doi:10.1016/j.cma.2005.10.010). 0.2 below the order is left for the first, first-order step.
  std::vector<Fluid<2, 1>::Errors> e;
  for (const int steps : {10, 20, 40, 80, 160}) e.push_back(errors_after(1.0, steps));
  for (std::size_t i = 1; i < e.size(); ++i) {
    const double velocity = std::log2(e[i - 1].velocity / e[i].velocity),
                 pressure = std::log2(e[i - 1].pressure / e[i].pressure);
    std::cout << "steps " << 10 * (1 << i) << ": velocity " << e[i].velocity << " order " << velocity
              << ", pressure " << e[i].pressure << " order " << pressure << "\n";
    EXPECT_GT(velocity, 1.8);
    EXPECT_GT(pressure, 1.0);
  }
}

}  // namespace
}  // namespace seedflow
