#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/truth/truth_laws.h"
#include "seedflow/truth/truth_seed.h"

namespace seedflow {
namespace {

std::vector<double> times(int n, double end) {
  std::vector<double> list;
  for (int i = 1; i <= n; ++i) list.push_back(i * end / n);
  return list;
}

TEST(Truth, FreeFlightAndATrapHaveClosedForms) {
  TruthSeed s;
  s.gravity = {};
  s.unknown.trap = 400;
  s.position = {1e-3, 0, 0};
  s.velocity = {0, 0.3, 0};
  for (const double time : {0.1, 1.0, 3.0}) {
    const TruthState end = truth_states(s, {time}).front();
    EXPECT_NEAR(end.position.x, 1e-3 * std::cos(20 * time), 1e-3 * 1e-5);  // tolerance times periods
    EXPECT_NEAR(end.position.y, 0.3 * time, 1e-12);
  }
}

TEST(Truth, ToleranceIsReached) {
  TruthSeed s;
  s.amplitudes = {{"Drag", 1},         {"Pressure gradient", 1}, {"Added mass", 1},
                  {"Saffman lift", 1}, {"Rotational drag", 1},   {"Magnus lift", 1}};
  s.flow.shear = 20, s.flow.amplitude = {0.02, 0, 0}, s.flow.frequency = 40;
  s.viscosity = 0.02;
  s.spin = {0, 30, 0};
  const auto coarse = truth_states(s, times(5, 0.5), 1e-7), fine = truth_states(s, times(5, 0.5), 1e-11);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(norm(coarse[i].position - fine[i].position), 0, 1e-5 * s.diameter);
    EXPECT_NEAR(norm(coarse[i].velocity - fine[i].velocity), 0, 1e-5 * norm(fine[i].velocity));
    EXPECT_NEAR(norm(coarse[i].spin - fine[i].spin), 0, 1e-4);
  }
}

double scaled_erfc(double x) {
  return std::exp(x * x) * std::erfc(x);
}

TEST(Truth, BassetStartFromRestHasAClosedForm) {
  // At vanishing Re the kernel is Basset's and the drag Stokes'. M dv/dt = G - k v - b integral v'/sqrt(t -
  // s), light sphere: v = G/(M (q - p)) ((1 - E(p sqrt t))/p - (1 - E(q sqrt t))/q), E(x) = exp(x^2) erfc(x),
  // p, q = (B -+ sqrt(B^2 - 4 M k))/(2 M), B = b sqrt(pi).
  TruthSeed s;
  s.diameter = 2e-3, s.density = 200, s.viscosity = 100;
  s.amplitudes = {{"Drag", 1}, {"Pressure gradient", 1}, {"Added mass", 1}, {"History force", 1}};
  const double volume = s.volume(), total = 700 * volume, net = 800 * volume * 9.81;
  const double k = 3 * M_PI * s.viscosity * s.diameter;
  const double b = 1.5 * s.diameter * s.diameter * M_PI * std::sqrt(1000 * s.viscosity);
  const double root = std::sqrt(b * b - 4 * total * k), p = (b - root) / (2 * total),
               q = (b + root) / (2 * total);
  const double end = 5 * total / k;
  const auto error = [&](int steps) {
    double worst = 0;
    const auto list = times(20, end);
    const auto states = truth_states(s, list, 1e-9, steps);
    for (int i = 0; i < 20; ++i) {
      const double x = std::sqrt(list[i]);
      const double exact =
          net / (total * (q - p)) * ((1 - scaled_erfc(p * x)) / p - (1 - scaled_erfc(q * x)) / q);
      worst = std::max(worst, std::abs(states[i].velocity.z - exact) / (net / k));
    }
    return worst;
  };
  // The start from rest is singular (v grows like t - c t^3/2), so the order is near 3/2.
  EXPECT_LT(error(600), 2e-4);
  EXPECT_LT(error(600), error(150) / 5);
}

TEST(Truth, LawsAgreeWithPublishedValues) {
  // Standard drag curve (Clift, Grace & Weber 1978), within 4 %.
  const double curve[4][2] = {{1, 27.1}, {10, 4.26}, {100, 1.09}, {1000, 0.471}};
  for (const auto& [re, value] : curve) EXPECT_NEAR(24 / re * truth_drag(re), value, 0.04 * value) << re;
  EXPECT_DOUBLE_EQ(truth_shape_factor(10, 1), 1);
  // Cube (sphericity 0.806), Re 100: C_D 1.285 against 1.150 of a sphere, the printed formula by hand.
  EXPECT_NEAR(truth_shape_factor(100, 0.806), 1.285 / 1.150, 1e-3);
  // Richardson-Zaki exponent 4.65 in Stokes flow: k w = eps F.
  EXPECT_NEAR(truth_crowd_factor(1e-9, 0.8), std::pow(0.8, 1 - 3.65), 1e-6);
  // Haberman & Sayre's table; Brenner (1961), cosh(alpha) = distance/radius; Goldman, Cox & Brenner (1967).
  for (const auto& [x, value] : {std::pair{0.1, 1.263}, {0.3, 2.371}, {0.5, 5.970}})
    EXPECT_NEAR(truth_tube_factor(x), value, 0.02 * value);
  for (const auto& [alpha, value] : {std::pair{3.0, 1.1252}, {2.0, 1.4129}, {1.0, 3.0361}, {0.5, 9.2518}})
    EXPECT_NEAR(truth_approach_factor(std::cosh(alpha) - 1), value, 0.02 * value);
  for (const auto& [h, value] :
       {std::pair{10.0677, 1.0587}, {3.7622, 1.1738}, {1.5431, 1.5675}, {1.0453, 2.6475}})
    EXPECT_NEAR(truth_along_factor(1 / h), value, 0.02 * value);
  // McLaughlin's expansion 1 - 0.287 e^-2; Rubinow & Keller at small Re; 3/32 a w^2/nu of drift at a wall.
  EXPECT_NEAR(truth_shear_lift(5), 1 - 0.6463 / 2.255 / 25, 2e-3);
  EXPECT_NEAR(truth_spin_lift(1e-8, 1), 1, 1e-4);
  EXPECT_NEAR(truth_wall_lift(0) / (6 * M_PI), 3.0 / 32, 3e-3 * 3 / 32);
}

TEST(Truth, BadInputIsRefused) {
  TruthSeed s;
  s.amplitudes = {{"Added mas", 1}};
  EXPECT_THROW(truth_states(s, {1}), InputError);
  s.amplitudes = {{"History force", 1}};
  s.velocity = {1, 0, 0};
  EXPECT_THROW(truth_states(s, {1}), InputError);
}

TEST(Truth, ExpressionsAreTheFlow) {
  TruthFlow f;
  EXPECT_EQ(f.expressions()[2], "0");
  f.uniform = {0, 0, 0.5}, f.shear = -2, f.curvature = 3, f.amplitude = {0.25, 0, 0}, f.frequency = 8;
  EXPECT_EQ(f.expressions()[0], "(0.25) * sin(8 * t)");
  EXPECT_EQ(f.expressions()[2], "(0.5) + (-2) * x + (3) * x * x");
  const Vec3 x = {0.1, 0, 0};
  EXPECT_NEAR(f.velocity(x, 0).z, 0.5 - 0.2 + 0.03, 1e-15);
  EXPECT_NEAR(f.vorticity(x).y, 2 - 0.6, 1e-15);
  EXPECT_NEAR(f.rate_along(x, 0, {1, 0, 0}).z, -2 + 0.6, 1e-15);
}

}  // namespace
}  // namespace seedflow
