#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

class Drag : public testing::TestWithParam<bool> {};  // rigid?

DemParameters weightless() {
  DemParameters p;
  p.gravity = {};
  return p;
}

// Uniform drag per mass: every sub-sphere relaxes alike, v = u + (v0 - u) exp(-t/tau), for any tau/dt.
TEST_P(Drag, RelaxationFollowsTheExponentialForAnyStrength) {
  const SeedTemplate model = test::lattice_seed();
  for (const double z : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    Dem dem(weightless());
    dem.add_template(model, dem.add_material({}), GetParam());
    dem.add_seed(0, {}, rotation({0.3, 0.1, 0.7}), {1, 0, 0});
    SphereLoads load;
    for (double m : model.sphere_mass) load.drag_coefficient.push_back(z * m / 1e-6);
    load.flow_velocity.assign(model.n_spheres(), {0, 0.5, 0});
    dem.set_loads(load);
    const int steps = 50;
    dem.advance(steps * 1e-6);
    const Vec3 v = dem.seed_state(0).velocity;
    EXPECT_NEAR(v.x, std::exp(-z * steps), 1e-10) << z;
    EXPECT_NEAR(v.y, 0.5 * (1 - std::exp(-z * steps)), 1e-10) << z;
  }
}

TEST_P(Drag, TerminalVelocity) {
  const SeedTemplate model = test::lattice_seed();
  DemParameters p;
  Dem dem(p);
  dem.add_template(model, dem.add_material({}), GetParam());
  dem.add_seed(0, {});
  SphereLoads load;
  load.drag_coefficient.assign(model.n_spheres(), 5e-4);
  dem.set_loads(load);
  dem.advance(0.02);  // tau = m/(N k) = 2.8 ms for 32 sub-spheres: 7 tau
  const double total = 5e-4 * model.n_spheres(), tau = model.mass / total;
  const double expected = -9.81 * tau * (1 - std::exp(-0.02 / tau));
  EXPECT_NEAR(dem.seed_state(0).velocity.z, expected, 2e-6 * std::abs(expected));
}

// Momentum change = gravity + explicit forces + fluid impulse, with uneven drag, added mass and a spinning
// seed.
TEST_P(Drag, ImpulseBookkeepingIsExact) {
  const SeedTemplate model = test::lattice_seed();
  for (const double strength : {1e-7, 1e-4, 1.0, 1e3}) {
    DemParameters p;
    Dem dem(p);
    dem.add_template(model, dem.add_material({}), GetParam());
    for (int k = 0; k < 3; ++k)
      dem.add_seed(0, {0.01 * k, 0, 0}, rotation({0.1 * k, 0.5, 0}), {0.2, 0.1 * k, 0}, {30, 0, 50});
    SphereLoads load;
    Vec3 explicit_force;
    for (int i = 0; i < dem.n_spheres(); ++i) {
      load.drag_coefficient.push_back(strength * (1 + 0.9 * std::sin(3.0 * i)));
      load.flow_velocity.push_back({std::sin(0.1 * i), std::cos(0.7 * i), 1});
      load.force.push_back({1e-6 * std::sin(0.3 * i), 2e-6, 0});
      load.added_mass.push_back(1e-7 * (1 + std::cos(1.0 * i)));
      explicit_force += load.force.back();
    }
    dem.set_loads(load);
    const Vec3 before = dem.momentum();
    const double duration = 1.7e-4;
    dem.advance(duration);
    std::vector<Vec3> impulse;
    dem.fluid_impulses(impulse);
    Vec3 received = duration * (explicit_force + 3 * model.mass * p.gravity);
    double scale = norm(received);
    for (const Vec3& j : impulse) received += j, scale += norm(j);
    EXPECT_LT(norm(dem.momentum() - before - received), 1e-12 * scale) << strength;
  }
}

// A free spherical body with added mass m_a accelerates with F/(m + m_a).
TEST_P(Drag, AddedMassJoinsTheInertia) {
  const SeedTemplate model = test::lattice_seed();
  Dem dem(weightless());
  dem.add_template(model, dem.add_material({}), GetParam());
  dem.add_seed(0, {});
  SphereLoads load;
  for (double m : model.sphere_mass) {
    load.added_mass.push_back(0.5 * m);
    load.force.push_back({m * 3.0, 0, 0});
  }
  dem.set_loads(load);
  dem.advance(1e-4);
  EXPECT_NEAR(dem.seed_state(0).velocity.x, 3.0 / 1.5 * 1e-4, 1e-15);
}

// Rotation in still fluid: a rigid seed with equal drag k on all sub-spheres slows its spin about z with the
// rate sum k (x^2 + y^2) / I_z.
TEST(DragRigid, SpinDecays) {
  const SeedTemplate model = test::lattice_seed();
  Dem dem(weightless());
  dem.add_template(model, dem.add_material({}), true);
  dem.add_seed(0, {}, {}, {}, {0, 0, 10});
  SphereLoads load;
  load.drag_coefficient.assign(model.n_spheres(), 1e-3);
  dem.set_loads(load);
  double square = 0;
  for (const Vec3& x : model.position) square += x.x * x.x + x.y * x.y;
  dem.advance(1e-3);
  EXPECT_NEAR(dem.seed_state(0).spin.z, 10 * std::exp(-1e-3 * square / model.inertia.z * 1e-3), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(BondedAndRigid, Drag, testing::Bool(),
                         [](const auto& info) { return info.param ? "rigid" : "bonded"; });

}  // namespace
}  // namespace seedflow
