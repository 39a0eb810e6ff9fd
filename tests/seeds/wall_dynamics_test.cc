// Seeds on walls that have holes, are made of triangles, or move.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "sample_templates.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

constexpr double gravity = 9.81;

DemParameters stepping(double step) {
  DemParameters p;
  p.time_step = step;
  return p;
}

// One material, one kind of sphere.
struct Scene {
  Dem dem;
  int material, sphere;

  Scene(double diameter, const ContactProperties& properties, double step = 2e-6)
      : dem(stepping(step)), material(dem.add_material({"seed", 1340, 0.4, 1.5e7})) {
    dem.set_contact(material, material, properties);
    sphere = dem.add_template(test::single_sphere(diameter), material, true);
  }
  double energy() const {
    const DemEnergies e = dem.energies();
    return e.kinetic + e.potential;
  }
};

Plate plate_with_a_hole(double diameter) {
  Plate p;
  p.thickness = 1e-3;
  p.outline = RectangleOutline{60e-3, 20e-3};
  HoleLattice one;
  one.pitch_along = one.pitch_across = 10e-3;
  one.n_along = one.n_across = 1;
  p.holes = one;
  p.hole_radius = 0.5 * diameter;
  return p;
}

// A sphere that rolls slowly over a hole falls through it if and only if it is smaller than the hole; on the
// edge it gains no energy, and a larger one stays above.
TEST(WallDynamics, SphereFallsThroughAHoleIfItIsSmaller) {
  for (const double diameter : {3.9e-3, 4.15e-3, 4.25e-3, 4.6e-3}) {
    Scene s(diameter, {0.5, 0.3, 0.01});
    s.dem.add_wall({"sieve", plate_with_a_hole(4.2e-3), s.material});
    s.dem.add_seed(s.sphere, {-3e-3, 0.1e-3, 0.5e-3 + 0.5 * diameter}, {}, {0.03, 0, 0},
                   {0, 0.03 / (0.5 * diameter), 0});
    // A contact stores energy for 0.2 ms and gives it back: what must not grow is the largest energy of 20
    // ms.
    double before = s.energy(), lowest = 1;
    for (int block = 0; block < 30 && lowest > -4e-3; ++block) {
      double largest = -1;
      for (int k = 0; k < 40; ++k) {
        s.dem.advance(0.5e-3);
        largest = std::max(largest, s.energy());
        lowest = std::min(lowest, s.dem.seed_state(0).centre.z);
      }
      // At rest a contact stores m g overlap / 2.5, some 1e-11 J.
      EXPECT_LE(largest, before + 1e-10) << diameter << " m at " << s.dem.time() << " s";
      before = largest;
    }
    EXPECT_EQ(lowest < -3e-3, diameter < 4.2e-3) << diameter;
    if (diameter > 4.2e-3) {
      EXPECT_GT(lowest, 0) << diameter;
    }
  }
}

// Without damping and friction the edge of a hole conserves energy.
TEST(WallDynamics, EdgeOfAHoleConservesEnergy) {
  Scene s(4.6e-3, {1, 0, 0}, 5e-7);
  s.dem.add_wall({"sieve", plate_with_a_hole(4.2e-3), s.material});
  s.dem.add_seed(s.sphere, {1.1e-3, 0.4e-3, 0.5e-3 + 2.3e-3}, {}, {0, 0, 0});
  const double begin = s.energy();
  for (int k = 0; k < 100; ++k) s.dem.advance(1e-3);
  // Within what a contact stores at the speed of a fall of 1 mm.
  EXPECT_NEAR(s.energy() - begin, 0, 0.02 * s.dem.masses()[0] * gravity * 1e-3);
}

// A seed larger than the hole is held by its edge, centred by its weight.
TEST(WallDynamics, SphereSitsInAHole) {
  Scene s(5e-3, {0.3, 0.3, 0.01});
  s.dem.add_wall({"sieve", plate_with_a_hole(4.2e-3), s.material});
  const double height = 0.5e-3 + std::sqrt(2.5e-3 * 2.5e-3 - 2.1e-3 * 2.1e-3);
  s.dem.add_seed(s.sphere, {0.1e-3, 0.2e-3, height + 0.4e-3});
  s.dem.advance(0.5);
  const SeedState end = s.dem.seed_state(0);
  EXPECT_NEAR(end.centre.z, height, 2e-6);
  EXPECT_LT(std::hypot(end.centre.x, end.centre.y), 2e-6);
  EXPECT_LT(norm(end.velocity), 1e-6);
  double force = 0;
  for (const NetworkContact& c : s.dem.contact_network()) force += c.normal_force;
  // Four places at the edge carry the weight: sum F_n cos(angle) = m g, with friction bearing part of it.
  EXPECT_GT(force, 0.5 * s.dem.masses()[0] * gravity);
}

TriangleSurface floor_of_triangles() {
  TriangleSurface t;
  const int n = 9;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) t.vertex.push_back({0.02 * (2.0 * i / n - 1), 0.02 * (2.0 * j / n - 1), 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int p = i + (n + 1) * j;
      t.triangle.push_back({p, p + 1, p + n + 2}), t.triangle.push_back({p, p + n + 2, p + n + 1});
    }
  return t;
}

TEST(WallDynamics, TrianglesOfAPlaneAreThePlane) {
  const auto end_on = [](const Surface& surface) {
    Scene s(4e-3, {0.5, 0.3, 0.02});
    s.dem.add_wall({"floor", surface, s.material});
    s.dem.add_seed(s.sphere, {-17e-3, -15e-3, 2.3e-3}, {}, {0.12, 0.09, -0.1}, {1, 2, 3});
    s.dem.advance(0.15);
    return s.dem.seed_state(0);
  };
  const SeedState plane = end_on(Plane{{}, {0, 0, 1}}),
                  mesh = end_on(Mesh(floor_of_triangles(), Mesh::Side::both, "floor"));
  EXPECT_GT(plane.centre.x, -8e-3) << "has crossed many seams";
  // The same contacts up to round-off of the distances, 1e-18 m of an overlap of 1e-7 m.
  EXPECT_NEAR(norm(plane.centre - mesh.centre), 0, 1e-10);
  EXPECT_NEAR(norm(plane.velocity - mesh.velocity), 0, 1e-8);
  EXPECT_NEAR(norm(plane.spin - mesh.spin), 0, 1e-5);
}

// In a turning drum spheres roll on the wall: the velocity of the sphere's surface at the contact is that of
// the wall, omega x r, however many spheres touch.
TEST(WallDynamics, WallVelocityInATurningDrum) {
  for (int n = 1; n <= 4; ++n) {
    Scene s(4e-3, {0.5, 0.5, 0});
    const Vec3 spin{0, 4, 0};
    s.dem.add_wall({"drum", Cylinder{{0, -5e-3, 0}, {0, 1, 0}, 30e-3, 50e-3}, s.material,
                    WallMotion::rotation({}, spin)});
    for (int i = 0; i < n; ++i) s.dem.add_seed(s.sphere, {0, 9e-3 * i, -28e-3});
    s.dem.advance(0.08);
    ASSERT_EQ(s.dem.n_contacts(), n);
    for (int i = 0; i < n; ++i) {
      const SeedState now = s.dem.seed_state(i);
      const Vec3 from_axis{now.centre.x, 0, now.centre.z};
      const Vec3 outwards = from_axis / norm(from_axis), at_wall = 30e-3 * outwards;
      const Vec3 slip =
          now.velocity + cross(now.spin, (30e-3 - norm(from_axis)) * outwards) - cross(spin, at_wall);
      EXPECT_GT(norm(now.spin), 10);
      // 0.12 m/s at the wall; what is left is the elastic play of the tangential spring.
      EXPECT_LT(norm(slip), 2e-4) << n << " spheres";
      EXPECT_EQ(norm(now.velocity - s.dem.seed_state(0).velocity), 0) << "all do the same";
    }
  }
}

TEST(WallDynamics, LiftedByAPlaneAndTheImpulsesBalance) {
  Scene s(4e-3, {0.3, 0.3, 0.01});
  WallMotion lift;
  lift.direction = {0, 0, 1};
  lift.displacement.kind = TimeLaw::Kind::ramp;
  lift.displacement.speed = 0.1;
  lift.displacement.duration = 0.05;
  lift.displacement.start = 0.02;
  const int floor = s.dem.add_wall({"floor", Plane{{}, {0, 0, 1}}, s.material, lift});
  s.dem.add_seed(s.sphere, {0, 0, 2e-3});
  s.dem.advance(0.12);
  const SeedState now = s.dem.seed_state(0);
  const double mass = s.dem.masses()[0];
  EXPECT_NEAR(now.velocity.z, 0.1, 1e-5);
  // Overlap under the weight: some 1e-7 m.
  EXPECT_NEAR(now.centre.z, 2e-3 + 0.1 * (0.1 - 0.025), 1e-6);
  const Vec3 impulse = s.dem.wall_impulses()[floor];
  EXPECT_NEAR(impulse.z, mass * (now.velocity.z + gravity * 0.12), 1e-12 * mass);
}

TEST(WallDynamics, ImpulsesOfAllWallsBalanceInADrumWithABlade) {
  Scene s(4e-3, {0.5, 0.3, 0.02});
  const WallMotion turning = WallMotion::rotation({}, {0, 6, 0});
  s.dem.add_wall({"drum", Cylinder{{}, {0, 1, 0}, 20e-3, 12e-3}, s.material, turning});
  s.dem.add_wall(
      {"blade", Rectangle{{0, 6e-3, 15e-3}, {1, 0, 0}, {0, 0, 1}, 8e-3, 11e-3}, s.material, turning});
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 2; ++j) s.dem.add_seed(s.sphere, {-9e-3 + 4.5e-3 * i, 3e-3 + 5e-3 * j, -10e-3});
  s.dem.advance(0.5);
  Vec3 impulse;
  for (const Vec3& i : s.dem.wall_impulses()) impulse += i;
  double mass = 0;
  for (const double m : s.dem.masses()) mass += m;
  const Vec3 rest = impulse - s.dem.momentum() + Vec3{0, 0, -mass * gravity * 0.5};
  EXPECT_LT(norm(rest), 1e-11 * mass * gravity * 0.5);
  for (int i = 0; i < 10; ++i) {
    const Vec3 x = s.dem.seed_state(i).centre;
    EXPECT_LT(std::hypot(x.x, x.z), 18.1e-3) << "inside the drum";
  }
}

TEST(WallDynamics, GateThatSlidesAwayAndIsTakenOut) {
  Scene s(4e-3, {0.3, 0.3, 0.01});
  WallMotion pull = WallMotion::constant({1, 0, 0});
  pull.displacement.start = 0.05;
  const int gate =
      s.dem.add_wall({"gate", Rectangle{{}, {0, 0, 1}, {1, 0, 0}, 20e-3, 20e-3}, s.material, pull});
  s.dem.add_seed(s.sphere, {0, 0, 2e-3});
  s.dem.advance(0.05);
  EXPECT_NEAR(s.dem.seed_state(0).centre.z, 2e-3, 1e-6);
  s.dem.advance(0.05);  // the gate is 50 mm away
  s.dem.set_wall_active(gate, false);
  const double before = s.dem.seed_state(0).velocity.z;
  s.dem.advance(0.05);
  EXPECT_NEAR(s.dem.seed_state(0).velocity.z, before - gravity * 0.05, 1e-12);
  EXPECT_LT(s.dem.seed_state(0).centre.z, -10e-3);
}

TEST(WallDynamics, RestartOnMovingWallsIsExact) {
  const auto make = [] {
    Scene s(4e-3, {0.5, 0.3, 0.02});
    WallMotion shake = WallMotion::rotation({}, {0, 6, 0});
    shake.direction = {0, 0, 1};
    shake.displacement.kind = TimeLaw::Kind::sinusoid;
    shake.displacement.amplitude = 0.5e-3;
    shake.displacement.frequency = 30;
    Plate sieve = plate_with_a_hole(4.2e-3);
    s.dem.add_wall({"sieve", sieve, s.material, WallMotion::constant({0.01, 0, 0})});
    s.dem.add_wall({"drum", Cylinder{{0, -10e-3, 0}, {0, 1, 0}, 20e-3, 20e-3}, s.material, shake});
    for (int i = 0; i < 4; ++i) s.dem.add_seed(s.sphere, {-9e-3 + 5e-3 * i, 0.5e-3 * i, 5e-3});
    return s;
  };
  Scene through = make(), first = make(), second = make();
  through.dem.advance(0.05), through.dem.advance(0.05);
  first.dem.advance(0.05);
  std::stringstream state;
  first.dem.save(state);
  second.dem.load(state);
  second.dem.advance(0.05);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(norm(through.dem.seed_state(i).centre - second.dem.seed_state(i).centre), 0);
    EXPECT_EQ(norm(through.dem.seed_state(i).spin - second.dem.seed_state(i).spin), 0);
  }
}

}  // namespace
}  // namespace seedflow
