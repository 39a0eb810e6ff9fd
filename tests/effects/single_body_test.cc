#include "seedflow/effects/single_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/effects/drag_laws.h"

namespace seedflow {
namespace {

std::vector<double> times(int n, double step) {
  std::vector<double> list;
  for (int i = 1; i <= n; ++i) list.push_back(i * step);
  return list;
}

TEST(SingleBody, StokesRelaxationIsExactForAnyStep) {
  // dv/dt = (u - v)/tau, tau = rho_p d^2/(18 mu): the exponential rule solves it exactly.
  PrescribedFlow flow;
  flow.velocity = [](const Vec3&, double) { return Vec3{0.2, 0, 0}; };
  flow.viscosity = 0.1, flow.gravity = {};
  const SingleBodyProperties body = {1e-3, 2500, 1};
  const double tau = 2500 * 1e-6 / 1.8;
  for (const double dt : {0.01 * tau, tau, 100 * tau}) {
    EffectSet set;
    set["Drag"].set_choice("Law", "Stokes");
    SingleBody sphere(body, flow, set);
    for (int i = 1; i <= 5; ++i) {
      sphere.step(dt);
      const double x = i * dt / tau;
      EXPECT_NEAR(sphere.state().velocity.x, 0.2 * -std::expm1(-x), 1e-13);
      EXPECT_NEAR(sphere.state().position.x, 0.2 * (i * dt - tau * -std::expm1(-x)), 1e-12 * i * dt);
    }
  }
}

TEST(SingleBody, TerminalSpeedOfTheSeed) {
  PrescribedFlow flow;
  flow.viscosity = 0.01;
  const SingleBodyProperties seed = {4e-3, 1340, 1};
  EffectSet set;
  SingleBody sphere(seed, flow, set);
  const auto end = sphere.run({2.0}, 1e-3).back();
  EXPECT_NEAR(end.velocity.z, -0.1018, 5e-5);
  EXPECT_NEAR(1000 * 4e-3 * norm(end.velocity) / 0.01, 40.7, 0.05);
  // The balance k v = net weight closes to round-off, whatever the law.
  for (const auto& law : drag_laws()) {
    EffectSet other;
    other["Drag"].set_choice("Law", law.name);
    SingleBody one(seed, flow, other);
    one.run({3.0}, 1e-3);
    const FlowAtBody f = one.flow_at(one.state(), 3.0, 1e-3);
    const double net = M_PI / 6 * 64e-9 * 340 * 9.81;
    EXPECT_NEAR(momentum_exchange(law, f) * norm(one.state().velocity), net, 1e-6 * net) << law.name;
  }
}

TEST(SingleBody, SecondOrderInTime) {
  PrescribedFlow flow;
  flow.viscosity = 0.01;
  const auto speed = [&](double dt) {
    EffectSet set;
    set["Added mass"].set_strength(1);
    SingleBody sphere({4e-3, 1340, 1}, flow, set);
    return sphere.run({0.05}, dt).back().velocity.z;
  };
  const double exact = speed(1e-5);
  const double ratio = (speed(4e-3) - exact) / (speed(2e-3) - exact);
  EXPECT_NEAR(ratio, 4, 0.8);
  EXPECT_NEAR(speed(1e-3), exact, 1e-4 * std::abs(exact));
}

TEST(SingleBody, InitialAccelerationWithAddedMass) {
  // From rest: (rho_p - rho) V g = (rho_p + C_A rho) V a.
  PrescribedFlow flow;
  for (const double strength : {0.0, 0.5, 1.0}) {
    EffectSet set;
    set["Added mass"].set_strength(strength);
    SingleBody sphere({1e-3, 2500, 1}, flow, set);
    sphere.step(1e-7);
    EXPECT_NEAR(sphere.state().acceleration.z, -9.81 * 1500 / (2500 + 500 * strength), 1e-5);
  }
  // In a stream that accelerates as a whole a massless sphere gains three times its acceleration.
  flow.gravity = {};
  flow.velocity = [](const Vec3&, double t) { return Vec3{2 * t, 0, 0}; };
  EffectSet set;
  set["Added mass"].set_strength(1);
  SingleBody bubble({1e-2, 1e-6, 1}, flow, set);
  bubble.step(1e-6);
  EXPECT_NEAR(bubble.state().acceleration.x, 6, 1e-3);
}

double scaled_erfc(double x) {
  return std::exp(x * x) * std::erfc(x);
}

TEST(SingleBody, BassetStartFromRestHasAClosedForm) {
  // M dv/dt = G - k v - B/sqrt(pi) integral v'/sqrt(t - s) ds, in Laplace space v = (G/M)/(s (sqrt s +
  // a)(sqrt s + b)), a, b = (B -+ sqrt(B^2 - 4 M k))/(2 M), real for light spheres (rho_p/rho < 5/8): v =
  // G/(M (b - a)) ((1 - E(a sqrt t))/a - (1 - E(b sqrt t))/b), E(x) = exp(x^2) erfc(x).
  PrescribedFlow flow;
  flow.viscosity = 1;
  const double d = 2e-3, rho_p = 200, volume = M_PI / 6 * d * d * d;
  const double total = (rho_p + 500) * volume, net = (1000 - rho_p) * volume * 9.81;
  const double k = 3 * M_PI * flow.viscosity * d, b = 1.5 * d * d * M_PI * std::sqrt(1000 * flow.viscosity);
  const double root = std::sqrt(b * b - 4 * total * k), p = (b - root) / (2 * total),
               q = (b + root) / (2 * total);
  const auto exact = [&](double t) {
    const double s = std::sqrt(t);
    return net / (total * (q - p)) * ((1 - scaled_erfc(p * s)) / p - (1 - scaled_erfc(q * s)) / q);
  };
  const double tau = total / k;
  const auto error = [&](double dt, double resolution) {
    EffectSet set;
    set["Drag"].set_choice("Law", "Stokes");
    set["Added mass"].set_strength(1);
    set["History force"].set_strength(1);
    set["History force"].set_choice("Kernel", "Basset");
    set["History force"].set_number("Resolution", resolution);
    SingleBody sphere({d, rho_p, 1}, flow, set);
    double largest = 0;
    for (const auto& s : sphere.run(times(50, 0.2 * tau), dt))
      largest = std::max(largest, std::abs(s.velocity.z - exact(s.time)));
    return largest / (net / k);
  };
  EXPECT_LT(error(0.01 * tau, 16), 2e-4);  // thinning: samples at 1/16 of their age
  // All samples kept, only the time step is left: better than first order in spite of the singular kernel.
  const double coarse = error(0.05 * tau, 1000), fine = error(0.0125 * tau, 1000);
  EXPECT_LT(coarse, 3e-4);
  EXPECT_LT(fine, coarse / 6);
}

TEST(SingleBody, MemoryOfTheHistoryForceIsBounded) {
  PrescribedFlow flow;
  flow.viscosity = 0.9e-3;
  EffectSet set;
  set["Added mass"].set_strength(1), set["History force"].set_strength(1);
  SingleBody sphere({0.5e-3, 2560, 1}, flow, set);
  std::size_t at_1000 = 0;
  for (int i = 1; i <= 4000; ++i) {
    sphere.step(1e-4);
    if (i == 1000) at_1000 = set["History force"].pack(0).size();
  }
  // About 2 * 16 (1 + ln(n/16)) samples of 4 numbers after n steps: 4 times the steps add at most 2 * 16 ln 4
  // samples.
  const std::size_t at_4000 = set["History force"].pack(0).size();
  EXPECT_LT(at_4000, 4 * 2 * 16 * (1 + std::log(4000 / 16.0)));
  EXPECT_LT(at_4000 - at_1000, 4 * 2 * 16 * std::log(4.0) * 1.05);
}

TEST(SingleBody, SpinRelaxesToHalfTheVorticity) {
  PrescribedFlow flow;
  flow.gravity = {}, flow.viscosity = 0.1;
  flow.velocity = [](const Vec3& x, double) {
    return Vec3{-3 * x.y, 3 * x.x, 0};
  };  // rigid rotation at 3 rad/s
  EffectSet set;
  set["Rotational drag"].set_strength(1);
  set["Drag"].set_choice("Law", "Stokes");
  SingleBody sphere({1e-3, 1000, 1}, flow, set);
  const double tau = 1000 * 1e-6 / (60 * 0.1);  // I/(pi mu d^3)
  const auto series = sphere.run(times(4, tau), 0.1 * tau);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(series[i].angular_velocity.z, -3 * std::expm1(-(i + 1)), 1e-8);
}

TEST(SingleBody, UndisturbedStressKeepsAFluidSphereOnItsStreamline) {
  // A sphere of the fluid's own density, released with the flow, stays with it when the stress of the
  // undisturbed flow acts (grad p_d = -rho Du/Dt): 0.2 % of the radius after one turn, the error of the time
  // step.
  PrescribedFlow flow;
  flow.gravity = {};
  flow.velocity = [](const Vec3& x, double) { return Vec3{-3 * x.y, 3 * x.x, 0}; };
  const auto radius = [&](double strength) {
    EffectSet set;
    set["Pressure gradient"].set_strength(strength);
    SingleBodyState start;
    start.position = {0.1, 0, 0}, start.velocity = {0, 0.3, 0};
    SingleBody sphere({1e-3, 1000, 1}, flow, set, start);
    return norm(sphere.run({2 * M_PI / 3}, 2e-3).back().position);
  };
  EXPECT_NEAR(radius(1), 0.1, 2e-4);
  EXPECT_GT(radius(0), 0.101);  // centrifuged without it
}

TEST(SingleBody, NeutralSphereLagsAParabolicProfile) {
  // On the axis of u = U (1 - r^2/R^2) a sphere of the fluid's density moves at U (1 - 2/3 a^2/R^2) (Faxen).
  PrescribedFlow flow;
  flow.gravity = {}, flow.viscosity = 1;
  flow.velocity = [](const Vec3& x, double) {
    return Vec3{0, 0, 1e-2 * (1 - (x.x * x.x + x.y * x.y) / 25e-6)};
  };
  EffectSet set;
  set["Drag"].set_choice("Law", "Stokes");
  set["Faxen force"].set_strength(1);
  SingleBody sphere({2e-3, 1000, 1}, flow, set);
  // The second difference loses 1e-16/(0.01 d/R)^2 of U to round-off.
  EXPECT_NEAR(sphere.run({0.1}, 1e-3).back().velocity.z, 1e-2 * (1 - 2.0 / 3 / 25), 1e-11);
  // A plain shear has no curvature.
  flow.velocity = [](const Vec3& x, double) { return Vec3{0, 0, 3 * x.x}; };
  SingleBody sheared({2e-3, 1000, 1}, flow, set);
  EXPECT_NEAR(norm(sheared.flow_at({}, 0, 1e-3).flow_laplacian), 0, 1e-6);
}

TEST(SingleBody, WallsAreSeen) {
  PrescribedFlow flow;
  flow.viscosity = 1;
  flow.walls = {{{0, 0, 0}, {0, 0, 1}}, {{0.5, 0, 0}, {-1, 0, 0}}};
  EffectSet set;
  SingleBodyState start;
  start.position = {0.45, 0, 0.02};
  SingleBody sphere({1e-2, 2000, 1}, flow, set, start);
  const FlowAtBody f = sphere.flow_at(start, 0, 1e-3);
  EXPECT_DOUBLE_EQ(f.wall_distance, 0.02);
  EXPECT_EQ(f.wall_normal.z, 1);
  set["Plane wall drag"].set_strength(1);
  // Brenner: the sphere never reaches the wall, its speed falls with the gap.
  // Stokes speed 0.0545 m/s; lubrication keeps the gap open until it is the roughness, 1e-3 radii.
  const auto series = sphere.run({0.1, 0.5, 1.0}, 1e-3);
  EXPECT_GT(series[1].position.z, 5e-3);
  EXPECT_LT(norm(series[2].velocity), 0.01 * norm(series[0].velocity));
}

TEST(SingleBody, BadInputAndNaN) {
  PrescribedFlow flow;
  EffectSet set;
  EXPECT_THROW(SingleBody({-1e-3, 1000, 1}, flow, set), InputError);
  SingleBody sphere({1e-3, 1000, 1}, flow, set);
  EXPECT_THROW(sphere.step(0), InputError);
  flow.velocity = [](const Vec3&, double) { return Vec3{std::nan(""), 0, 0}; };
  EXPECT_THROW(sphere.step(1e-3), RunError);
}

}  // namespace
}  // namespace seedflow
