#include "seedflow/fluid/eddy_viscosity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace seedflow {
namespace {

using Gradient = double[3][3];

double rate(const Gradient& g) {
  Lanes lanes[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) lanes[i][j] = broadcast(g[i][j]);
  return wale_rate<3>(lanes)[0];
}

TEST(WaleModel, zeroInPureShearAndInStillAir) {
  EXPECT_EQ(rate({{0, 700, 0}, {0, 0, 0}, {0, 0, 0}}), 0);
  EXPECT_EQ(rate({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), 0);
}

TEST(WaleModel, solidRotationAndPlaneStrainAsByHand) {
  const double w = 300;
  // g g = -w^2 (I - z z): Sd:Sd = 2/3 w^4, S = 0.
  EXPECT_NEAR(rate({{0, -w, 0}, {w, 0, 0}, {0, 0, 0}}), std::pow(2.0 / 3, 0.25) * w, 1e-12 * w);
  // g g = w^2 (I - z z): Sd:Sd = 2/3 w^4, S:S = 2 w^2.
  const double strain = std::pow(2.0 / 3, 1.5) / (std::pow(2.0, 2.5) + std::pow(2.0 / 3, 1.25)) * w;
  EXPECT_NEAR(rate({{w, 0, 0}, {0, -w, 0}, {0, 0, 0}}), strain, 1e-12 * w);
  // The same in two dimensions, where the third direction is not stored.
  const Lanes plane[2][2] = {{broadcast(w), broadcast(0.0)}, {broadcast(0.0), broadcast(-w)}};
  EXPECT_NEAR(wale_rate<2>(plane)[0], strain, 1e-12 * w);
}

TEST(WaleModel, fallsWithTheCubeOfTheDistanceFromAWall) {
  // Near a wall y = 0 a flow without divergence is u = a y, v = -(b + c)/2 y^2, w = d y with da/dx = b,
  // dd/dz = c.
  const auto near_wall = [](double y) {
    const double a = 1000, b = 300, c = 200, d = 400, da_dz = 150, dd_dx = -250;
    return rate({{b * y, a, da_dz * y}, {30 * y * y, -(b + c) * y, 70 * y * y}, {dd_dx * y, d, c * y}});
  };
  // The next term is smaller by y times a number of order one.
  EXPECT_NEAR(near_wall(1e-4) / near_wall(0.5e-4), 8, 0.01);
}

TEST(WaleModel, doesNotDependOnTheFrame) {
  const double g[3][3] = {{10, -40, 25}, {60, 5, -35}, {15, 45, -15}};
  const double c = std::cos(0.8), s = std::sin(0.8);
  const double q[3][3] = {{c, -s, 0}, {s * c, c * c, -s}, {s * s, c * s, c}};
  double turned[3][3] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) turned[i][j] += q[i][k] * g[k][l] * q[j][l];
  EXPECT_NEAR(rate(turned), rate(g), 1e-12 * rate(g));
  EXPECT_GT(rate(g), 1.0);
}

}  // namespace
}  // namespace seedflow
