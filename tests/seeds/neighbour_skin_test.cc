#include "seedflow/seeds/neighbour_skin.h"

#include <gtest/gtest.h>

#include <sstream>

#include "sample_templates.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

// Lists that grow linearly with the skin, as the choice assumes.
ListSizes linear_lists(double skin) {
  const auto within = [](double gap) {
    return ListSizes::Within{1e4 + 4e8 * gap, 3e3 + 1e7 * gap, 500 + 1e6 * gap};
  };
  return {within(0.5 * skin), within(skin)};
}

constexpr double small_sphere = 0.4e-3, small_seed = 2e-3;

double settled_skin(NeighbourSkin& choice, double way_per_substep, int n_searches) {
  double skin = choice.begin(small_sphere, small_seed);
  for (int k = 0; k < n_searches; ++k) {
    choice.found(linear_lists(skin), 1000, 36000);
    choice.moved(way_per_substep * 20, 20);
    skin = choice.begin(small_sphere, small_seed);
  }
  return skin;
}

// s* = sqrt(S_0 u / W_1): twice the skin at four times the speed, whatever the costs are.
TEST(NeighbourSkin, GrowsWithTheRootOfSpeed) {
  NeighbourSkin choice;
  const double slow = settled_skin(choice, 1e-6, 10), fast = settled_skin(choice, 4e-6, 10);
  EXPECT_GT(slow, 0.02 * small_sphere);
  EXPECT_LT(fast, 0.5 * small_seed);
  EXPECT_NEAR(fast / slow, 2, 1e-12);
}

TEST(NeighbourSkin, ChangesByAFactorOfTwoAtMostAndStaysWithinItsBounds) {
  NeighbourSkin choice;
  EXPECT_EQ(settled_skin(choice, 1e-3, 0), 0.25 * small_sphere);
  EXPECT_EQ(settled_skin(choice, 1e-3, 1), 0.5 * small_sphere);
  EXPECT_EQ(settled_skin(choice, 1e-3, 5), 0.5 * small_seed);
  EXPECT_EQ(settled_skin(choice, 0, 20), 0.02 * small_sphere);
  NeighbourSkin fixed(1e-4);
  EXPECT_EQ(settled_skin(fixed, 1e-3, 5), 1e-4);
}

// Seeds that slowed down ask for a search, which makes the skin thinner; at its least value for no more.
TEST(NeighbourSkin, ShrinksWhenSeedsComeToRest) {
  NeighbourSkin choice;
  double skin = settled_skin(choice, 1e-5, 10);
  const double fast = skin;
  long substeps = 0;
  for (int searches = 0; searches < 20 && skin > 0.02 * small_sphere; ++searches) {
    long age = 1;
    while (!choice.is_stale(age)) ++age;
    substeps += age;
    choice.moved(1e-9 * age, age);
    skin = choice.begin(small_sphere, small_seed);
    choice.found(linear_lists(skin), 1000, 36000);
  }
  EXPECT_LT(skin, 0.1 * fast);
  EXPECT_LT(substeps, 100000);
}

TEST(NeighbourSkin, IsSaved) {
  NeighbourSkin choice, copy;
  const double skin = settled_skin(choice, 3e-6, 4);
  std::stringstream file;
  choice.save(file);
  copy.load(file);
  EXPECT_EQ(copy.begin(small_sphere, small_seed), skin);
}

// Clumps that fall at 1 m/s: by the default, the lists of a fixed quarter of a radius would last for some
// 0.75 x 0.2 mm / (2 x 1 m/s x 5 us) = 15 substeps.
TEST(NeighbourSkin, FallingClumpsSearchSeldom) {
  const auto searches = [](double skin) {
    DemParameters p;
    p.time_step = 5e-6;
    p.contacts.skin = skin;
    Dem dem(p);
    const int m = dem.add_material({});
    const SeedTemplate model = test::lattice_seed();
    dem.add_template(model, m, true);
    dem.add_wall({"floor", {}, {0, 0, 1}, {}, m});
    for (int k = 0; k < 64; ++k)
      dem.add_seed(0, {0.005 * (k % 4), 0.005 * (k / 4 % 4), 0.05 + 0.005 * (k / 16)}, {}, {0, 0, -1});
    dem.advance(0.02);
    return dem.n_searches();
  };
  const double quarter = 0.25 * test::lattice_seed().radius[0];
  EXPECT_LT(2 * searches(0), searches(quarter));
}

}  // namespace
}  // namespace seedflow
