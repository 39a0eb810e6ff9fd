// What is at rest stays at rest: rolling friction on a slope and in a bed.

#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

constexpr double radius = 2e-3, slope = M_PI / 180, g = 9.81;

Dem spheres(const std::string& rolling_model, const Vec3& gravity, double step, double shear_modulus) {
  DemParameters p;
  p.time_step = step;
  p.gravity = gravity;
  Dem dem(p);
  Material soft;
  soft.shear_modulus = shear_modulus;
  const int m = dem.add_material(soft);
  ContactProperties properties;  // mu_r = 0.03 holds up to 1.7 degrees
  properties.rolling_model = rolling_model;
  dem.set_contact(m, m, properties);
  dem.add_template(test::single_sphere(2 * radius), m, true);
  return dem;
}

// Way of a sphere on a slope of one degree during 2 s, after 0.5 s.
double way_on_slope(const std::string& rolling_model, double step) {
  Dem dem = spheres(rolling_model, {g * std::sin(slope), 0, -g * std::cos(slope)}, step, 1.5e8);
  dem.add_wall({"slope", {}, {0, 0, 1}, {}, 0});
  dem.add_seed(0, {0, 0, radius});
  dem.advance(0.5);
  const double begin = dem.seed_state(0).centre.x;
  dem.advance(2);
  return dem.seed_state(0).centre.x - begin;
}

TEST(Creep, EpsdHoldsASphereOnASlope) {
  EXPECT_LT(std::abs(way_on_slope("EPSD", 1e-5)), 1e-12);
}

// The constant torque is at most what stops the spin within a step. The spin that friction, m g sin(slope) R,
// gives in one step is left: a creep of 5/2 g sin(slope) h, which vanishes with the step h.
TEST(Creep, ConstantTorqueCreepsInProportionToTheStep) {
  for (const double step : {1e-5, 5e-6}) {
    const double expected = 2.5 * g * std::sin(slope) * step * 2;
    EXPECT_NEAR(way_on_slope("constant torque", step), expected, 0.01 * expected);
  }
}

TEST(Creep, ABedAtRestDoesNotMove) {
  Dem dem = spheres("EPSD", {0, 0, -g}, 2e-5, 1.5e6);
  dem.add_box({0, 0, 0}, {0.0135, 0.0135, 0.1}, 0);
  for (int k = 0; k < 27; ++k)
    dem.add_seed(0, {0.0025 + 0.0043 * (k % 3), 0.0025 + 0.0043 * (k / 3 % 3), 0.0025 + 0.0043 * (k / 9)}, {},
                 {0.03 * (k % 5), 0.02 * (k % 3), 0});
  dem.advance(1.5);
  std::vector<Vec3> before, after;
  dem.positions(before);
  dem.advance(2);
  dem.positions(after);
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_LT(norm(after[k] - before[k]), 1e-9);
  EXPECT_LT(dem.energies().kinetic / dem.n_seeds(), 1e-9);
}

}  // namespace
}  // namespace seedflow
