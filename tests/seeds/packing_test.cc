#include "seedflow/seeds/packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "seedflow/base/error.h"
#include "seedflow/seeds/shape_spheroid.h"

namespace seedflow {
namespace {

double smallest_distance(const Packing& p) {
  double smallest = 1e300;
  for (std::size_t i = 0; i < p.centre.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) smallest = std::min(smallest, norm(p.centre[i] - p.centre[j]));
  return smallest;
}

// Optimal arrangements of few points in the ball of radius R - r in which the centres lie: opposite points 2,
// triangle sqrt 3, tetrahedron sqrt(8/3), octahedron sqrt 2, icosahedron 1.05146 with its centre at 1.
TEST(Packing, FewSpheresFindTheOptimum) {
  const double r = 0.5e-3, room = 1.5e-3;
  const struct {
    int n;
    double distance;
  } optimum[] = {{2, 2.0}, {3, std::sqrt(3.0)}, {4, std::sqrt(8.0 / 3)}, {6, std::sqrt(2.0)}, {13, 1.0}};
  for (const auto& [n, distance] : optimum) {
    const Packing p = pack_spheres(sphere_shape(4e-3), n, r, 1);
    EXPECT_NEAR(p.smallest_distance / room, distance, 1e-3) << n << " spheres";
    EXPECT_LE(p.smallest_distance / room, distance + 1e-9) << n << " spheres";
    EXPECT_DOUBLE_EQ(p.smallest_distance, smallest_distance(p));
  }
}

TEST(Packing, OneSphereSitsAtTheDeepestPoint) {
  const Packing p = pack_spheres(ellipsoid_shape({3e-3, 2e-3, 2e-3}), 1, 2e-3, 1);
  ASSERT_EQ(p.centre.size(), 1u);
  EXPECT_EQ(norm(p.centre[0]), 0);
}

TEST(Packing, SpheresStayInsideTheHull) {
  const Vec3 axes = spheroid_semi_axes(4e-3, 0.7, SphericityKind::axes, SpheroidKind::prolate);
  for (const Shape& shape : {sphere_shape(4e-3), ellipsoid_shape(axes)}) {
    const Packing p = pack_spheres(shape, 70, 0.4e-3, 3);
    int touching = 0;
    for (const Vec3& x : p.centre) {
      Vec3 outward;
      const double depth = -shape.signed_distance(x, outward);
      EXPECT_GE(depth, 0.4e-3 * (1 - 1e-9));
      touching += depth < 0.4e-3 * (1 + 1e-3);
    }
    EXPECT_GE(touching, 35) << "half the spheres of so small a packing lie on its surface";
  }
}

TEST(Packing, TheSameNumberGivesTheSamePackingAnotherAnother) {
  const Packing a = pack_spheres(sphere_shape(4e-3), 36, 0.5e-3, 5),
                b = pack_spheres(sphere_shape(4e-3), 36, 0.5e-3, 5),
                c = pack_spheres(sphere_shape(4e-3), 36, 0.5e-3, 6);
  double other = 0;
  for (int i = 0; i < 36; ++i) {
    for (int d = 0; d < 3; ++d) EXPECT_EQ(a.centre[i][d], b.centre[i][d]);
    other += norm(a.centre[i] - c.centre[i]);
  }
  EXPECT_GT(other, 1e-3);
}

TEST(Packing, ImpossibleRequestsAreRejectedWithTheReason) {
  try {
    pack_spheres(sphere_shape(4e-3), 10, 2.1e-3, 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("0.0021 m does not fit"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("0.002 m"), std::string::npos) << error.what();
  }
  EXPECT_THROW(pack_spheres(sphere_shape(4e-3), 0, 1e-3, 1), InputError);
  EXPECT_THROW(pack_spheres(sphere_shape(4e-3), 5, 0, 1), InputError);
}

}  // namespace
}  // namespace seedflow
