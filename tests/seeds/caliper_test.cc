#include "seedflow/seeds/caliper.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seedflow {
namespace {

SeedTemplate dumbbell(double length, double r) {
  SeedTemplate seed;
  seed.name = "dumbbell";
  seed.position = {{-0.5 * length, 0, 0}, {0.5 * length, 0, 0}};
  seed.radius = {r, r};
  return seed;
}

TEST(Caliper, DirectionsAreUnitAndEven) {
  Vec3 mean;
  double xx = 0, xy = 0;
  for (const Vec3& n : even_directions(2000)) {
    EXPECT_NEAR(norm(n), 1, 1e-14);
    mean += n / 2000.0;
    xx += n.x * n.x / 2000, xy += n.x * n.y / 2000;
  }
  EXPECT_NEAR(norm(mean), 0, 1e-3);
  EXPECT_NEAR(xx, 1.0 / 3, 1e-3);
  EXPECT_NEAR(xy, 0, 1e-3);
}

// Width L |cos| + 2 r; |cos| has the mean 1/2.
TEST(Caliper, Dumbbell) {
  const Caliper c = caliper(dumbbell(3, 1));
  EXPECT_NEAR(c.mean, 1.5 + 2, 1e-3);
  EXPECT_NEAR(c.largest, 5, 1e-3);
  EXPECT_NEAR(c.smallest, 2, 5e-3);
}

TEST(Caliper, RoughnessOfASmallerSphereIsADepthWithoutRoughness) {
  SeedTemplate seed = dumbbell(0, 1.5);
  const SurfaceRoughness rough = surface_roughness(seed, sphere_shape(4));
  EXPECT_NEAR(rough.mean_depth, 0.5, 1e-12);  // a sum of 2000 terms
  EXPECT_NEAR(rough.rms, 0, 1e-12);
  EXPECT_EQ(rough.covered, 1);
  EXPECT_NEAR(rough.bs, 0.75, 1e-15);
}

// One sphere of radius r with its centre at distance s from the seed's: the ray at angle t leaves it at
// s cos t + sqrt(r^2 - s^2 sin^2 t), whose mean and variance over u = cos t are integrated here by Simpson's
// rule.
TEST(Caliper, RoughnessOfAnEccentricSphere) {
  SeedTemplate seed = dumbbell(0, 1);
  seed.position = {{0.5, 0, 0}};
  seed.radius = {1};
  double mean = 0, square = 0;
  const int n = 20000;
  for (int k = 0; k <= n; ++k) {
    const double u = -1 + 2.0 * k / n, weight = (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) / (3.0 * n);
    const double depth = 2 - (0.5 * u + std::sqrt(1 - 0.25 * (1 - u * u)));
    mean += weight * depth, square += weight * depth * depth;
  }
  const SurfaceRoughness rough = surface_roughness(seed, sphere_shape(4), 20000);
  EXPECT_NEAR(rough.mean_depth, mean, 1e-4);
  EXPECT_NEAR(rough.rms, std::sqrt(square - mean * mean), 1e-4);
}

// A sphere of radius r at distance s covers the cone sin t < r/s, a share (1 - sqrt(1 - (r/s)^2)) / 2; two of
// them twice that.
TEST(Caliper, CoveredShare) {
  const SurfaceRoughness rough = surface_roughness(dumbbell(3, 0.5), sphere_shape(4), 20000);
  EXPECT_NEAR(rough.covered, 1 - std::sqrt(1 - 1.0 / 9), 2e-3);
}

TEST(Caliper, TheInsideSeenThroughGapsIsNotTheSurface) {
  SeedTemplate seed = dumbbell(3, 0.5);
  const SurfaceRoughness hollow = surface_roughness(seed, sphere_shape(4));
  seed.position.push_back({});  // surrounds the centre, 1.5 below the surface
  seed.radius.push_back(0.5);
  const SurfaceRoughness filled = surface_roughness(seed, sphere_shape(4));
  EXPECT_EQ(filled.covered, hollow.covered);
  EXPECT_EQ(filled.mean_depth, hollow.mean_depth);
}

}  // namespace
}  // namespace seedflow
