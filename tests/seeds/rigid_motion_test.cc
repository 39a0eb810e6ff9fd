#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

DemParameters weightless(double step = 1e-6) {
  DemParameters p;
  p.gravity = {};
  p.time_step = step;
  return p;
}

Dem rigid(const SeedTemplate& model, const DemParameters& p) {
  Dem dem(p);
  dem.add_template(model, dem.add_material({}), true);
  return dem;
}

// Torque-free symmetric top: in the lab the axis precesses about the angular momentum L at
// |L|/I_perpendicular.
double precession_error(double step) {
  const SeedTemplate model = test::chain(4);  // prolate: I_x small, I_y = I_z
  Dem dem = rigid(model, weightless(step));
  const Vec3 w{300, 80, 0};  // template frame = lab frame at the start
  dem.add_seed(0, {}, {}, {}, w);
  const Vec3 momentum{model.inertia.x * w.x, model.inertia.y * w.y, model.inertia.z * w.z};
  const double duration = 0.05;
  dem.advance(duration);
  const Vec3 axis = rotate(dem.seed_state(0).orientation, {1, 0, 0});
  const Vec3 expected = rotate(rotation((duration / model.inertia.y) * momentum), {1, 0, 0});
  EXPECT_LT(norm(dem.seed_state(0).angular_momentum - momentum), 1e-14 * norm(momentum));
  return norm(axis - expected);
}

TEST(RigidMotion, SymmetricTopPrecessesAndConvergesInSecondOrder) {
  ASSERT_NEAR(test::chain(4).inertia.y, test::chain(4).inertia.z, 1e-12 * test::chain(4).inertia.y);
  const double coarse = precession_error(2e-5), fine = precession_error(1e-5);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

TEST(RigidMotion, IsTheLimitOfStiffBonds) {
  // Both are pulled by the same constant forces; the deviation of the bonded seed falls in proportion to
  // 1/stiffness.
  const SeedTemplate model = test::chain(3);
  const auto centre_and_axis = [&](bool is_rigid, double stiffness) {
    DemParameters p = weightless(2e-7);
    p.bonds.normal_stiffness = stiffness, p.bonds.shear_stiffness = stiffness / 2,
    p.bonds.damping_ratio = 0.5;
    Dem dem(p);
    dem.add_template(model, dem.add_material({}), is_rigid);
    dem.add_seed(0, {}, {}, {}, {0, 0, 20});
    SphereLoads load;
    load.force = {{0, 1e-4, 0}, {0, 0, 0}, {0, -0.5e-4, 1e-4}};
    dem.set_loads(load);
    dem.advance(5e-3);
    std::vector<Vec3> x;
    dem.positions(x);
    return x;
  };
  const auto exact = centre_and_axis(true, 1e8);
  double last = 1;
  for (const double stiffness : {1e8, 1e9, 1e10}) {
    const auto x = centre_and_axis(false, stiffness);
    double worst = 0;
    for (int i = 0; i < 3; ++i) worst = std::max(worst, norm(x[i] - exact[i]));
    EXPECT_LT(worst, last);
    last = worst / 5;
  }
  // Static bend of a bond under the largest force: F L^3/(k_n I) = 1e-4 N (1e-3 m)^3/(1e10 N/m3 4.9e-14 m4) =
  // 2e-10 m per bond and mm of lever, times the oscillation about it; drift of the phase over 5 ms adds up to
  // 1e-7 m.
  EXPECT_LT(last * 5, 1e-7);
}

TEST(RigidMotion, FallsFreelyAndTurnsUniformly) {
  DemParameters p;
  Dem dem = rigid(test::lattice_seed(), p);
  dem.add_seed(0, {0, 0, 0.1}, {}, {0.1, 0, 0}, {0, 0, 100});
  dem.advance(1e-2);
  const SeedState s = dem.seed_state(0);
  EXPECT_NEAR(s.centre.z, 0.1 - 0.5 * 9.81 * 1e-4, 1e-13);
  EXPECT_NEAR(s.centre.x, 1e-3, 1e-14);
  const Vec3 x = rotate(s.orientation, {1, 0, 0});
  EXPECT_NEAR(std::atan2(x.y, x.x), 1.0, 1e-9);  // 100 rad/s for 0.01 s
  std::vector<Vec3> v;
  dem.velocities(v);
  EXPECT_NEAR(norm(v[0] - s.velocity),
              100 * std::hypot(test::lattice_seed().position[0].x, test::lattice_seed().position[0].y),
              1e-12);
}

}  // namespace
}  // namespace seedflow
