#include <gtest/gtest.h>

#include <sstream>

#include "sample_templates.h"
#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

// Seeds of every kind, in contact with the floor and with each other, under loads.
Dem crowd(const std::string& form, int n_seeds = 13) {
  DemParameters p;
  p.bonds.form = form;
  p.bonds.damping_ratio = 0.01;
  p.bonds.normal_strength = 3e4;
  Dem dem(p);
  const int m = dem.add_material({});
  dem.add_template(test::lattice_seed(), m, false);
  dem.add_template(test::lattice_seed(), m, true);
  dem.add_template(test::single_sphere(), m, true);
  dem.add_box({0, 0, 0}, {0.03, 0.03, 0.06}, m);
  dem.set_wall_velocity(4, {0, 0, 0.01});
  for (int k = 0; k < n_seeds; ++k)
    dem.add_seed(k % 3, {0.004 + 0.0043 * (k % 5), 0.004 + 0.0041 * ((k / 5) % 5), 0.0021 + 1e-4 * (k % 4)},
                 rotation({0.1 * k, 0.2, 0}), {0.1 - 0.02 * k, 0.05, -0.3}, {10.0 * k, 0, 5});
  SphereLoads load;
  load.drag_coefficient.assign(dem.n_spheres(), 1e-6);
  load.flow_velocity.assign(dem.n_spheres(), {0.2, 0, 0.1});
  load.added_mass.assign(dem.n_spheres(), 1e-8);
  dem.set_loads(load);
  return dem;
}

TEST(DemCheckpoint, ContinuesToTheLastBit) {
  for (const std::string form : {"total", "incremental"}) {
    Dem through = crowd(form);
    through.advance(3e-3);
    EXPECT_GT(through.n_contacts(), 0);
    std::stringstream file;
    through.save(file);
    Dem resumed = crowd(form);
    resumed.load(file);
    through.advance(2e-3);
    resumed.advance(2e-3);
    std::vector<Vec3> a, b, va, vb, ja, jb;
    through.positions(a), resumed.positions(b);
    through.velocities(va), resumed.velocities(vb);
    through.fluid_impulses(ja), resumed.fluid_impulses(jb);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(a[i][c], b[i][c]);
        ASSERT_EQ(va[i][c], vb[i][c]);
        ASSERT_EQ(ja[i][c], jb[i][c]);
      }
    for (std::size_t w = 0; w < through.walls().size(); ++w)
      for (int c = 0; c < 3; ++c) ASSERT_EQ(through.wall_impulses()[w][c], resumed.wall_impulses()[w][c]);
    EXPECT_EQ(through.time(), resumed.time());
    EXPECT_EQ(through.n_substeps(), resumed.n_substeps());
    EXPECT_EQ(through.energies().dissipated, resumed.energies().dissipated);
  }
}

// A Dem is a value: a copy goes its own way and neither disturbs the other.
TEST(DemCheckpoint, CopiesAreIndependent) {
  Dem one = crowd("total");
  one.advance(2e-3);
  Dem copy = one;
  Dem reference = crowd("total");
  reference.advance(2e-3);
  copy.advance(1e-3);
  one.advance(1e-3);
  reference.advance(1e-3);
  std::vector<Vec3> a, b, c;
  one.velocities(a), copy.velocities(b), reference.velocities(c);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(a[i][k], c[i][k]);
      ASSERT_EQ(b[i][k], c[i][k]);
    }
}

TEST(DemCheckpoint, DamagedOrForeignStateIsRefused) {
  Dem dem = crowd("total");
  dem.advance(1e-5);
  std::stringstream file;
  dem.save(file);
  Dem other = crowd("total", 12);
  EXPECT_THROW(other.load(file), RunError);
  std::stringstream cut(file.str().substr(0, file.str().size() / 2));
  Dem same = crowd("total");
  EXPECT_THROW(same.load(cut), RunError);
}

}  // namespace
}  // namespace seedflow
