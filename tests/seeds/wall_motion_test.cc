// Where a wall is, how fast it moves, and what it looks like.

#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/seeds/wall_polygons.h"

namespace seedflow {
namespace {

// Velocity of a material point against the difference of its places.
void expect_velocity_fits_pose(const WallMotion& motion, double time, double tolerance) {
  const Vec3 own{3e-3, -2e-3, 7e-3};
  const double h = 1e-6;
  const Vec3 difference =
      (placement(motion, time + h).to_lab(own) - placement(motion, time - h).to_lab(own)) / (2 * h);
  const Placement now = placement(motion, time);
  const Vec3 velocity = now.velocity_at(now.to_lab(own));
  EXPECT_NEAR(norm(velocity - difference), 0, tolerance) << "at " << time;
  EXPECT_NEAR(norm(now.to_wall(now.to_lab(own)) - own), 0, 1e-16);
}

TEST(WallMotion, ConstantSpeedAfterWaiting) {
  WallMotion gate = WallMotion::constant({0, 0, 1});
  gate.displacement.start = 0.5;
  gate.check("gate");
  EXPECT_EQ(placement(gate, 0.4).shift.z, 0);
  EXPECT_EQ(placement(gate, 0.4).velocity.z, 0);
  EXPECT_DOUBLE_EQ(placement(gate, 0.7).shift.z, 0.7 - 0.5);
  EXPECT_EQ(placement(gate, 0.7).velocity.z, 1);
  gate.displacement.stop = 0.6;
  EXPECT_DOUBLE_EQ(placement(gate, 2).shift.z, 0.6 - 0.5);
  EXPECT_EQ(placement(gate, 2).velocity.z, 0);
}

TEST(WallMotion, VelocityIsTheRateOfThePose) {
  WallMotion m;
  m.direction = {1, 2, -1};
  m.axis = {0.3, 0.2, 1};
  m.pivot = {1e-3, 2e-3, 0};
  m.displacement.kind = TimeLaw::Kind::ramp;
  m.displacement.speed = 0.2;
  m.displacement.duration = 0.1;
  m.angle.kind = TimeLaw::Kind::sinusoid;
  m.angle.amplitude = 0.4;
  m.angle.frequency = 3;
  m.angle.phase = 0.3;
  m.check("w");
  for (const double t : {0.03, 0.099, 0.5}) expect_velocity_fits_pose(m, t, 1e-9);
  EXPECT_DOUBLE_EQ(m.displacement.at(0.3).value, 0.2 * (0.3 - 0.05));

  m.angle = {};
  m.angle.kind = TimeLaw::Kind::expression;
  m.angle.expression = std::make_shared<const TimeExpression>("2*pi*t + 0.1*sin(40*t)");
  m.check("w");
  for (const double t : {0.01, 0.03, 1.7}) {
    EXPECT_NEAR(m.angle.at(t).rate, 2 * M_PI + 4 * std::cos(40 * t), 1e-8);
    expect_velocity_fits_pose(m, t, 1e-9);
  }
}

TEST(WallMotion, SpeedBound) {
  Wall drum("drum", Cylinder{{}, {0, 0, 1}, 0.1, 0.05}, 0, WallMotion::rotation({0, 0, 0.02}, {0, 0, 6}));
  drum.check();
  EXPECT_EQ(largest_speed(drum, 1, {-0.1, -0.1, 0}, {0.1, 0.1, 0.05}), 0) << "turns into itself";
  Wall blade("blade", Rectangle{{}, {1, 0, 0}, {0, 1, 0}, 0.1, 0.1}, 0, WallMotion::rotation({}, {0, 0, 6}));
  blade.check();
  EXPECT_NEAR(largest_speed(blade, 1, {-0.1, -0.1, 0}, {0.1, 0.1, 0.05}), 6 * std::hypot(0.1, 0.1), 1e-12);
  blade.active = false;
  EXPECT_EQ(largest_speed(blade, 1, {-0.1, -0.1, 0}, {0.1, 0.1, 0.05}), 0);
}

TEST(WallMotion, ImpossibleMotionsAreRefused) {
  WallMotion m;
  m.displacement.kind = TimeLaw::Kind::constant;
  m.direction = {};
  EXPECT_THROW(m.check("w"), InputError);
  m.direction = {1, 0, 0};
  m.displacement.kind = TimeLaw::Kind::ramp;
  EXPECT_THROW(m.check("w"), InputError);
  m.displacement.kind = TimeLaw::Kind::expression;
  m.displacement.expression = std::make_shared<const TimeExpression>("cos(t)");
  EXPECT_THROW(m.check("w"), InputError) << "jumps at its start";
  EXPECT_THROW(TimeExpression("sin(t"), InputError);
  EXPECT_THROW(TimeExpression("x + 1"), InputError);
}

double area(const PolygonSurface& s) {
  double sum = 0;
  for (const auto& p : s.polygon) {
    Vec3 a;
    for (std::size_t i = 0; i < p.size(); ++i)
      a += 0.5 * cross(s.vertex[p[i]] - s.vertex[p[0]], s.vertex[p[(i + 1) % p.size()]] - s.vertex[p[0]]);
    sum += norm(a);
  }
  return sum;
}

TEST(WallPolygons, AreasAreThoseOfTheSurfaces) {
  const Vec3 low{-0.5, -0.5, -0.5}, high{0.5, 0.5, 0.5};
  const auto of = [&](const Surface& s) {
    Wall wall("w", s, 0, WallMotion::rotation({0.1, 0, 0}, {1, 2, 3}));
    wall.check();
    return area(wall_polygons(wall, 0.7, low, high));
  };
  EXPECT_NEAR(of(Box{{0, 0, 0}, {1, 2, 3}}), 22, 1e-12);
  EXPECT_NEAR(of(Rectangle{{}, {1, 1, 0}, {0, 0, 1}, 2, 3}), 6, 1e-12);
  // A circle of 48 corners is smaller by the factor sin(2 pi/48) / (2 pi/48), its rim by sin(pi/48)/(pi/48).
  const double lid = 24 * std::sin(2 * M_PI / 48), rim = 96 * std::sin(M_PI / 48);
  EXPECT_NEAR(of(Cylinder{{}, {0, 1, 1}, 1, 2}), 2 * lid + 2 * rim, 1e-12);

  Wall plane("plane", Plane{{}, {1, 1, 1}}, 0);
  plane.check();
  // The plane through the middle across the diagonal cuts the unit cube in a regular hexagon.
  EXPECT_NEAR(area(wall_polygons(plane, 0, low, high)), 0.75 * std::sqrt(3.0), 1e-12);

  Plate sieve;
  sieve.thickness = 1e-3;
  sieve.outline = RectangleOutline{0.3, 0.15};
  HoleLattice l;
  l.pitch_along = l.pitch_across = 6e-3;
  l.n_along = 48, l.n_across = 24;
  l.staggered = true;
  sieve.holes = l;
  sieve.hole_radius = 2.1e-3;
  const double hole = 12 * std::sin(2 * M_PI / 24) * 2.1e-3 * 2.1e-3,
               edge = 48 * std::sin(M_PI / 24) * 2.1e-3;
  EXPECT_NEAR(of(sieve), 2 * (0.3 * 0.15 - 48 * 24 * hole) + (0.9 + 48 * 24 * edge) * 1e-3, 1e-7);
}

}  // namespace
}  // namespace seedflow
