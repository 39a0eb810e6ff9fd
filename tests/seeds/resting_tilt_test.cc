#include "seedflow/seeds/resting_tilt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

/// Eight equal sub-spheres in the corners of a cube of edge 2 a.
SeedTemplate cube(double a, double radius) {
  SeedTemplate t;
  t.name = "cube";
  for (int i = 0; i < 8; ++i) {
    t.position.push_back({i & 1 ? a : -a, i & 2 ? a : -a, i & 4 ? a : -a});
    t.radius.push_back(radius);
  }
  t.seed_volume = 8 * a * a * a;
  t.seed_density = 1340;
  t.seed_semi_axes = Vec3{a, a, a};
  t.finish();
  return t;
}

// A cube stands on six faces; downhill at an angle b to the normal of the nearest edge the edge is a / cos(b)
// away: tan(tilt) = a / ((a + r) cos b), b in [0, 45] degrees.
TEST(RestingTilt, Cube) {
  const double a = 1.2e-3, radius = 0.4e-3;
  double mean = 0;
  const int n = 1000;
  for (int k = 0; k < n; ++k) mean += std::atan(a / (a + radius) / std::cos(M_PI / 4 * (k + 0.5) / n)) / n;
  const auto tilt = resting_tilt(cube(a, radius));
  ASSERT_TRUE(tilt);
  EXPECT_EQ(tilt->n_faces, 6);
  // 72 directions instead of all: h^2/8 for each of the four kinks of slope up to 1, over 2 pi, h = 5
  // degrees.
  EXPECT_NEAR(tilt->mean, mean, 6e-4);
  EXPECT_NEAR(tilt->smallest, tilt->largest, 1e-12);
}

// The finer the model, the more it is like a ball.
TEST(RestingTilt, FinerModelsStandLessFirmly) {
  double before = M_PI / 2;
  for (const int n : {36, 70, 164}) {
    SeedTemplateParameters model;
    model.n_spheres = n;
    const auto tilt = resting_tilt(make_seed_template(model));
    ASSERT_TRUE(tilt) << n;
    EXPECT_LT(tilt->mean, before) << n;
    EXPECT_GT(tilt->smallest, 0) << n;
    before = tilt->mean;
  }
}

TEST(RestingTilt, NothingForASphere) {
  EXPECT_FALSE(resting_tilt(test::single_sphere()));
}

}  // namespace
}  // namespace seedflow
