#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

double full_limit(const Dem& dem, const std::string& cause) {
  for (const TimeStepLimit& limit : dem.time_step_limits())
    if (limit.cause.find(cause) != std::string::npos) return limit.full;
  return 0;
}

// Independent values for the paper's models with Table 3 and 4: Rayleigh 6.7, 5.3, 4.0 us and bonds 66, 60,
// 47 us. The latter depend on the packing; another random packing changes the highest mode by some ten per
// cent.
TEST(TimeStepLimits, PaperModels) {
  const struct {
    int n;
    double rayleigh, bonds;
  } known[] = {{36, 6.7e-6, 66e-6}, {70, 5.3e-6, 60e-6}, {164, 4.0e-6, 47e-6}};
  for (const auto& k : known) {
    SeedTemplateParameters t;
    t.n_spheres = k.n;
    Dem dem;
    dem.add_template(make_seed_template(t), dem.add_material({}), false);
    dem.add_seed(0, {});
    EXPECT_NEAR(full_limit(dem, "Rayleigh"), k.rayleigh, 0.02 * k.rayleigh) << k.n;
    EXPECT_NEAR(full_limit(dem, "bond"), k.bonds, 0.2 * k.bonds) << k.n;
    std::printf("N = %d: Rayleigh %.2f us, bonds %.1f us\n", k.n, 1e6 * full_limit(dem, "Rayleigh"),
                1e6 * full_limit(dem, "bond"));
    EXPECT_NO_THROW(dem.check());  // 1e-6 s, the paper's step
  }
}

// Two sub-spheres: omega_max^2 is the larger of k_n A (2/m) and that of the shear mode with its lever,
// k_t A (2/m + L^2/(2 I)).
TEST(TimeStepLimits, BondLimitOfAPairIsExactAndIsTheStabilityLimit) {
  const SeedTemplate pair = test::chain(2);
  const double area = M_PI * 0.25e-6, m = pair.sphere_mass[0], i = pair.sphere_inertia[0], l = 1e-3;
  const double omega2 = std::max(1e8 * area * 2 / m, 5e7 * area * (2 / m + l * l / (2 * i)));
  Dem dem;
  dem.add_template(pair, dem.add_material({}), false);
  dem.add_seed(0, {});
  EXPECT_NEAR(full_limit(dem, "bond"), 2 / std::sqrt(omega2), 1e-6 * 2 / std::sqrt(omega2));
  // Below the limit the motion stays bounded, above it explodes.
  for (const double factor : {0.97, 1.03}) {
    DemParameters p;
    p.gravity = {};
    p.time_step = factor * 2 / std::sqrt(omega2);
    Dem run(p);
    run.add_template(pair, run.add_material({}), false);
    run.add_seed(0, {});
    SphereLoads load;
    load.force = {{0, 1e-9, 0}, {1e-9, -1e-9, 0}};
    load.torque = {{0, 0, 1e-13}, {}};
    run.set_loads(load);
    run.advance(10 * p.time_step);
    run.set_loads({});
    const double before = run.max_speed();
    run.advance(25 * p.time_step);  // above the limit 1.63 times in each step
    if (factor < 1) {
      EXPECT_LT(run.max_speed(), 10 * before);
    } else {
      EXPECT_GT(run.max_speed(), 1e3 * before);
    }
  }
}

TEST(TimeStepLimits, StepAboveTheLimitIsRefusedWithCauseAndRemedy) {
  DemParameters p;
  p.time_step = 1e-5;
  Dem dem(p);
  dem.add_template(test::lattice_seed(), dem.add_material({}), false);
  dem.add_seed(0, {});
  try {
    dem.check();
    FAIL();
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("1e-05 s is above its limit"), std::string::npos) << text;
    // The lowest of all limits is named, so that one change mends everything.
    TimeStepLimit lowest = dem.time_step_limits().front();
    for (const TimeStepLimit& limit : dem.time_step_limits())
      if (limit.step() < lowest.step()) lowest = limit;
    EXPECT_NE(text.find(lowest.cause), std::string::npos) << text;
    EXPECT_NE(lowest.cause.find("sub-sphere of radius 0.0004 m of template 'lattice'"), std::string::npos);
    EXPECT_NE(text.find("Set 'Time step' to at most"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace seedflow
