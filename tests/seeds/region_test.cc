#include "seedflow/seeds/region.h"

#include <gtest/gtest.h>

#include <sstream>

#include "sample_templates.h"
#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

Dem falling(int n) {
  DemParameters p;
  p.time_step = 1e-5;
  Dem dem(p);
  const int material = dem.add_material({"seed", 1340, 0.4, 1.5e7});
  const int sphere = dem.add_template(test::single_sphere(), material, true);
  for (int i = 0; i < n; ++i) dem.set_group(dem.add_seed(sphere, {0.01 * i, 0, 0.05 * i}), i % 2);
  return dem;
}

std::vector<Region> tower() {
  return {{"light gate", BoxRegion{{-1, -1, -0.06}, {1, 1, -0.04}}, Region::Action::count},
          {"upper", BoxRegion{{-1, -1, -0.2}, {1, 1, -0.1}}, Region::Action::keep},
          {"lower", CylinderRegion{{0, 0, -0.3}, {0, 0, 1}, 1, 0.15}, Region::Action::keep},
          {"outlet", HalfSpaceRegion{{0, 0, -0.4}, {0, 0, -1}}, Region::Action::remove}};
}

TEST(RegionCensus, CountsOnceKeepsFirstRemovesAndBalances) {
  Dem dem = falling(4);
  RegionCensus census(tower());
  const double mass = dem.seed_template(0).mass;
  while (dem.time() < 0.25) census.update(dem), dem.advance(1e-3);
  census.update(dem);
  // Free fall: after 0.25 s by 0.3066 m, so seeds stand at -0.307, -0.257, -0.207, -0.157.
  EXPECT_EQ(census.n_counted(0), 4);
  EXPECT_EQ(census.n_inside(0), 0);
  EXPECT_EQ(census.n_counted(1), 4);
  EXPECT_EQ(census.n_inside(1), 1);
  EXPECT_EQ(census.n_counted(2), 0) << "they belong to the region they came into first";
  EXPECT_EQ(census.n_inside(2), 3);
  const RegionEntry& first = census.entries(0)[0];
  EXPECT_EQ(first.label, 0);
  EXPECT_NEAR(first.time, std::sqrt(2 * 0.04 / 9.81), 1e-3);
  EXPECT_EQ(census.entries(0)[1].group, 1);
  while (dem.time() < 0.32) dem.advance(1e-3), census.update(dem);
  // By 0.502 m: -0.502, -0.452, -0.402, -0.352.
  EXPECT_EQ(census.n_removed(), 3);
  EXPECT_EQ(dem.n_seeds(), 1);
  EXPECT_EQ(dem.seed_label(0), 3);
  EXPECT_DOUBLE_EQ(census.mass_counted(3), 3 * mass);
  EXPECT_DOUBLE_EQ(census.mass_in(), 4 * mass);
}

TEST(RegionCensus, NothingLeavesUnnoticed) {
  Dem dem = falling(3);
  RegionCensus census(tower());
  census.update(dem);
  dem.remove_seeds({1});
  try {
    census.update(dem);
    ADD_FAILURE();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("label 1"), std::string::npos) << error.what();
  }
}

TEST(RegionCensus, GoesOnAfterARestart) {
  Dem dem = falling(4);
  RegionCensus census(tower());
  while (dem.time() < 0.29) dem.advance(1e-3), census.update(dem);
  std::stringstream state;
  census.save(state);
  RegionCensus again(tower());
  again.load(state);
  EXPECT_GT(again.n_removed(), 0);
  EXPECT_NO_THROW(again.update(dem));
  EXPECT_EQ(again.n_counted(0), 4);
  EXPECT_EQ(again.n_removed(), census.n_removed());
}

TEST(RegionCensus, ImpossibleRegionsAreRefused) {
  EXPECT_THROW(RegionCensus({{"a", BoxRegion{{0, 0, 0}, {1, 0, 1}}, Region::Action::count}}), InputError);
  EXPECT_THROW(RegionCensus({{"a", CylinderRegion{{}, {}, 1, 1}, Region::Action::count}}), InputError);
  EXPECT_THROW(RegionCensus({tower()[0], tower()[0]}), InputError);
}

}  // namespace
}  // namespace seedflow
