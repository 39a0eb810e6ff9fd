#include "seedflow/seeds/seed_template.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "seedflow/base/error.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

TEST(SeedTemplate, Equation9MassIsExact) {
  for (const PaperModel& model : paper_models) {
    SeedTemplateParameters p;
    p.n_spheres = model.n_spheres;
    const SeedTemplate seed = make_seed_template(p);
    const double real = 1340 * M_PI / 6 * std::pow(4e-3, 3);  // 4.490e-5 kg, audit section 1
    EXPECT_NEAR(real, 4.490e-5, 5e-9);
    EXPECT_NEAR(seed.mass / real, 1, 1e-14);
    EXPECT_NEAR(std::accumulate(seed.sphere_mass.begin(), seed.sphere_mass.end(), 0.0) / real, 1, 1e-14);
  }
}

}  // namespace
}  // namespace seedflow
