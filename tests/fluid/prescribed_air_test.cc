#include "seedflow/fluid/prescribed_air.h"

#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

PrescribedAir air(const std::string& x, const std::string& y, const std::string& z) {
  PrescribedAirParameters p;
  p.velocity = {x, y, z};
  return PrescribedAir(p, 1.2, 1.8e-5);
}

// Components are evaluated anew only if something that they mention has changed: the same point twice, one
// coordinate at a time, names inside of other names ("exp" has an x, "sqrt" a t), constants.
TEST(PrescribedAir, VelocityIsTheExpressionInWhateverOrderItIsAsked) {
  const PrescribedAir a = air("exp(y) + 2", "sqrt(4) * t - x*x", "-1.5e-1");
  const double points[][4] = {{1, 2, 3, 0},  {1, 2, 3, 0},  {1, 2, 3, 5}, {1, -1, 3, 5},
                              {2, -1, 3, 5}, {2, -1, 7, 5}, {1, 2, 3, 0}, {-2, -1, 7, 5}};
  for (const auto& [x, y, z, t] : points) {
    const Vec3 u = a.velocity({x, y, z}, t);
    EXPECT_DOUBLE_EQ(u.x, std::exp(y) + 2);
    EXPECT_DOUBLE_EQ(u.y, 2 * t - x * x);
    EXPECT_DOUBLE_EQ(u.z, -0.15);
  }
}

TEST(PrescribedAir, DerivativesAreThoseOfTheExpressions) {
  // u = (-w y, w x, 0) turns: curl 2 w, Du/Dt = -w^2 r, laplacian 0, so grad p = rho w^2 r.
  const PrescribedAir a = air("-3*y", "3*x", "0");
  const FlowAtPoint f = a.at({0.02, -0.01, 0.5}, 1.0);
  EXPECT_NEAR(f.vorticity.z, 6, 1e-9);
  EXPECT_NEAR(f.acceleration.x, -9 * 0.02, 1e-9);
  EXPECT_NEAR(f.acceleration.y, 9 * 0.01, 1e-9);
  EXPECT_NEAR(f.pressure_gradient.x, 1.2 * 9 * 0.02, 1e-6);  // round-off of the second difference
}

TEST(PrescribedAir, ExpressionsThatCannotBeUsedAreRefused) {
  EXPECT_THROW(air("0", "2*s", "0"), InputError);
  EXPECT_THROW(air("0", "0", "1/x"), InputError);
}

}  // namespace
}  // namespace seedflow
