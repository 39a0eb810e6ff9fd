#include "seedflow/seeds/feeder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sample_templates.h"
#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

struct Scene {
  Dem dem;
  int small, large;
  SeedTemplate small_model = test::single_sphere(4e-3), large_model = test::single_sphere(5e-3);

  explicit Scene(double step = 1e-5)
      : dem([&] {
          DemParameters p;
          p.time_step = step;
          return p;
        }()) {
    const int material = dem.add_material({"seed", 1340, 0.4, 1.5e6});
    small = dem.add_template(small_model, material, true);
    large = dem.add_template(large_model, material, true);
    dem.add_box({0, 0, 0}, {50e-3, 50e-3, 100e-3}, material);
  }
  FeederParameters::Kind kind(double share = 1) const { return {small, small_model, share}; }
};

double least_gap(const Dem& dem) {
  double least = 1e300;
  for (int a = 0; a < dem.n_seeds(); ++a)
    for (int b = 0; b < a; ++b)
      least = std::min(
          least, norm(dem.seed_state(a).centre - dem.seed_state(b).centre) - dem.radii()[a] - dem.radii()[b]);
  return least;
}

FeederParameters random_feeder(const Scene& s, double mass) {
  FeederParameters f;
  f.name = "hopper";
  f.places = RandomPlaces{{0, 0, 0}, {50e-3, 50e-3, 100e-3}};
  f.kinds = {s.kind()};
  f.mass = mass;
  return f;
}

TEST(Feeder, FillsToAMassWithoutOverlap) {
  Scene s;
  Feeder feeder(random_feeder(s, 0.02));
  feeder.feed(s.dem);
  // 0.02 kg / 4.490e-5 kg = 445.4
  EXPECT_EQ(s.dem.n_seeds(), 445);
  EXPECT_TRUE(feeder.finished());
  EXPECT_GE(least_gap(s.dem), 0);
  EXPECT_NO_THROW(s.dem.check());
  EXPECT_EQ(feeder.feed(s.dem), 0);
}

TEST(Feeder, TheSameNumberGivesTheSameSeedsAnotherOneOthers) {
  const auto first = [](int random_number) {
    Scene s;
    FeederParameters f = random_feeder(s, 0.002);
    f.random_number = random_number;
    Feeder(f).feed(s.dem);
    return s.dem.seed_state(20).centre;
  };
  EXPECT_EQ(norm(first(1) - first(1)), 0);
  EXPECT_GT(norm(first(1) - first(2)), 1e-4);
}

TEST(Feeder, SharesOfTemplatesAndColours) {
  Scene s;
  FeederParameters f = random_feeder(s, 0);
  f.kinds = {s.kind(3), {s.large, s.large_model, 1}};
  f.group_shares = {1, 1};
  f.first_group = 5;
  f.number = 400;
  Feeder(f).feed(s.dem);
  int large = 0, second = 0;
  for (int i = 0; i < 400; ++i) {
    large += s.dem.radii()[i] > 2.2e-3;
    second += s.dem.seed_group(i) == 6;
    EXPECT_GE(s.dem.seed_group(i), 5);
  }
  // Binomial: 100 +- 8.7 and 200 +- 10; four standard deviations.
  EXPECT_NEAR(large, 100, 35);
  EXPECT_NEAR(second, 200, 40);
}

// All orientations alike likely: each axis of the seed points everywhere, so means of its components are 0
// and of their squares 1/3.
TEST(Feeder, OrientationsAreUniform) {
  Scene s;
  Feeder(random_feeder(s, 0.02)).feed(s.dem);
  Vec3 mean, square;
  const int n = s.dem.n_seeds();
  for (int i = 0; i < n; ++i) {
    const Vec3 axis = rotate(s.dem.seed_state(i).orientation, {0, 0, 1});
    mean += axis / n;
    square += Vec3{axis.x * axis.x, axis.y * axis.y, axis.z * axis.z} / n;
  }
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(mean[d], 0, 4 * std::sqrt(1.0 / 3 / n));
    EXPECT_NEAR(square[d], 1.0 / 3, 4 * std::sqrt(4.0 / 45 / n));
  }
}

TEST(Feeder, FullIsAClearError) {
  Scene s;
  FeederParameters f = random_feeder(s, 0.2);
  try {
    Feeder(f).feed(s.dem);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'hopper' is full after"), std::string::npos) << error.what();
  }
}

TEST(Feeder, FeedsAsRoomPermits) {
  Scene s;
  FeederParameters f = random_feeder(s, 0.02);
  f.places = RandomPlaces{{10e-3, 10e-3, 80e-3}, {40e-3, 40e-3, 100e-3}, 200};
  f.as_room_permits = true;
  f.velocity = {0, 0, -0.5};
  Feeder feeder(f);
  while (!feeder.finished() && s.dem.time() < 2) feeder.feed(s.dem), s.dem.advance(5e-3);
  EXPECT_EQ(feeder.n_fed(), 445);
  EXPECT_EQ(s.dem.n_seeds(), 445);
  EXPECT_LT(s.dem.time(), 1);
}

TEST(Feeder, ABlockedFeederSaysSo) {
  Scene s;
  FeederParameters f = random_feeder(s, 0.02);
  f.places = RandomPlaces{{20e-3, 20e-3, 0}, {25e-3, 25e-3, 5e-3}, 50};
  f.as_room_permits = true;
  f.patience = 0.05;
  Feeder feeder(f);
  EXPECT_THROW(
      while (s.dem.time() < 0.2) {
        feeder.feed(s.dem);
        s.dem.advance(5e-3);
      },
      RunError);
}

TEST(Feeder, FeedsAtARateAndGoesOnAfterARestart) {
  const auto parameters = [](const Scene& s) {
    FeederParameters f = random_feeder(s, 0.01);
    f.rate = 0.02;
    f.start = 0.1;
    return f;
  };
  Scene s;
  Feeder feeder(parameters(s));
  while (s.dem.time() < 0.2995) feeder.feed(s.dem), s.dem.advance(5e-3);
  feeder.feed(s.dem);
  // 0.2 s of 0.02 kg/s, less than one seed behind.
  EXPECT_NEAR(feeder.mass_fed(), 0.004, 1.01 * s.small_model.mass);
  std::stringstream state, dem_state;
  feeder.save(state);
  Feeder again(parameters(s));
  again.load(state);
  EXPECT_EQ(again.n_fed(), feeder.n_fed());
  while (!again.finished() && s.dem.time() < 1) s.dem.advance(5e-3), again.feed(s.dem);
  EXPECT_NEAR(s.dem.time(), 0.1 + 0.5, 0.02);
  EXPECT_EQ(s.dem.n_seeds(), 223);  // 0.01 / 4.490e-5 = 222.7
}

TEST(Feeder, Lattice) {
  Scene s;
  FeederParameters f = random_feeder(s, 0);
  f.number = 8 * 8 * 4;
  f.places = LatticePlaces{{0, 0, 0}, {50e-3, 50e-3, 100e-3}, 6e-3, 1};
  Feeder(f).feed(s.dem);
  EXPECT_EQ(s.dem.n_seeds(), 256);
  EXPECT_GE(least_gap(s.dem), 0);
  EXPECT_LT(s.dem.seed_state(255).centre.z, 24e-3) << "from the bottom up";
  f.number = 8 * 8 * 16 + 1;
  Scene other;
  EXPECT_THROW(Feeder(f).feed(other.dem), InputError);
  f.places = LatticePlaces{{0, 0, 0}, {50e-3, 50e-3, 100e-3}, 3e-3, 0};
  EXPECT_THROW(Feeder(f).feed(other.dem), InputError) << "closer than the seeds are wide";
}

TEST(Feeder, ListFromAFile) {
  const auto file =
      std::filesystem::temp_directory_path() / ("seedflow_places_" + std::to_string(getpid()) + ".csv");
  std::ofstream(file) << "x, y, z, vx, vy, vz, group, qw, qx, qy, qz\n"
                         "0.01, 0.01, 0.01, 0, 0, 0.1, 3, 1, 0, 0, 0\n\n"
                         "0.02, 0.01, 0.01, 0, 0, 0, 4, 0, 0, 0, 2\n";
  Scene s;
  FeederParameters f;
  f.name = "list";
  f.kinds = {s.kind()};
  f.places = read_places(file.string());
  Feeder(f).feed(s.dem);
  ASSERT_EQ(s.dem.n_seeds(), 2);
  EXPECT_EQ(s.dem.seed_state(0).velocity.z, 0.1);
  EXPECT_EQ(s.dem.seed_group(1), 4);
  EXPECT_NEAR(std::abs(s.dem.seed_state(1).orientation.v.z), 1, 1e-15);

  std::ofstream(file) << "x, y, z\n0.01, 0.01, 0.01\n0.012, 0.01, 0.01\n";
  f.places = read_places(file.string());
  f.number = 0;
  Scene other;
  try {
    Feeder(f).feed(other.dem);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("another seed"), std::string::npos) << error.what();
  }
  std::ofstream(file) << "x, y, z\n0.01, 0.01, near\n";
  try {
    read_places(file.string());
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(":2:"), std::string::npos) << error.what();
  }
  std::filesystem::remove(file);
}

TEST(Feeder, ContradictionsAreRefused) {
  Scene s;
  FeederParameters f = random_feeder(s, 0.01);
  f.number = 3;
  EXPECT_THROW(Feeder{f}, InputError) << "number and mass";
  f.number = 0, f.mass = 0;
  EXPECT_THROW(Feeder{f}, InputError) << "neither";
  f.number = 3;
  f.kinds.clear();
  EXPECT_THROW(Feeder{f}, InputError);
  f.kinds = {s.kind(0)};
  EXPECT_THROW(Feeder{f}, InputError);
}

}  // namespace
}  // namespace seedflow
