// The hole sinks: flow into an opening, a seed that covers it, fan and line.
#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/coupling/aperture_flow.h"
#include "seedflow/coupling/covered_hole.h"
#include "seedflow/coupling/suction_parameters.h"

namespace seedflow {
namespace {

constexpr double far_limit = 1e9;

// The flux through any surface around the opening is Q: half spheres of several radii, mid-point rule.
TEST(ApertureFlow, FluxThroughEveryHalfSphereIsTheFlow) {
  const double a = 1e-3, q = 1.5e-4;
  for (const double r : {1.2e-3, 2e-3, 10e-3}) {
    double flux = 0;
    const int n = 4000;
    for (int i = 0; i < n; ++i) {
      const double theta = (i + 0.5) * 0.5 * M_PI / n;
      const Vec3 x{r * std::sin(theta), 0, r * std::cos(theta)};
      flux -= dot(aperture_velocity(x, a, q, far_limit), x) / r * 2 * M_PI * r * r * std::sin(theta) * 0.5 *
              M_PI / n;
    }
    EXPECT_NEAR(flux / q, 1, 1e-4) << r;  // mid-point rule beside the rim's singularity
  }
}

TEST(ApertureFlow, KnownValues) {
  const double a = 1e-3, q = 1.5e-4, mean = q / (M_PI * a * a);
  // On the axis Q/(2 pi (a^2 + z^2)): half the mean speed in the middle of the opening.
  EXPECT_NEAR(aperture_velocity({0, 0, 0}, a, q, far_limit).z / mean, -0.5, 1e-9);
  EXPECT_NEAR(aperture_velocity({0, 0, 3e-3}, a, q, far_limit).z, -q / (2 * M_PI * 10e-6), 1e-9);
  // In the wall beside the opening the air flows along it: Q / (2 pi rho sqrt(rho^2 - a^2)).
  const Vec3 beside = aperture_velocity({2e-3, 0, 0}, a, q, far_limit);
  EXPECT_NEAR(beside.x, -q / (2 * M_PI * 2e-3 * std::sqrt(3.0) * 1e-3), 1e-6);
  EXPECT_NEAR(beside.z, 0, 1e-6);
  // Far away a sink.
  const Vec3 x{30e-3, 0, 40e-3};
  EXPECT_NEAR(norm(aperture_velocity(x, a, q, far_limit)) * 2 * M_PI * 2.5e-3 / q, 1, 1e-3);
  // Never faster than the pressure difference allows.
  EXPECT_NEAR(norm(aperture_velocity({a, 0, 1e-9}, a, q, 70)), 70, 1e-9);
}

// No rotation and no sources, by central differences at a general point.
TEST(ApertureFlow, IsAPotentialFlow) {
  const Vec3 x{0.7e-3, 0.5e-3, 0.6e-3};
  const double h = 1e-7;
  double gradient[3][3];
  for (int j = 0; j < 3; ++j) {
    Vec3 up = x, down = x;
    up[j] += h, down[j] -= h;
    const Vec3 d =
        (aperture_velocity(up, 1e-3, 1e-4, far_limit) - aperture_velocity(down, 1e-3, 1e-4, far_limit)) /
        (2 * h);
    for (int i = 0; i < 3; ++i) gradient[i][j] = d[i];
  }
  const double scale = std::abs(gradient[2][2]);
  EXPECT_NEAR((gradient[0][0] + gradient[1][1] + gradient[2][2]) / scale, 0, 1e-5);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR((gradient[i][(i + 1) % 3] - gradient[(i + 1) % 3][i]) / scale, 0, 1e-5);
}

/// A ball of 2 mm that touches the rim all around.
CoveredHole::Ball seated(const CoveredHole& hole, double lift = 0) {
  return {{0, 0, std::sqrt(4e-6 - hole.seat_radius * hole.seat_radius) - hole.seat_depth + lift}, 2e-3};
}

// dp x hole area: the vector area of a sealed surface is that of the rim, here a polygon of 24 corners with
// sin(15 deg)/(15 deg) = 0.9886 of the circle. The roughness leaks: A_c/A_h = 2 pi a s/(pi a^2) = 0.04.
TEST(CoveredHole, SeatedBallIsHeldByPressureTimesHoleArea) {
  const CoveredHole hole(1e-3, 0, 2e-3);
  const auto outcome = hole.evaluate({seated(hole)}, 1);
  const double area = M_PI * 1e-6;
  EXPECT_NEAR(outcome.cover, 1 / (1 + 0.04 * 0.04), 1e-9);
  EXPECT_NEAR(outcome.cover * outcome.area[0].z / area, -0.9886 * outcome.cover, 1e-4);
  EXPECT_NEAR(outcome.area[0].x, 0, 1e-12);
  EXPECT_NEAR(outcome.area[0].y, 0, 1e-12);
  EXPECT_LT(outcome.flow_area, 0.05 * 0.8 * area);
}

// A chamfer of 0.3 mm widens the seat to 1.3 mm: (1.3)^2 of the force.
TEST(CoveredHole, ChamferWidensTheSeat) {
  const CoveredHole sharp(1e-3, 0, 2e-3), wide(1e-3, 0.3e-3, 2e-3), deep(1e-3, 0.6e-3, 2e-3);
  EXPECT_NEAR(wide.seat_radius, 1.3e-3, 1e-12);
  EXPECT_NEAR(wide.seat_depth, 0, 1e-12);
  EXPECT_NEAR(deep.seat_radius, std::sqrt(2.0) * 1e-3, 1e-12);  // tangent to a cone of 45 degrees
  EXPECT_NEAR(deep.seat_depth, 1.6e-3 - std::sqrt(2.0) * 1e-3, 1e-12);
  const double ratio =
      wide.evaluate({seated(wide)}, 1).area[0].z / sharp.evaluate({seated(sharp)}, 1).area[0].z;
  EXPECT_NEAR(ratio, 1.69, 1e-6);
}

// A clump of sub-spheres sits a little deeper than a ball: still the pressure on the seat, not on more.
TEST(CoveredHole, DeeperSeatIsHeldByTheSeatsArea) {
  const CoveredHole hole(1e-3, 0.3e-3, 2e-3);
  const double flush = hole.evaluate({seated(hole)}, 1).area[0].z;
  EXPECT_NEAR(hole.evaluate({seated(hole, -0.1e-3)}, 1).area[0].z / flush, 1, 1e-12);
}

TEST(CoveredHole, ForceFallsWithDistanceWithoutAJump) {
  const CoveredHole hole(1e-3, 0.3e-3, 2e-3);
  const double held = -(hole.evaluate({seated(hole)}, 1).cover * hole.evaluate({seated(hole)}, 1).area[0].z);
  double before = held;
  for (double lift = 0; lift < 12e-3; lift += 5e-6) {
    const auto o = hole.evaluate({seated(hole, lift)}, 1);
    const double force = -o.cover * o.area[0].z;
    EXPECT_LE(force, before * (1 + 1e-9)) << lift;
    EXPECT_LT(before - force, 0.03 * held) << lift;  // no jump between steps of 5 um
    before = force;
  }
  // At the reach of SuctionStep it is below a thousandth: 3 kPa hold 1.6e-2 N, a seed weighs 4.4e-4 N.
  EXPECT_LT(before, 1e-4 * held);
}

// Sideways the force points to the hole, and two equal seeds share it.
TEST(CoveredHole, SeedsBesideAreDrawnToTheHole) {
  const CoveredHole hole(1e-3, 0.3e-3, 2e-3);
  const auto one = hole.evaluate({{{2e-3, 0, 2e-3}, 2e-3}}, 1);
  EXPECT_LT(one.area[0].x, 0);
  EXPECT_LT(one.area[0].z, 0);
  EXPECT_NEAR(one.area[0].y, 0, 1e-12);
  const auto two = hole.evaluate({{{2e-3, 0, 2e-3}, 2e-3}, {{-2e-3, 0, 2e-3}, 2e-3}}, 1);
  EXPECT_NEAR(two.area[0].x, -two.area[1].x, 1e-12);
  EXPECT_NEAR(two.area[0].z, two.area[1].z, 1e-12);
  EXPECT_GT(two.cover, one.cover);
  EXPECT_LT(two.flow_area, one.flow_area);
  // Together they do not carry more than the seat.
  EXPECT_LT(-two.area[0].z - two.area[1].z, M_PI * hole.seat_radius * hole.seat_radius);
}

TEST(CoveredHole, HoleBesideTheVacuumNeitherDrawsNorHolds) {
  const CoveredHole hole(1e-3, 0.3e-3, 2e-3);
  const auto closed = hole.evaluate({seated(hole)}, 0);
  EXPECT_EQ(closed.cover, 0);
  EXPECT_EQ(closed.flow_area, 0);
  const auto open = hole.evaluate({}, 1);
  EXPECT_EQ(open.cover, 0);
  EXPECT_NEAR(open.flow_area, 0.8 * M_PI * 1e-6, 1e-12);
}

// 3 kPa drive 70.7 m/s; an area of 1 cm2 takes 7.07 l/s. Losses are met exactly.
TEST(SuctionBalance, FanLineAndHolesAgree) {
  SuctionParameters p;
  EXPECT_NEAR(suction_balance(p, 1e-4).flow, 1e-4 * std::sqrt(5000.0), 1e-12);
  EXPECT_NEAR(suction_balance(p, 1e-4).drop, 3000, 1e-9);
  p.fan_flow = 0.02, p.line_strength = 1;
  const SuctionBalance b = suction_balance(p, 1e-4);
  const double line = M_PI / 4 * 625e-6;
  const double fan = 3000 * (1 - b.flow * b.flow / 4e-4), lost = 5 * 0.6 * b.flow * b.flow / (line * line);
  EXPECT_NEAR(fan - lost, b.drop, 1e-9 * b.drop);
  EXPECT_NEAR(b.flow, 1e-4 * std::sqrt(2 * b.drop / 1.2), 1e-12);
  EXPECT_LT(b.drop, 2900);
}

}  // namespace
}  // namespace seedflow
