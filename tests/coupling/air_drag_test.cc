// Seeds in air at rest, in a DEM without computed air: against closed forms.
#include "seedflow/coupling/air_drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "seedflow/effects/drag_laws.h"
#include "seedflow/effects/model_effects.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

constexpr double rho = 1.2, mu = 1.8e-5, g = 9.81;

Effect effect(double strength = 1) {
  Effect e(air_drag());
  e.set_strength(strength);
  return e;
}

SeedTemplate model_of(double diameter, double density, int n_spheres = 1) {
  SeedTemplateParameters p;
  p.diameter = diameter;
  p.density = density;
  p.n_spheres = n_spheres;
  return make_seed_template(p);
}

Dem one_seed(const SeedTemplate& model, const Vec3& velocity, const Vec3& gravity, const Vec3& spin = {}) {
  DemParameters p;
  p.time_step = 1e-4;
  p.gravity = gravity;
  Dem dem(p);
  dem.add_template(model, dem.add_material({}), true);
  dem.add_seed(0, {}, {}, velocity, spin);
  return dem;
}

// Re from 1300 to 27000: C_D = 0.44, m dv/dt = -pi/8 rho d^2 C_D v^2, so v = v0/(1 + v0 t/L) with
// L = 4 d rho_p/(3 C_D rho). k is held over 1 ms in which v changes by 0.4 % at the most; the errors of first
// order, half of that, do not add up along a path on which v0/v is linear in time: 2e-3 remains.
TEST(AirDrag, ALightBallIsBrakedAsNewtonsDragDemands) {
  const double d = 20e-3, density = 100, v0 = 20, length = 4 * d * density / (3 * 0.44 * rho);
  Dem dem = one_seed(model_of(d, density), {v0, 0, 0}, {});
  AirDrag air(effect(), {});
  for (const double t : {0.1, 0.5, 2.0}) {
    air.advance(dem, t - dem.time());
    const double v = v0 / (1 + v0 * t / length);
    EXPECT_NEAR(dem.seed_state(0).velocity.x, v, 2e-3 * v) << t;
    EXPECT_NEAR(dem.seed_state(0).centre.x, length * std::log1p(v0 * t / length), 2e-3 * length) << t;
  }
  EXPECT_EQ(air.share_of_weight(), 0);  // no gravity
  EXPECT_TRUE(air.acted());
}

// The speed at which the published law balances the weight, by bisection; half the strength against half the
// weight.
TEST(AirDrag, AFallingSphereReachesTheTerminalSpeed) {
  const double d = 1e-3, density = 1050, weight = M_PI / 6 * d * d * d * density * g;
  const DragLaw& law = drag_law("Schiller-Naumann");
  for (const double strength : {1.0, 0.5}) {
    Dem dem = one_seed(model_of(d, density), {}, {0, 0, -g});
    AirDrag air(effect(strength), {0, 0, -g});
    air.advance(dem, 8);  // 13 v/g at half the strength, 20 response times
    const double expected = terminal_speed(law, weight / strength, d, rho, mu);
    EXPECT_NEAR(-dem.seed_state(0).velocity.z, expected, 1e-6 * expected) << strength;
    EXPECT_GT(air.share_of_weight(), 0.9);
    EXPECT_LT(air.share_of_weight(), 1 + 1e-9);
  }
}

// A dust grain whose response time, 77 us, is a thirteenth of the air's step: an explicit force would
// explode. Re = 2.5e-4, at which the law is Stokes' but for 5e-4.
TEST(AirDrag, ADustGrainSinksAtStokesSpeed) {
  const double d = 5e-6, density = 1000, stokes = density * d * d * g / (18 * mu);
  Dem dem = one_seed(model_of(d, density), {0.01, 0, 0}, {0, 0, -g});
  AirDrag air(effect(), {0, 0, -g});
  air.advance(dem, 0.01);
  EXPECT_NEAR(-dem.seed_state(0).velocity.z, stokes, 1e-3 * stokes);
  EXPECT_NEAR(dem.seed_state(0).velocity.x, 0, 1e-12);
}

// What the seeds gained is what gravity and air gave; a spinning clump, round-off of 3000 substeps.
TEST(AirDrag, TheImpulseIsBooked) {
  const SeedTemplate model = model_of(4e-3, 1340, 36);
  Dem dem = one_seed(model, {5, 1, 0}, {0, 0, -g}, {20, 0, 300});
  AirDrag air(effect(), {0, 0, -g});
  const Vec3 before = dem.momentum();
  Vec3 impulse;
  for (int i = 0; i < 3; ++i) impulse += air.advance(dem, 0.1);
  const Vec3 gained = dem.momentum() - before, gravity = model.mass * 0.3 * Vec3{0, 0, -g};
  EXPECT_LT(norm(gained - gravity - impulse), 1e-12 * norm(before));
  EXPECT_GT(norm(impulse), 1e-2 * norm(before));
  EXPECT_EQ(norm(impulse - air.impulse()), 0);
}

TEST(AirDrag, WithoutMotionItDoesNotAct) {
  Dem dem = one_seed(model_of(4e-3, 1340), {}, {});
  AirDrag air(effect(), {});
  air.advance(dem, 0.01);
  EXPECT_FALSE(air.acted());
}

TEST(AirDrag, ContinuesToTheLastBit) {
  const SeedTemplate model = model_of(4e-3, 1340, 36);
  const auto begin = [&] { return one_seed(model, {5, 1, 0}, {0, 0, -g}, {0, 20, 0}); };
  Dem whole = begin(), first = begin(), second = begin();
  AirDrag air(effect(), {0, 0, -g}), before(effect(), {0, 0, -g}), after(effect(), {0, 0, -g});
  for (int i = 0; i < 4; ++i) air.advance(whole, 5e-3);
  for (int i = 0; i < 2; ++i) before.advance(first, 5e-3);
  std::stringstream seeds, state;
  first.save(seeds), before.save(state);
  second.load(seeds), after.load(state);
  for (int i = 0; i < 2; ++i) after.advance(second, 5e-3);
  EXPECT_EQ(norm(whole.seed_state(0).velocity - second.seed_state(0).velocity), 0);
  EXPECT_EQ(norm(air.impulse() - after.impulse()), 0);
  EXPECT_EQ(air.share_of_weight(), after.share_of_weight());
}

}  // namespace
}  // namespace seedflow
