#include "seedflow/seeds/seed_template.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

SeedTemplate spheres(const std::vector<Vec3>& position, double radius) {
  SeedTemplate seed;
  seed.name = "test";
  seed.position = position;
  seed.radius.assign(position.size(), radius);
  seed.seed_volume = 3e-8;
  seed.seed_density = 1340;
  return seed;
}

TEST(SeedTemplate, OneSphereHasItsOwnInertia) {
  SeedTemplate seed = spheres({{1e-3, 2e-3, -3e-3}}, 2e-3);
  seed.finish();
  EXPECT_DOUBLE_EQ(seed.mass, 1340 * 3e-8);
  for (int d = 0; d < 3; ++d) {
    EXPECT_EQ(seed.position[0][d], 0);
    EXPECT_NEAR(seed.inertia[d] / (0.4 * seed.mass * 4e-6), 1, 1e-15);
  }
  EXPECT_DOUBLE_EQ(seed.bounding_radius, 2e-3);
  EXPECT_NEAR(M_PI / 6 * std::pow(seed.equivalent_diameter, 3) / 3e-8, 1, 1e-14);
}

// Two spheres at distance L turned anyhow: about the line 2/5 m r^2, across it m L^2/4 more (Steiner).
TEST(SeedTemplate, DumbbellIsTurnedIntoItsPrincipalAxes) {
  const double length = 3e-3, r = 1e-3;
  const Vec3 line = Vec3{1, -2, 0.5} / norm(Vec3{1, -2, 0.5});
  SeedTemplate seed = spheres({{5e-3, 0, 1e-3}, Vec3{5e-3, 0, 1e-3} + length * line}, r);
  seed.seed_centre = seed.position[0];
  seed.finish();
  const double own = 0.4 * seed.mass * r * r, across = own + seed.mass * length * length / 4;
  EXPECT_NEAR(seed.inertia.x / own, 1, 1e-12);
  EXPECT_NEAR(seed.inertia.y / across, 1, 1e-12);
  EXPECT_NEAR(seed.inertia.z / across, 1, 1e-12);
  EXPECT_NEAR(std::abs(seed.position[0].x), length / 2, 1e-15);
  EXPECT_NEAR(seed.bounding_radius, length / 2 + r, 1e-15);
  EXPECT_NEAR(norm(seed.seed_centre - seed.position[0]), 0, 1e-15);
  // The frame carries directions of the original arrangement into the template.
  const Vec3 turned = rotate(seed.seed_frame, line);
  EXPECT_NEAR(norm(turned - (seed.position[1] - seed.position[0]) / length), 0, 1e-14);
}

TEST(SeedTemplate, MassGoesWithTheCubeOfTheRadius) {
  SeedTemplate seed = spheres({{0, 0, 0}, {3e-3, 0, 0}}, 1e-3);
  seed.radius = {1e-3, 2e-3};
  seed.finish();
  EXPECT_NEAR(seed.sphere_mass[1] / seed.sphere_mass[0], 8, 1e-14);
  EXPECT_NEAR((seed.sphere_mass[0] + seed.sphere_mass[1]) / seed.mass, 1, 1e-15);
  EXPECT_NEAR(std::abs(seed.position[0].x), 8.0 / 9 * 3e-3, 1e-17);
  EXPECT_NEAR(seed.sphere_inertia[1], 0.4 * seed.sphere_mass[1] * 4e-6, 1e-25);
}

TEST(SeedTemplate, RelativeDensityWeighsTheSpheres) {
  SeedTemplate seed = spheres({{0, 0, 0}, {4e-3, 0, 0}}, 1e-3);
  seed.relative_density = {1, 3};
  seed.finish();
  EXPECT_NEAR(seed.sphere_mass[1] / seed.mass, 0.75, 1e-15);
  EXPECT_NEAR(std::abs(seed.position[0].x), 3e-3, 1e-17);
}

TEST(SeedTemplate, FinishingTwiceChangesNothing) {
  SeedTemplate seed = spheres({{0, 0, 0}, {1e-3, 2e-3, 0}, {3e-3, 1e-3, 1e-3}, {-1e-3, 0, 4e-3}}, 1e-3);
  seed.radius = {1e-3, 0.5e-3, 0.7e-3, 1.1e-3};
  seed.finish();
  const SeedTemplate once = seed;
  seed.finish();
  for (int i = 0; i < seed.n_spheres(); ++i)
    for (int d = 0; d < 3; ++d) EXPECT_EQ(seed.position[i][d], once.position[i][d]);
  for (int d = 0; d < 3; ++d) EXPECT_EQ(seed.inertia[d], once.inertia[d]);
  EXPECT_LE(seed.inertia.x, seed.inertia.y);
  EXPECT_LE(seed.inertia.y, seed.inertia.z);
}

void expect_rejected(SeedTemplate seed, const std::string& reason) {
  try {
    seed.finish();
    ADD_FAILURE() << "accepted; expected: " << reason;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
  }
}

TEST(SeedTemplate, BadTemplatesAreRejectedWithTheReason) {
  const SeedTemplate good = spheres({{0, 0, 0}, {1e-3, 0, 0}}, 1e-3);
  SeedTemplate bad = good;
  bad.radius = {1e-3};
  expect_rejected(bad, "2 positions but 1 radii");
  bad = good;
  bad.position[1].y = std::numeric_limits<double>::quiet_NaN();
  expect_rejected(bad, "position of sub-sphere 1 is not finite");
  bad = good;
  bad.radius[0] = 0;
  expect_rejected(bad, "radius of sub-sphere 0");
  bad = good;
  bad.seed_volume = 0;
  expect_rejected(bad, "volume");
  bad = good;
  bad.bond = {{0, 2, 1e-3}};
  expect_rejected(bad, "bond 0-2");
  bad.bond = {{1, 0, 1e-3}};
  expect_rejected(bad, "first < second");
  expect_rejected(spheres({}, 1e-3), "no sub-spheres");
}

}  // namespace
}  // namespace seedflow
