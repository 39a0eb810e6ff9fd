// A reduced shear modulus is harmless for what an experiment measures of single contacts: restitution,
// sliding friction, rolling friction.

#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/seeds/dem.h"
#include "seedflow/seeds/material_table.h"

namespace seedflow {
namespace {

constexpr double radius = 2e-3, gravity = 9.81, restitution = 0.526, sliding = 0.297, rolling = 0.03;
const std::vector<double> factors{1, 0.1, 0.01};

// Seeds of Table 3 with reduced moduli; contacts last factor^(-2/5) times as long and so do the steps.
Dem seeds_with(double factor, const Vec3& acceleration, double restitution_wanted = restitution) {
  DemParameters p;
  p.gravity = acceleration;
  p.time_step = 2e-7 * std::pow(factor, -0.4);
  Dem dem(p);
  MaterialTable table({"seed"});
  table.shear_modulus_factor = factor;
  table.properties("seed", "seed").restitution = restitution_wanted;
  table.apply(dem);
  dem.add_template(test::single_sphere(2 * radius), 0, true);
  return dem;
}

TEST(ShearModulus, RestitutionDoesNotDependOnIt) {
  for (const double factor : factors) {
    Dem dem = seeds_with(factor, {});
    dem.add_seed(0, {-radius, 0, 0}, {}, {0.25, 0, 0});
    dem.add_seed(0, {radius, 0, 0}, {}, {-0.25, 0, 0});
    dem.advance(1e-4 * std::pow(factor, -0.4));
    const double after = dem.seed_state(1).velocity.x - dem.seed_state(0).velocity.x;
    // Some 250 steps a contact: the error of the integrator is a few in ten thousand.
    EXPECT_NEAR(after / 0.5, restitution, 1e-3) << "factor " << factor;
  }
}

// The friction that slows a body on an incline of tan 0.4, (g sin - a)/(g cos), when it has settled into the
// motion.
double friction_on_incline(double factor, const SeedTemplate& body, double inertia_share) {
  const double tangent = 0.4, cosine = 1 / std::hypot(1.0, tangent), sine = tangent * cosine;
  Dem dem = seeds_with(factor, {gravity * sine, 0, -gravity * cosine});
  const int t = dem.add_template(body, 0, true);
  dem.add_wall({"incline", {}, {0, 0, 1}, {}, 0});
  dem.add_seed(t, {0, 0, body.radius[0] - body.position[0].z});
  dem.advance(0.03);
  const double before = dem.seed_state(0).velocity.x;
  dem.advance(0.03);
  const double acceleration = (dem.seed_state(0).velocity.x - before) / 0.03;
  return (gravity * sine - (1 + inertia_share) * acceleration) / (gravity * cosine);
}

// Four spheres in a square, too flat to tip over, slide: a = g (sin - mu cos).
SeedTemplate sledge() {
  SeedTemplate t;
  t.name = "sledge";
  for (const Vec3& x :
       {Vec3{-2e-3, -2e-3, 0}, Vec3{2e-3, -2e-3, 0}, Vec3{-2e-3, 2e-3, 0}, Vec3{2e-3, 2e-3, 0}})
    t.position.push_back(x), t.radius.push_back(0.5e-3);
  t.seed_volume = M_PI / 6 * std::pow(4e-3, 3);
  t.seed_density = 1340;
  t.seed_semi_axes = Vec3{2e-3, 2e-3, 2e-3};
  t.finish();
  return t;
}

TEST(ShearModulus, SlidingFrictionDoesNotDependOnIt) {
  for (const double factor : factors)
    // The four contacts still swing a little against each other after 30 ms.
    EXPECT_NEAR(friction_on_incline(factor, sledge(), 0), sliding, 0.01 * sliding) << "factor " << factor;
}

// A sphere that rolls without sliding: a (1 + 2/5) = g (sin - mu_r cos). It holds while mu exceeds the 2/7 of
// tan 0.4 that rolling needs.
TEST(ShearModulus, RollingFrictionDoesNotDependOnIt) {
  for (const double factor : factors)
    // The rolling radius is the radius less half an overlap, below 1e-3 of it.
    EXPECT_NEAR(friction_on_incline(factor, test::single_sphere(2 * radius), 0.4), rolling, 0.01 * rolling)
        << "factor " << factor;
}

// The overlap that notice() tells of is the one that the contacts have.
TEST(ShearModulus, ImpactOverlap) {
  MaterialTable table({"seed"});
  table.shear_modulus_factor = 0.01;
  Dem dem = seeds_with(0.01, {}, 1);
  dem.add_seed(0, {-radius, 0, 0}, {}, {0.15, 0, 0});
  dem.add_seed(0, {radius, 0, 0}, {}, {-0.15, 0, 0});
  double deepest = 0;
  for (int k = 0; k < 400; ++k) {
    dem.advance(1e-6);
    deepest = std::max(deepest, 2 * radius - (dem.seed_state(1).centre.x - dem.seed_state(0).centre.x));
  }
  // Looked at every microsecond of a contact of 300.
  EXPECT_NEAR(deepest / radius, table.impact_overlap(0, 0.3), 1e-4 * deepest / radius);
  EXPECT_NE(table.notice().find("meet at 1 m/s overlap by"), std::string::npos);
}

}  // namespace
}  // namespace seedflow
