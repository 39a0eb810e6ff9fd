// What is at rest stays at rest: rolling friction on a slope.

#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

constexpr double radius = 2e-3, slope = M_PI / 180, g = 9.81;

// Way of a sphere on a slope of one degree during 2 s, after 0.5 s.
double way_on_slope(const std::string& rolling_model, double step) {
  DemParameters p;
  p.time_step = step;
  p.gravity = {g * std::sin(slope), 0, -g * std::cos(slope)};
  Dem dem(p);
  const int m = dem.add_material({});
  ContactProperties properties;  // mu_r = 0.03 holds up to 1.7 degrees
  properties.rolling_model = rolling_model;
  dem.set_contact(m, m, properties);
  dem.add_template(test::single_sphere(2 * radius), m, true);
  dem.add_wall({"slope", {}, {0, 0, 1}, {}, m});
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

}  // namespace
}  // namespace seedflow
