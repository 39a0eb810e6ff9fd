#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sample_templates.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

DemParameters weightless() {
  DemParameters p;
  p.gravity = {};
  return p;
}

TEST(SeedContact, HeadOnRestitution) {
  for (const double e : {0.3, 0.526, 0.9}) {
    Dem dem(weightless());
    const int m = dem.add_material({});
    dem.set_contact(m, m, {e, 0.3, 0});
    dem.add_template(test::single_sphere(), m, true);
    dem.add_seed(0, {0, 0, 0}, {}, {0.2, 0, 0});
    dem.add_seed(0, {4.001e-3, 0, 0}, {}, {-0.1, 0, 0});
    dem.advance(1e-3);
    const double apart = dem.seed_state(1).velocity.x - dem.seed_state(0).velocity.x;
    EXPECT_NEAR(apart / 0.3, e, 0.01);
    EXPECT_NEAR(dem.seed_state(0).velocity.x + dem.seed_state(1).velocity.x, 0.1, 1e-14);
  }
}

// Momentum and angular momentum of an oblique collision of bonded and rigid seeds, friction and rolling
// friction on.
TEST(SeedContact, ObliqueCollisionKeepsMomentumAndAngularMomentum) {
  for (const bool rigid : {false, true}) {
    Dem dem(weightless());
    dem.add_template(test::lattice_seed(), dem.add_material({}), rigid);
    dem.add_seed(0, {0, 0, 0}, rotation({0.3, 0.1, 0}), {0.3, 0.05, 0}, {20, 0, -30});
    dem.add_seed(0, {4.5e-3, 1.2e-3, 0.4e-3}, rotation({1, -0.5, 0.2}), {-0.3, 0, 0.02}, {0, 40, 0});
    const double mass = dem.seed_template(0).mass;
    const auto angular = [&] {
      Vec3 sum;
      for (int s = 0; s < 2; ++s) {
        const SeedState state = dem.seed_state(s);
        sum += state.angular_momentum + mass * cross(state.centre, state.velocity);
      }
      return sum;
    };
    const Vec3 p0 = dem.momentum(), l0 = angular(), v0 = dem.seed_state(0).velocity;
    int contacts = 0;
    for (int k = 0; k < 50; ++k) {
      dem.advance(1e-4);
      contacts = std::max(contacts, dem.n_contacts());
    }
    EXPECT_GT(contacts, 0);
    EXPECT_GT(norm(dem.seed_state(0).velocity - v0), 0.05);
    EXPECT_LT(norm(dem.momentum() - p0), 1e-12 * mass * 0.3);
    EXPECT_LT(norm(angular() - l0), 1e-10 * norm(l0)) << (rigid ? "rigid" : "bonded");
  }
}

// The search finds exactly the pairs that a comparison of all with all finds.
TEST(SeedContact, SearchFindsAllTouchingPairs) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  Dem dem(weightless());
  const int m = dem.add_material({});
  dem.add_template(test::lattice_seed(), m, false);
  dem.add_template(test::single_sphere(1.5e-3), m, true);
  for (int k = 0; k < 60; ++k)
    dem.add_seed(k % 2, 0.008 * Vec3{u(random), u(random), u(random)},
                 rotation({u(random), u(random), 2 * u(random)}));
  dem.advance(1e-9);
  std::vector<Vec3> x;
  dem.positions(x);
  int expected = 0;
  for (int i = 0; i < dem.n_spheres(); ++i)
    for (int j = i + 1; j < dem.n_spheres(); ++j)
      expected += dem.seed_of_sphere(i) != dem.seed_of_sphere(j) &&
                  norm(x[i] - x[j]) < dem.radii()[i] + dem.radii()[j];
  EXPECT_GT(expected, 100);
  EXPECT_EQ(dem.n_contacts(), expected);
}

// Seeds far from each other must move as if each were alone, to the last bit, in whatever lane they stand.
TEST(SeedContact, SeedsDoNotFeelTheirLane) {
  const SeedTemplate model = test::lattice_seed();
  Dem many(weightless()), alone(weightless());
  many.add_template(model, many.add_material({}), false);
  alone.add_template(model, alone.add_material({}), false);
  SphereLoads load_many, load_alone;
  const int n = model.n_spheres(), count = 11, chosen = 9;
  for (int k = 0; k < count; ++k)
    many.add_seed(0, {0.02 * k, 0, 0}, rotation({0.1 * k, 0, 0}), {0, 0.1 * k, 0}, {0, 0, 9.0 * k});
  alone.add_seed(0, {0.02 * chosen, 0, 0}, rotation({0.1 * chosen, 0, 0}), {0, 0.1 * chosen, 0},
                 {0, 0, 9.0 * chosen});
  for (int i = 0; i < count * n; ++i)
    load_many.force.push_back({1e-4 * std::sin(1.0 * i), 0, 1e-4 * std::cos(3.0 * i)});
  load_alone.force.assign(load_many.force.begin() + chosen * n, load_many.force.begin() + (chosen + 1) * n);
  many.set_loads(load_many);
  alone.set_loads(load_alone);
  many.advance(1e-3);
  alone.advance(1e-3);
  std::vector<Vec3> a, b;
  many.positions(a);
  alone.positions(b);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) ASSERT_EQ(a[chosen * n + i][c], b[i][c]);
}

}  // namespace
}  // namespace seedflow
