#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../mesh/rotor_mesh.h"
#include "seedflow/fluid/fluid.h"

// The flow above a turning disc, with the sliding interface in the fluid.

namespace seedflow {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Von Karman's flow over a disc that turns at 1 rad/s in a fluid of viscosity and density 1:
///   u = r F e_r + r G e_phi + H e_z,  p = H' - H^2/2 + const
///   F'' = F^2 - G^2 + H F',  G'' = 2 F G + H G',  H' = -2 F,  F(0) = H(0) = 0, G(0) = 1, F, G -> 0 far away
/// Z. angew. Math. Mech. 1 (1921) 233. F'(0) and G'(0) are found by shooting.
class DiscFlow {
 public:
  static constexpr double step = 0.01, end = 20;

  DiscFlow() {
    double a = 0.51, b = -0.616;
    for (int newton = 0; newton < 8; ++newton) {
      constexpr double h = 1e-7;
      const auto [f, g] = shoot(a, b);
      const auto [fa, ga] = shoot(a + h, b);
      const auto [fb, gb] = shoot(a, b + h);
      const double xx = (fa - f) / h, xy = (fb - f) / h, yx = (ga - g) / h, yy = (gb - g) / h;
      const double det = xx * yy - xy * yx;
      a -= (f * yy - g * xy) / det;
      b -= (g * xx - f * yx) / det;
    }
    shoot(a, b);
    slope_of_swirl = b;
  }
  dealii::Tensor<1, 3> velocity(const dealii::Point<3>& x) const {
    const auto [f, g, h] = at(x[2]);
    return dealii::Tensor<1, 3>({x[0] * f - x[1] * g, x[1] * f + x[0] * g, h});
  }
  double pressure(const dealii::Point<3>& x) const {
    const auto [f, g, h] = at(x[2]);
    return -2 * f - h * h / 2;
  }
  double slope_of_swirl = 0;  ///< G'(0)

 private:
  using State = std::array<double, 5>;  // F, F', G, G', H
  static State slope(const State& s) {
    return {s[1], s[0] * s[0] - s[2] * s[2] + s[4] * s[1], s[3], 2 * s[0] * s[2] + s[4] * s[3], -2 * s[0]};
  }
  static State plus(const State& s, double t, const State& d) {
    State r = s;
    for (int i = 0; i < 5; ++i) r[i] += t * d[i];
    return r;
  }
  /// F and G far away.
  std::array<double, 2> shoot(double a, double b) {
    states = {{0, a, 1, b, 0}};
    while (states.size() <= end / step) {
      const State& s = states.back();
      const State k1 = slope(s), k2 = slope(plus(s, step / 2, k1)), k3 = slope(plus(s, step / 2, k2)),
                  k4 = slope(plus(s, step, k3));
      State next = s;
      for (int i = 0; i < 5; ++i) next[i] += step / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
      states.push_back(next);
    }
    return {states.back()[0], states.back()[2]};
  }
  std::array<double, 3> at(double z) const {
    const double place = std::max(z, 0.0) / step;
    const std::size_t i = std::min<std::size_t>(place, states.size() - 2);
    const double t = place - i;
    const State &a = states[i], &b = states[i + 1];
    return {a[0] + t * (b[0] - a[0]), a[2] + t * (b[2] - a[2]), a[4] + t * (b[4] - a[4])};
  }
  std::vector<State> states;
};

TEST(DiscFlow, ShootingGivesTheKnownConstants) {
  // Rogers & Lance 1960, doi:10.1017/S0022112060000335: F'(0) = 0.510, G'(0) = -0.6159, H = -0.8845 far away.
  const DiscFlow flow;
  EXPECT_NEAR(flow.slope_of_swirl, -0.61592, 1e-5);
  EXPECT_NEAR(flow.velocity({0, 0, 15})[2], -0.88447, 1e-4);
  EXPECT_NEAR(flow.velocity({1, 0, 1e-2})[0] / 1e-2, 0.51023, 0.006);  // less what curvature takes
}

/// Between the radii 2 and 6 lengths sqrt(nu/Omega), 10 such lengths high; the lowest 1.5 turn with the
/// disc. The flow of the similarity solution is given on the two cylinders, its pressure at the lid. Torque
/// on one side of the disc between the radii: pi/2 mu Omega sqrt(Omega/nu) G'(0) (b^4 - a^4); for the whole
/// disc that is the moment coefficient 0.616 pi/sqrt(Re).
/// Rim and hole of the disc are polygons here, which costs 2 and 0.6 % of the torque (their polar moments).
/// Where the two sides' polygons do not cover one another the interface is a wall; that is too little to
/// matter.
TEST(RotorDisc, TorqueOfVonKarman) {
  const DiscFlow flow;
  const double a = 2, b = 6;
  const double torque = pi / 2 * flow.slope_of_swirl * (std::pow(b, 4) - std::pow(a, 4));
  for (const auto mode : {RotorMotion::Mode::frozen, RotorMotion::Mode::sliding}) {
    double before = 0;
    for (const int fine : {1, 2}) {
      std::vector<double> below, above;
      for (int k = 0; k <= 4 * fine; ++k) below.push_back(1.5 * k / (4 * fine));
      for (int k = 0; k <= 6 * fine; ++k) {  // cells grow away from the disc
        const double s = double(k) / (6 * fine);
        above.push_back(1.5 + 8.5 * s * (0.4 + 0.6 * s));
      }
      const auto domain = disc_and_air(a, b, 22 * fine, 24 * fine, 2 * fine, below, above);
      FluidParameters p;
      p.density = p.viscosity = 1;
      p.momentum_preconditioner = "ilu";
      p.pressure_tolerance = 1e-9;
      p.momentum_tolerance = 1e-10;
      BoundaryConditions<3> conditions;
      conditions["disc"].type = BoundaryType::rotor_wall;
      for (const char* side : {"below", "above"})
        conditions[side] = {
            BoundaryType::velocity_inlet, [&](const auto& x, double) { return flow.velocity(x); }, {}};
      conditions["lid"] = {
          BoundaryType::pressure_inlet, {}, [&](const auto& x, double) { return flow.pressure(x); }};
      Fluid<3> fluid(p, *domain, conditions);
      fluid.set_rotor_motion({mode, 1.0});
      fluid.set_initial(
          0, [&](const auto& x) { return flow.velocity(x); },
          [&](const auto& x) { return flow.pressure(x); });
      const double dt = 0.1;
      for (int s = 1; s <= 20; ++s) {
        if (mode == RotorMotion::Mode::sliding) fluid.turn_to(dt * s);
        fluid.advance(dt, {});
        const auto [out, in] = fluid.interface_flow();
        EXPECT_LT(std::abs(out - in), 1e-8 * fluid.mass_balance().flow);
        EXPECT_LT(fluid.mass_balance().largest, 1e-8);
        EXPECT_LT(fluid.momentum_balance().residual, 1e-8);
      }
      // The torque of the disc on the air is positive.
      const double error = fluid.momentum_balance().torque.at("disc") / -torque - 1;
      const auto e = fluid.errors([&](const auto& x) { return flow.velocity(x); },
                                  [&](const auto& x) { return flow.pressure(x); });
      std::cout << (mode == RotorMotion::Mode::frozen ? "frozen " : "sliding ") << fine << " torque error "
                << error << " u " << e.velocity << " p " << e.pressure << "\n";
      if (fine == 2) {
        EXPECT_LT(std::abs(error), 0.02);
        EXPECT_LT(std::abs(error), std::abs(before) / 2.8);
      }
      before = error;
    }
  }
}

}  // namespace
}  // namespace seedflow
