#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

// A chain of n touching sub-spheres of radius R at rest under balanced loads is a beam: every bond is a piece
// of length L = 2 R with the stiffnesses k_n A (stretch), k_t A (shear), k_n I (bend), k_t J (twist), that is
// E = k_n L, G = k_t L. Drag by the surroundings takes the motion out and is zero at rest.
constexpr double radius = 0.5e-3, length = 2 * radius;
const double area = M_PI * radius * radius, inertia = area * radius * radius / 4;

struct Loaded {
  std::vector<Vec3> position;
  std::vector<Quaternion> orientation;
};

class Beam : public testing::TestWithParam<std::string> {
 protected:
  Dem loaded(int n, SphereLoads load, const std::string& moments = "standard", double duration = 0.6) {
    DemParameters p;
    p.gravity = {};
    p.time_step = 1e-5;
    p.bonds.form = GetParam();
    p.bonds.moments = moments;
    p.bonds.damping_ratio = 0.5;
    Dem dem(p);
    dem.add_template(test::chain(n, radius), dem.add_material({}), false);
    dem.add_seed(0, {});
    load.drag_coefficient.assign(n, 1.2e-4);  // near the critical damping of the first bending mode
    dem.set_loads(load);
    dem.advance(duration);
    EXPECT_LT(dem.max_speed(), 1e-7) << "not at rest";
    return dem;
  }
};

TEST_P(Beam, ExtensionIsForceOverBondStiffness) {
  const int n = 11;
  const double force = 1e-3;
  SphereLoads load;
  load.force.assign(n, Vec3{});
  load.force.front() = {-force, 0, 0};
  load.force.back() = {force, 0, 0};
  const Dem dem = loaded(n, load);
  std::vector<Vec3> x;
  dem.positions(x);
  const double expected = (n - 1) * force / (1e8 * area);  // F l/(E A)
  EXPECT_NEAR(x.back().x - x.front().x - (n - 1) * length, expected, 1e-4 * expected);
}

TEST_P(Beam, ThreePointBendingFollowsTimoshenko) {
  const int n = 21, half = 10;
  const double force = 1e-6;
  SphereLoads load;
  load.force.assign(n, Vec3{});
  load.force.front() = load.force.back() = {0, 0, force};
  load.force[half] = {0, 0, -2 * force};
  const Dem dem = loaded(n, load);
  std::vector<Vec3> x;
  dem.positions(x);
  // Each half is a cantilever: F l^3/(3 E I) + F l/(G A). The chain of ten bonds itself differs by 1/(4 m^2)
  // = 0.25 %.
  const double l = half * length;
  const double expected =
      force * l * l * l / (3 * 1e8 * length * inertia) + force * l / (5e7 * length * area);
  EXPECT_NEAR(x.back().z - x[half].z, expected, 0.01 * expected);
  EXPECT_NEAR(x.front().z - x[half].z, expected, 0.01 * expected);
}

TEST_P(Beam, TorsionAndBendingByEndMoments) {
  const int n = 11;
  for (const std::string moments : {"standard", "printed"})
    for (const bool twist : {true, false}) {
      const double moment = 2e-9;
      SphereLoads load;
      load.torque.assign(n, Vec3{});
      load.torque.back() = twist ? Vec3{moment, 0, 0} : Vec3{0, moment, 0};
      load.torque.front() = -load.torque.back();
      const Dem dem = loaded(n, load, moments);
      std::vector<Vec3> x;
      dem.positions(x);
      const double stiffness = twist ? (moments == "standard" ? 5e7 : 1e8) * 2 * inertia
                                     : (moments == "standard" ? 1e8 : 5e7) * inertia;
      const double angle = (n - 1) * moment / stiffness;
      if (twist) {
        // M^2/(2 k) per bond is stored.
        EXPECT_NEAR(dem.energies().bonds, 0.5 * moment * angle, 0.01 * 0.5 * moment * angle) << moments;
      } else {
        // A circle of the angle's arc; the middle rises over the ends by l angle/8.
        const double rise = (n - 1) * length * angle / 8;
        EXPECT_NEAR(std::abs(x[5].z - 0.5 * (x.front().z + x.back().z)), rise, 0.01 * rise) << moments;
        EXPECT_NEAR(dem.energies().bonds, 0.5 * moment * angle, 0.01 * 0.5 * moment * angle) << moments;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Form, Beam, testing::Values("total", "incremental"),
                         [](const auto& info) { return info.param; });

// Both forms are the same for small motions: a spinning, vibrating seed follows the same path.
TEST(BondForms, TotalAndIncrementalAgreeForSmallMotions) {
  std::vector<Vec3> x[2];
  double stored[2];
  for (int form = 0; form < 2; ++form) {
    DemParameters p;
    p.gravity = {};
    p.bonds.form = form ? "incremental" : "total";
    Dem dem(p);
    const SeedTemplate model = test::lattice_seed();
    dem.add_template(model, dem.add_material({}), false);
    dem.add_seed(0, {}, rotation({0.4, 0.2, 0.9}), {}, {2, -1, 3});
    SphereLoads load;
    load.force.assign(model.n_spheres(), Vec3{});
    load.force.front() = {1e-4, 2e-4, 0};
    load.force.back() = {-1e-4, 0, 1e-4};
    dem.set_loads(load);
    dem.advance(2e-3);
    dem.positions(x[form]);
    stored[form] = dem.energies().bonds;
  }
  // Deformations are about 1e-6 m, a thousandth of a bond, and so is their relative difference.
  double worst = 0;
  for (std::size_t i = 0; i < x[0].size(); ++i) worst = std::max(worst, norm(x[0][i] - x[1][i]));
  EXPECT_LT(worst, 2e-8);
  EXPECT_NEAR(stored[0], stored[1], 0.01 * stored[0]);
}

}  // namespace
}  // namespace seedflow
