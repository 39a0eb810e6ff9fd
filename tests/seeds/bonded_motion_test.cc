#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/seeds/dem.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

Dem one_seed(const SeedTemplate& model, DemParameters p, bool rigid = false) {
  Dem dem(p);
  dem.add_template(model, dem.add_material({}), rigid);
  return dem;
}

DemParameters weightless() {
  DemParameters p;
  p.gravity = {};
  return p;
}

TEST(BondedMotion, FreeFallIsExact) {
  DemParameters p;
  p.gravity = {0.3, 0, -9.81};
  Dem dem = one_seed(test::lattice_seed(), p);
  dem.add_seed(0, {0.01, 0.02, 0.1}, rotation({0.3, 0.2, 0.1}), {0.1, 0, 0});
  dem.advance(1e-2);
  const SeedState s = dem.seed_state(0);
  // Velocity Verlet integrates a constant acceleration exactly; the rest is round-off of 1e4 steps.
  EXPECT_NEAR(s.centre.x, 0.01 + 0.1 * 1e-2 + 0.5 * 0.3 * 1e-4, 1e-13);
  EXPECT_NEAR(s.centre.z, 0.1 - 0.5 * 9.81 * 1e-4, 1e-13);
  EXPECT_NEAR(s.velocity.z, -9.81e-2, 1e-12);
  EXPECT_LT(dem.energies().bonds, 1e-20);
}

// A template turned and moved anywhere carries no bond forces: the energy is that of round-off in the
// positions.
TEST(BondedMotion, TurnedSeedIsUnstressed) {
  for (const Vec3& turn : {Vec3{0.1, 0.2, 0.3}, Vec3{2, -1, 0.5}, Vec3{0, 3.14159, 0}}) {
    Dem dem = one_seed(test::lattice_seed(), weightless());
    dem.add_seed(0, {0.1, -0.2, 0.3}, rotation(turn));
    EXPECT_LT(dem.energies().bonds, 1e-28);
    dem.advance(1e-4);
    // Gaps of 1e-16 m against k A = 50 N/m give forces of 1e-14 N, 1e-8 m/s2 on 1e-6 kg.
    EXPECT_LT(dem.max_speed(), 1e-10);
  }
}

// The required figure: energy drift <= 1e-4 over 1e5 steps of 1e-6 s of a free seed that spins and vibrates.
TEST(BondedMotion, EnergyMomentumAndAngularMomentumOfFreeSpinningVibratingSeed) {
  const SeedTemplate model = make_seed_template({});  // 70 sub-spheres, the paper's BS = 0.1
  Dem dem = one_seed(model, weightless());
  dem.add_seed(0, {}, {}, {0.2, -0.1, 0.05}, {60, -40, 80});
  // A sudden pull at one end sets it vibrating.
  SphereLoads load;
  load.force.assign(dem.n_spheres(), Vec3{});
  load.force[0] = {5e-3, 2e-3, -3e-3};
  load.force[dem.n_spheres() - 1] = {-5e-3, 1e-3, 2e-3};
  dem.set_loads(load);
  dem.advance(2e-4);
  dem.set_loads({});
  dem.advance(1e-6);
  const DemEnergies before = dem.energies();
  const SeedState start = dem.seed_state(0);
  const Vec3 momentum = dem.momentum();
  EXPECT_GT(before.bonds, 0.01 * before.kinetic);
  double worst = 0;
  for (int k = 0; k < 20; ++k) {
    dem.advance(5e-3);
    const DemEnergies e = dem.energies();
    worst = std::max(worst, std::abs(e.kinetic + e.bonds - before.kinetic - before.bonds) /
                                (before.kinetic + before.bonds));
  }
  RecordProperty("energy_drift", std::to_string(worst));
  std::printf("energy drift over 1e5 steps: %.2e, bonds/kinetic at start %.3f\n", worst,
              before.bonds / before.kinetic);
  EXPECT_LE(worst, 1e-4);
  const SeedState end = dem.seed_state(0);
  EXPECT_LT(norm(dem.momentum() - momentum), 1e-12 * norm(momentum));
  EXPECT_LT(norm(end.angular_momentum - start.angular_momentum), 1e-10 * norm(start.angular_momentum));
}

}  // namespace
}  // namespace seedflow
