#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

struct Floor {
  Dem dem;
  int sphere, wall;
};

Floor floor_and_sphere(const DemParameters& p, const ContactProperties& properties,
                       const SeedTemplate& model) {
  Floor f{Dem(p), 0, 0};
  const int seed = f.dem.add_material({"seed", 1340, 0.4, 1.5e8}),
            plate = f.dem.add_material({"resin", 1800, 0.35, 1.3e9});
  f.dem.set_contact(seed, plate, properties);
  f.sphere = f.dem.add_template(model, seed, true);
  f.wall = f.dem.add_wall({"floor", {}, {0, 0, 1}, {}, plate});
  return f;
}

DemParameters weightless(double step) {
  DemParameters p;
  p.gravity = {};
  p.time_step = step;
  return p;
}

// A seed that is taken out takes the forces it exerted with it, on its neighbour and on the floor.
TEST(WallContact, ImpulsesBalanceWhenAPressedSeedIsTakenOut) {
  for (const bool rigid : {true, false}) {
    DemParameters p;
    p.time_step = 1e-6;
    Dem dem(p);
    const int material = dem.add_material({"seed", 1340, 0.4, 1.5e8});
    const int ball = dem.add_template(test::single_sphere(), material, rigid);
    dem.add_wall({"floor", {}, {0, 0, 1}, {}, material});
    dem.add_seed(ball, {0, 0, 2e-3}, {}, {0, 0, -0.1});
    dem.add_seed(ball, {1e-4, 0, 5.999e-3}, {}, {0, 0, -0.3});
    dem.advance(3e-5);
    ASSERT_EQ(dem.n_contacts(), 2);
    dem.remove_seeds({0});
    const Vec3 momentum = dem.momentum(), given = dem.wall_impulses()[0];
    const double mass = dem.seed_template(0).mass, duration = 1e-5;
    dem.advance(duration);
    const Vec3 rest =
        dem.momentum() - momentum - (dem.wall_impulses()[0] - given) - mass * duration * p.gravity;
    // Round-off of one seed's momentum; the half step of the lost contact would be 1e-7 of it at the least.
    EXPECT_LT(norm(rest), 1e-14 * norm(momentum)) << rigid;
  }
}

// Restitution out is restitution in, at any speed and step: the damping of Tsuji et al. is exact for Hertz
// contacts.
TEST(WallContact, RestitutionOutIsRestitutionIn) {
  for (const double e : {0.2, 0.526, 0.627, 0.9, 1.0})
    for (const double speed : {0.01, 0.3, 3.0})
      for (const double step : {2e-7, 1e-6}) {
        Floor f = floor_and_sphere(weightless(step), {e, 0.3, 0.03}, test::single_sphere());
        f.dem.add_seed(f.sphere, {0, 0, 2.0005e-3}, {}, {0, 0, -speed});
        f.dem.advance(1e-6 / speed + 4e-4);
        // Time discretisation of a contact of about 60 us in steps of 1 us.
        EXPECT_NEAR(f.dem.seed_state(0).velocity.z / speed, e, 0.01) << speed << " m/s, step " << step;
      }
}

// Contact duration and depth of an elastic impact by Hertz: 2.94 depth/speed, depth = (15 m v^2/(16 E* sqrt
// R))^(2/5).
TEST(WallContact, DepthOfElasticImpactIsThatOfHertz) {
  const SeedTemplate ball = test::single_sphere();
  Floor f = floor_and_sphere(weightless(1e-7), {1.0, 0, 0}, ball);
  f.dem.add_seed(f.sphere, {0, 0, 2e-3}, {}, {0, 0, -0.5});
  const double young = 1 / ((1 - 0.16) / (2 * 1.5e8 * 1.4) + (1 - 0.1225) / (2 * 1.3e9 * 1.35));
  const double depth = std::pow(15 * ball.mass * 0.25 / (16 * young * std::sqrt(2e-3)), 0.4);
  double deepest = 0, left = 0;
  for (int k = 0; k < 2000 && left == 0; ++k) {
    f.dem.advance(1e-7);
    const double overlap = 2e-3 - f.dem.seed_state(0).centre.z;
    deepest = std::max(deepest, overlap);
    if (overlap < 0) left = f.dem.time();
  }
  EXPECT_NEAR(deepest, depth, 1e-3 * depth);
  EXPECT_NEAR(left, 2.943 * depth / 0.5, 3e-3 * left);
}

// A ball thrown along the floor slides until it rolls: v = 5/7 v0, whatever the friction.
TEST(WallContact, SlidingBallRollsAtFiveSeventhsOfItsSpeed) {
  DemParameters p;
  p.time_step = 1e-6;
  Floor f = floor_and_sphere(p, {0.5, 0.3, 0.0}, test::single_sphere());
  f.dem.add_seed(f.sphere, {0, 0, 2e-3 - 1e-8}, {}, {0.1, 0, 0});
  f.dem.advance(0.03);  // slides for 2 v0/(7 mu g) = 9.7 ms
  const SeedState s = f.dem.seed_state(0);
  EXPECT_NEAR(s.velocity.x, 0.1 * 5 / 7, 2e-4 * 0.1);
  EXPECT_NEAR(s.spin.y * 2e-3, s.velocity.x, 1e-4);
}

// Pure rolling with rolling friction: m a = -F, I w' = F R - mu_r N R  =>  a = -5/7 mu_r g.
TEST(WallContact, RollingFrictionSlowsTheBallAndStopsIt) {
  Floor f = floor_and_sphere(DemParameters{}, {0.5, 0.5, 0.05}, test::single_sphere());
  f.dem.add_seed(f.sphere, {0, 0, 2e-3 - 1.5e-8}, {}, {0.02, 0, 0}, {0, 10, 0});
  f.dem.advance(0.01);
  const double first = f.dem.seed_state(0).velocity.x;
  f.dem.advance(0.02);
  EXPECT_NEAR((f.dem.seed_state(0).velocity.x - first) / 0.02, -5.0 / 7 * 0.05 * 9.81,
              0.01 * 5.0 / 7 * 0.05 * 9.81);
  f.dem.advance(0.05);
  EXPECT_LT(norm(f.dem.seed_state(0).velocity), 1e-4);
}

// A ball that slides all through an oblique impact loses mu times the normal impulse along the wall.
TEST(WallContact, ImpulseOfSlidingImpactIsFrictionTimesNormalImpulse) {
  const double e = 1.0, mu = 0.1;
  Floor f = floor_and_sphere(weightless(1e-7), {e, mu, 0}, test::single_sphere());
  f.dem.add_seed(f.sphere, {0, 0, 2.0005e-3}, {}, {2, 0, -0.3});
  f.dem.advance(3e-4);
  EXPECT_NEAR(f.dem.seed_state(0).velocity.x, 2 - mu * (1 + e) * 0.3, 1e-4);
}

// Momentum: mass x change = gravity + impulse of the walls, to round-off; bonded and rigid seeds, moving
// wall.
TEST(WallContact, WallImpulsesBalanceTheMomentum) {
  DemParameters p;
  Dem dem(p);
  const int seed = dem.add_material({}), plate = dem.add_material({"resin", 1800, 0.35, 1.3e9});
  const SeedTemplate model = test::lattice_seed();
  dem.add_template(model, seed, false);
  dem.add_template(model, seed, true);
  dem.add_box({0, 0, 0}, {0.03, 0.03, 0.05}, plate);
  dem.set_wall_velocity(4, {0.05, 0, 0.01});
  for (int k = 0; k < 4; ++k)
    dem.add_seed(k % 2, {0.006 + 0.006 * k, 0.01, 2.6e-3 + 1e-4 * k}, rotation({0.2 * k, 0.3, 0}),
                 {0.1, 0, -0.4});
  dem.check();
  const Vec3 before = dem.momentum();
  double scale = norm(before);
  bool touched = false;
  for (int k = 0; k < 10; ++k) {
    dem.advance(7.3e-4);
    touched |= dem.n_contacts() > 0;
  }
  Vec3 received = 7.3e-3 * 4 * model.mass * p.gravity;
  for (const Vec3& j : dem.wall_impulses()) received += j, scale += norm(j);
  EXPECT_TRUE(touched);
  EXPECT_GT(norm(dem.wall_impulses()[4]), 4 * model.mass * 0.2);
  EXPECT_LT(norm(dem.momentum() - before - received), 1e-12 * scale);
}

TEST(WallContact, BondedSeedComesToRestOnTheFloor) {
  DemParameters p;
  p.bonds.damping_ratio = 0.3;
  Dem dem(p);
  const int seed = dem.add_material({}), plate = dem.add_material({"resin", 1800, 0.35, 1.3e9});
  const SeedTemplate model = test::lattice_seed();
  dem.add_template(model, seed, false);
  dem.add_wall({"floor", {}, {0, 0, 1}, {}, plate});
  dem.add_seed(0, {0, 0, 2.2e-3});
  dem.advance(0.1);
  const Vec3 before = dem.wall_impulses()[0];
  dem.advance(0.05);
  EXPECT_LT(dem.max_speed(), 1e-3);
  EXPECT_NEAR((dem.wall_impulses()[0] - before).z / 0.05, model.mass * 9.81, 0.01 * model.mass * 9.81);
}

TEST(WallContact, SeedInsideAWallOrOutsideTheDomainIsRefused) {
  Dem dem;
  const int m = dem.add_material({});
  dem.add_template(test::single_sphere(), m, true);
  dem.add_box({0, 0, 0}, {0.03, 0.03, 0.03}, m);
  dem.add_seed(0, {0.01, 0.01, 1.5e-3});
  try {
    dem.check();
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("0.0005 m inside wall 'z-'"), std::string::npos) << e.what();
  }
  Dem outside;
  outside.add_template(test::single_sphere(), outside.add_material({}), true);
  outside.set_domain({0, 0, 0}, {1, 1, 1});
  outside.add_seed(0, {0.5, 0.5, 1.2});
  try {
    outside.check();
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("outside the domain"), std::string::npos) << e.what();
  }
}

TEST(WallContact, SeedThatLeavesTheDomainStopsTheRun) {
  Dem dem;
  dem.add_template(test::single_sphere(), dem.add_material({}), true);
  dem.set_domain({-0.1, -0.1, 0}, {0.1, 0.1, 0.1});
  dem.add_seed(0, {0, 0, 1e-4});
  try {
    dem.advance(0.02);
    FAIL();
  } catch (const RunError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("seed 0 ('sphere')"), std::string::npos) << text;
    EXPECT_NE(text.find("t = 0.005 s"), std::string::npos)
        << text;  // gone at 4.5 ms, looked for every 1000 steps
  }
}

}  // namespace
}  // namespace seedflow
