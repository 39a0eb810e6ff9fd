#include "seedflow/base/vector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/base/quaternion.h"

namespace seedflow {
namespace {

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(a[d], b[d], tolerance) << "component " << d;
}

TEST(Vector, Arithmetic) {
  const Vec3 a{1, 2, 3}, b{-4, 5, 0.5};
  expect_near(a + b, {-3, 7, 3.5}, 0);
  expect_near(a - b, {5, -3, 2.5}, 0);
  expect_near(-a, {-1, -2, -3}, 0);
  expect_near(2 * a, a * 2, 0);
  expect_near(a / 4, {0.25, 0.5, 0.75}, 0);
  Vec3 c;
  expect_near(c, {0, 0, 0}, 0);
  c[1] = 7;
  EXPECT_EQ(c.y, 7);
  c += a;
  c -= b;
  expect_near(c, {5, 4, 2.5}, 0);
}

TEST(Vector, Products) {
  const Vec3 a{1, 2, 3}, b{-4, 5, 0.5};
  EXPECT_EQ(dot(a, b), 7.5);
  expect_near(cross({1, 0, 0}, {0, 1, 0}), {0, 0, 1}, 0);
  expect_near(cross(a, b), {-14, -12.5, 13}, 0);
  expect_near(cross(b, a), -cross(a, b), 0);
  EXPECT_EQ(norm({2, -3, 6}), 7);
  EXPECT_EQ(norm_square({2, -3, 6}), 49);
  // Lagrange's identity.
  EXPECT_NEAR(norm_square(cross(a, b)), norm_square(a) * norm_square(b) - dot(a, b) * dot(a, b), 1e-12);
}

TEST(Quaternion, IdentityAndQuarterTurns) {
  const Vec3 a{1, 2, 3};
  expect_near(rotate({}, a), a, 0);
  expect_near(rotate(rotation({0, 0, M_PI / 2}), a), {-2, 1, 3}, 1e-15);
  expect_near(rotate(rotation({M_PI / 2, 0, 0}), a), {1, -3, 2}, 1e-15);
  expect_near(rotate(rotation({0, M_PI / 2, 0}), a), {3, 2, -1}, 1e-15);
}

// Rodrigues' formula: a cos t + (n x a) sin t + n (n . a)(1 - cos t).
TEST(Quaternion, RotationByAnyAngleFollowsRodrigues) {
  const Vec3 axis = Vec3{1, -2, 0.5} / norm(Vec3{1, -2, 0.5}), a{0.3, 0.7, -1.1};
  for (const double t : {1e-12, 1e-9, 1e-7, 1e-3, 0.8, 3.1, 6.0, 20.0}) {
    const Quaternion q = rotation(t * axis);
    const Vec3 expected =
        std::cos(t) * a + std::sin(t) * cross(axis, a) + (1 - std::cos(t)) * dot(axis, a) * axis;
    expect_near(rotate(q, a), expected, 4e-15);
    EXPECT_NEAR(q.w * q.w + norm_square(q.v), 1, 1e-15);
    expect_near(rotate_back(q, rotate(q, a)), a, 1e-15);
    EXPECT_NEAR(norm(rotate(q, a)), norm(a), 1e-15);
  }
}

TEST(Quaternion, TinyAnglesKeepAllTheirDigits) {
  // Displacement of x under a turn of 1e-10 about z: relative accuracy, not merely absolute.
  const Vec3 moved = rotate(rotation({0, 0, 1e-10}), {1, 0, 0});
  EXPECT_NEAR(moved.y / 1e-10, 1, 1e-15);
  EXPECT_EQ(rotation({}).w, 1);
}

TEST(Quaternion, ProductsComposeRotations) {
  const Quaternion p = rotation({0.3, -1.2, 0.4}), q = rotation({2, 0.1, -0.7});
  const Vec3 a{1, 2, 3};
  expect_near(rotate(p * q, a), rotate(p, rotate(q, a)), 4e-15);
  expect_near(rotate(conjugate(p) * p, a), a, 2e-15);
  // About one axis the angles add.
  expect_near(rotate(rotation({0, 0, 0.4}) * rotation({0, 0, 1.1}), a), rotate(rotation({0, 0, 1.5}), a),
              2e-15);
  // About different axes the order matters.
  EXPECT_GT(norm(rotate(p * q, a) - rotate(q * p, a)), 0.1);
}

TEST(Quaternion, NormalizedHasUnitLengthAndTheSameRotation) {
  const Quaternion q = rotation({0.3, -1.2, 0.4}), longer{3 * q.w, 3 * q.v}, n = normalized(longer);
  EXPECT_NEAR(n.w, q.w, 1e-15);
  expect_near(n.v, q.v, 1e-15);
}

// A body turning at a constant rate w for time t has turned by w t, in however many steps.
TEST(Quaternion, ManySmallTurnsAddUp) {
  const Vec3 rate{0.5, -0.2, 1.3};
  const int steps = 1000;
  Quaternion q;
  for (int k = 0; k < steps; ++k) q = normalized(rotation(rate / double(steps)) * q);
  const Quaternion once = rotation(rate);
  EXPECT_NEAR(q.w, once.w, 1e-13);  // 1000 roundings
  expect_near(q.v, once.v, 1e-13);
}

}  // namespace
}  // namespace seedflow
