// Every surface of a wall against closed forms, and against its own points found by brute force.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "seedflow/base/error.h"
#include "seedflow/seeds/walls.h"

namespace seedflow {
namespace {

std::vector<WallPoint> points(const Surface& surface, const Vec3& x, double reach) {
  std::vector<WallPoint> out;
  std::visit([&](const auto& s) { s.points_near(x, reach, out); }, surface);
  return out;
}

WallPoint only(const Surface& surface, const Vec3& x, double reach) {
  const auto found = points(surface, x, reach);
  EXPECT_EQ(found.size(), 1u) << "at " << x.x << " " << x.y << " " << x.z;
  return found.empty() ? WallPoint{} : found[0];
}

template <class Shape>
Shape checked(Shape s) {
  s.check("test");
  return s;
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

constexpr double tiny = 1e-15;  // round-off of lengths of millimetres

TEST(Surface, Plane) {
  const Surface s = checked(Plane{{0, 0, 1e-3}, {0, 3, 4}});
  const WallPoint p = only(s, {5, 2e-3, 3e-3}, 1);
  EXPECT_NEAR(p.distance, 0.6 * 2e-3 + 0.8 * 2e-3, tiny);
  expect_near(p.normal, {0, 0.6, 0.8}, tiny);
  EXPECT_TRUE(points(s, {0, 0, 11e-3}, 7.9e-3).empty());
  EXPECT_LT(only(s, {0, 0, 0}, 1e-3).distance, 0);
}

TEST(Surface, RectanglePushesToTheSideOfTheCentre) {
  const Surface s = checked(Rectangle{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 20e-3, 10e-3});
  expect_near(only(s, {9e-3, 4e-3, 1e-3}, 2e-3).normal, {0, 0, 1}, tiny);
  expect_near(only(s, {9e-3, 4e-3, -1e-3}, 2e-3).normal, {0, 0, -1}, tiny);
  const WallPoint edge = only(s, {13e-3, 0, 4e-3}, 6e-3);
  EXPECT_NEAR(edge.distance, 5e-3, tiny);
  expect_near(edge.normal, {0.6, 0, 0.8}, 1e-14);
  const WallPoint corner = only(s, {10e-3 + 2e-3, 5e-3 + 3e-3, 6e-3}, 8e-3);
  EXPECT_NEAR(corner.distance, 7e-3, tiny);
}

TEST(Surface, BoxGivesOnePlaceForEachFaceNearby) {
  const Surface s = checked(Box{{0, 0, 0}, {10e-3, 20e-3, 30e-3}});
  const auto found = points(s, {1e-3, 18e-3, 1.5e-3}, 3e-3);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].distance, 1e-3, tiny);
  EXPECT_EQ(found[0].feature, 0);
  EXPECT_NEAR(found[1].distance, 2e-3, tiny);
  EXPECT_EQ(found[1].feature, 3);
  expect_near(found[1].normal, {0, -1, 0}, 0);
  EXPECT_NEAR(found[2].distance, 1.5e-3, tiny);
}

TEST(Surface, DrumWithCaps) {
  const Surface s = checked(Cylinder{{1e-3, 0, 0}, {0, 2, 0}, 50e-3, 20e-3});
  const auto found = points(s, {1e-3 + 30e-3, 18e-3, 40e-3 - 1e-3}, 3e-3);
  ASSERT_EQ(found.size(), 2u);
  const double r = std::hypot(30e-3, 39e-3);
  EXPECT_NEAR(found[0].distance, 50e-3 - r, tiny);
  expect_near(found[0].normal, {-30e-3 / r, 0, -39e-3 / r}, 1e-14);
  EXPECT_NEAR(found[1].distance, 2e-3, tiny);
  expect_near(found[1].normal, {0, -1, 0}, 0);
  EXPECT_EQ(found[1].feature, 2);
}

TEST(Surface, OpenTubeHasARim) {
  const Surface s = checked(Cylinder{{}, {0, 0, 1}, 10e-3, 20e-3, Cylinder::Side::inside, true, false});
  const WallPoint p = only(s, {7e-3, 0, 24e-3}, 6e-3);
  EXPECT_NEAR(p.distance, 5e-3, tiny);
  expect_near(p.normal, {-0.6, 0, 0.8}, 1e-14);
  EXPECT_TRUE(points(s, {0, 0, 24e-3}, 6e-3).empty()) << "the opening is open";
}

TEST(Surface, RodIsASolid) {
  const Surface s = checked(Cylinder{{}, {0, 0, 1}, 10e-3, 20e-3, Cylinder::Side::outside});
  EXPECT_NEAR(only(s, {0, 12e-3, 5e-3}, 5e-3).distance, 2e-3, tiny);
  EXPECT_NEAR(only(s, {0, 3e-3, 22e-3}, 5e-3).distance, 2e-3, tiny);
  const WallPoint rim = only(s, {0, 13e-3, 24e-3}, 6e-3);
  EXPECT_NEAR(rim.distance, 5e-3, tiny);
  expect_near(rim.normal, {0, 0.6, 0.8}, 1e-14);
  EXPECT_NEAR(only(s, {0, 9e-3, 5e-3}, 5e-3).distance, -1e-3, tiny);
}

TEST(Surface, ThinTubePushesToTheSideOfTheCentre) {
  const Surface s = checked(Cylinder{{}, {0, 0, 1}, 10e-3, 20e-3, Cylinder::Side::both});
  expect_near(only(s, {9e-3, 0, 10e-3}, 3e-3).normal, {-1, 0, 0}, 0);
  expect_near(only(s, {11e-3, 0, 10e-3}, 3e-3).normal, {1, 0, 0}, 0);
  expect_near(only(s, {5e-3, 0, 21e-3}, 3e-3).normal, {0, 0, 1}, 0);
  EXPECT_EQ(points(s, {9e-3, 0, 19e-3}, 3e-3).size(), 2u) << "barrel and lid meet inside";
  EXPECT_EQ(points(s, {11e-3, 0, 21e-3}, 3e-3).size(), 1u) << "one rim outside";
}

Plate sieve() {
  Plate p;
  p.normal = {0, 0, 1};
  p.along = {1, 0, 0};
  p.thickness = 1e-3;
  p.outline = RectangleOutline{60e-3, 40e-3};
  p.hole_radius = 2.1e-3;
  HoleLattice l;
  l.pitch_along = 6e-3, l.pitch_across = 5.5e-3;
  l.n_along = 8, l.n_across = 6;
  l.staggered = true;
  p.holes = l;
  return checked(p);
}

// Distance from x to the solid plate by sampling its faces, hole walls and rim.
double sampled_distance(const Plate& p, const Vec3& x) {
  double least = 1e300;
  const double half = 0.5 * p.thickness;
  const auto& o = std::get<RectangleOutline>(p.outline);
  const auto hole_at = [&](double a, double b) {
    for (int h = 0; h < n_holes(p.holes); ++h) {
      const PlatePoint c = hole_centre(p.holes, h);
      if (std::hypot(a - c[0], b - c[1]) < p.hole_radius) return true;
    }
    return false;
  };
  const int n = 120;
  for (const double z : {-half, half})
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const double a = x.x + 6e-3 * (2.0 * i / n - 1), b = x.y + 6e-3 * (2.0 * j / n - 1);
        if (std::abs(a) > 0.5 * o.length || std::abs(b) > 0.5 * o.width || hole_at(a, b)) continue;
        least = std::min(least, norm(x - Vec3{a, b, z}));
      }
  for (int h = 0; h < n_holes(p.holes); ++h) {
    const PlatePoint c = hole_centre(p.holes, h);
    if (std::hypot(x.x - c[0], x.y - c[1]) > 10e-3) continue;
    for (int i = 0; i < 600; ++i)
      for (int k = 0; k <= 40; ++k) {
        const double angle = 2 * M_PI * i / 600;
        least =
            std::min(least, norm(x - Vec3{c[0] + p.hole_radius * std::cos(angle),
                                          c[1] + p.hole_radius * std::sin(angle), half * (k / 20.0 - 1)}));
      }
  }
  return least;
}

TEST(Surface, PlateWithHolesAgainstItsSampledPoints) {
  const Plate p = sieve();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-15e-3, 15e-3), up(-3e-3, 3e-3);
  int places = 0, in_holes = 0;
  while (places < 40) {
    const Vec3 x{u(random), u(random), up(random)};
    const auto found = points(p, x, 4e-3);
    double least = 4e-3;
    for (const WallPoint& q : found) least = std::min(least, q.distance);
    if (least < 0.2e-3) continue;
    ++places, in_holes += found.size() > 1;
    const double sampled = sampled_distance(p, x);
    // Samples lie on the surface 1e-4 apart, so at the most (0.7e-4)^2 / 2d farther away.
    EXPECT_LE(least, sampled + 1e-12);
    EXPECT_GE(least, std::min(4e-3, sampled) - 1.5e-5) << x.x << " " << x.y << " " << x.z;
  }
  EXPECT_GT(in_holes, 5);
}

TEST(Surface, HoleEdgeIsExact) {
  const Plate p = sieve();
  const Vec3 axis = p.hole_position(11);
  for (const double offset : {0.0, 0.3e-3, 1.2e-3, 2.0e-3}) {
    const auto found = points(p, axis + Vec3{offset * 0.6, offset * 0.8, 0.5e-3 + 1.5e-3}, 2.7e-3);
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(found[0].distance, std::hypot(2.1e-3 - offset, 1.5e-3), 1e-14);
  }
  const WallPoint inside = points(p, axis + Vec3{1.5e-3, 0, 0.1e-3}, 1e-3)[0];
  EXPECT_NEAR(inside.distance, 0.6e-3, 1e-14);
  expect_near(inside.normal, {-1, 0, 0}, 1e-12);
}

// A sphere in a hole smaller than itself: the sum of forces proportional to the overlap goes to zero
// sideways as the centre comes to the axis, from every direction, and is continuous along the way.
TEST(Surface, SeatIsContinuousAtTheAxis) {
  const Plate p = sieve();
  const Vec3 axis = p.hole_position(20);
  const double radius = 3e-3, overlap = 1e-5;
  const double height = 0.5e-3 + std::sqrt(std::pow(radius - overlap, 2) - std::pow(2.1e-3, 2));
  const auto force = [&](double offset, double angle) {
    Vec3 sum;
    for (const WallPoint& q :
         points(p, axis + Vec3{offset * std::cos(angle), offset * std::sin(angle), height}, radius))
      sum += (radius - q.distance) * q.normal;
    return sum;
  };
  const double up = force(0, 0).z;
  EXPECT_NEAR(up, 4 * overlap * (height - 0.5e-3) / (radius - overlap), 1e-12);
  for (double angle = 0; angle < 6.28; angle += 0.1)
    for (const double offset : {1e-12, 1e-9, 1e-8}) {
      const Vec3 f = force(offset, angle);
      // Stiffness against going sideways: 2 a^2/d^2 plus the seat's own, the same in every direction.
      EXPECT_LE(std::hypot(f.x, f.y), 4 * offset + 1e-15);
      EXPECT_NEAR(f.z, up, 4 * offset + 1e-15);
      if (offset > 1e-10) {
        EXPECT_LT(f.x * std::cos(angle) + f.y * std::sin(angle), 0) << "pushed back";
      }
    }
}

TEST(Surface, ChamferIsACone) {
  Plate p;
  p.thickness = 4e-3;
  p.outline = DiscOutline{80e-3};
  p.holes = HoleRing{60, 70e-3, 0.1};
  p.hole_radius = 1e-3;
  p.chamfer_width = p.chamfer_depth = 0.5e-3;
  p = checked(p);
  const Vec3 axis = p.hole_position(7);
  // 45 degrees: a point 1 mm above the middle of the cone, along its normal.
  const Vec3 outwards = axis / norm(axis);
  const Vec3 cone = axis + 1.25e-3 * outwards + Vec3{0, 0, 1.75e-3};
  const Vec3 normal = std::sqrt(0.5) * (Vec3{0, 0, 1} - outwards);
  const auto found = points(p, cone + 0.3e-3 * normal, 0.4e-3);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].distance, 0.3e-3, 1e-14);
  expect_near(found[0].normal, normal, 1e-10);
  const WallPoint neck = points(p, axis + 0.2e-3 * outwards, 0.9e-3)[0];
  EXPECT_NEAR(neck.distance, 0.8e-3, 1e-14);
}

TEST(Surface, ThinPlatePushesToTheSideOfTheCentre) {
  const Plate p = sieve();
  // Overlap far larger than the plate is thick: still from the side of the centre.
  expect_near(only(p, {0, 0, 0.51e-3}, 3e-3).normal, {0, 0, 1}, 0);
  expect_near(only(p, {0, 0, -0.51e-3}, 3e-3).normal, {0, 0, -1}, 0);
  const WallPoint rim = only(p, {33e-3, 0, 4.5e-3}, 6e-3);
  EXPECT_NEAR(rim.distance, 5e-3, 1e-14);
}

TEST(Surface, HolesOfAListAreFoundAsThoseOfALattice) {
  Plate lattice = sieve(), list = lattice;
  HoleList l;
  for (int h = 0; h < n_holes(lattice.holes); ++h) l.centre.push_back(hole_centre(lattice.holes, h));
  list.holes = l;
  list = checked(list);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-30e-3, 30e-3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x{u(random), u(random), 1e-3};
    const auto a = points(lattice, x, 2e-3), b = points(list, x, 2e-3);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_NEAR(a[k].distance, b[k].distance, 1e-15);
      EXPECT_EQ(a[k].feature, b[k].feature);
    }
  }
}

TEST(Surface, ImpossiblePlatesAreRefused) {
  const auto refused = [](const Plate& p, const std::string& reason) {
    Plate copy = p;
    try {
      copy.check("sieve");
      ADD_FAILURE() << "accepted although: " << reason;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  };
  Plate p = sieve();
  p.hole_radius = 25e-3;
  refused(p, "larger than the plate");
  p = sieve();
  p.hole_radius = 2.9e-3;
  EXPECT_NO_THROW(checked(p));
  p.hole_radius = 3.0e-3;
  refused(p, "overlap");
  p = sieve();
  std::get<HoleLattice>(p.holes).n_along = 11;
  refused(p, "does not lie inside");
  p = sieve();
  p.thickness = 0;
  refused(p, "thickness");
  p.thickness = 1e-3;
  p.outline = DiscOutline{60e-3};
  p.holes = HoleRing{10, 59e-3, 0};
  refused(p, "pitch radius");
  p.holes = HoleRing{10, 50e-3, 0};
  EXPECT_NO_THROW(checked(p));
  p.holes = HoleRing{80, 50e-3, 0};
  refused(p, "overlap");
  p.holes = HoleRing{10, 50e-3, 0};
  p.chamfer_width = p.chamfer_depth = 1e-3;
  refused(p, "chamfer");
}

TEST(Surface, CullNeverHidesAPlace) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-25e-3, 25e-3);
  const std::vector<Surface> surfaces{
      checked(Plane{{}, {1, 1, 1}}),
      checked(Rectangle{{}, {1, 0, 0}, {0, 1, 0}, 10e-3, 20e-3}),
      checked(Box{{-20e-3, -20e-3, -20e-3}, {20e-3, 20e-3, 20e-3}}),
      checked(Cylinder{{0, 0, -10e-3}, {0, 0, 1}, 15e-3, 20e-3}),
      checked(Cylinder{{0, 0, -10e-3}, {0, 0, 1}, 15e-3, 20e-3, Cylinder::Side::outside}),
      checked(Cylinder{{0, 0, -10e-3}, {0, 1, 1}, 15e-3, 20e-3, Cylinder::Side::both, false, true}),
      sieve()};
  for (const Surface& s : surfaces) {
    Wall wall("w", s, 0, WallMotion::rotation({1e-3, 0, 0}, {0.1, 0.2, 0.3}));
    wall.check();
    const Placement place = placement(wall, 2.0);
    for (int i = 0; i < 500; ++i) {
      const Vec3 x{u(random), u(random), u(random)};
      std::vector<WallPoint> found;
      contacts_near(wall, place, x, 2e-3, found);
      if (!may_touch(wall, place, x, 2e-3)) {
        EXPECT_TRUE(found.empty());
      }
      for (const WallPoint& q : found) EXPECT_NEAR(norm(q.normal), 1, 1e-12);
    }
  }
}

}  // namespace
}  // namespace seedflow
