// Feeders and regions as a user writes them; distributions of diameters.

#include "seedflow/seeds/feeder_parameters.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "sample_templates.h"
#include "seedflow/base/error.h"
#include "seedflow/base/parameters.h"

namespace seedflow {
namespace {

class FeederParametersFile : public ::testing::Test {
 protected:
  std::string file =
      (std::filesystem::temp_directory_path() / ("seedflow_feeders_" + std::to_string(getpid()) + ".prm"))
          .string();
  void TearDown() override { std::filesystem::remove(file); }

  std::vector<Feeder> feeders(const std::string& text) {
    std::ofstream(file) << text;
    FeederTable table = FeederTable::named_in(file, {});
    Parameters p;
    table.declare(p);
    p.read(file);
    return table.build(p, [](const std::string& name) {
      if (name == "seed") return std::vector<FeederParameters::Kind>{{0, test::single_sphere(4e-3), 1}};
      if (name == "pellets")
        return std::vector<FeederParameters::Kind>{{1, test::single_sphere(3.9e-3), 1},
                                                   {2, test::single_sphere(4.1e-3), 1}};
      throw InputError("There is no template \"" + name + "\".");
    });
  }
  std::vector<Region> regions(const std::string& text) {
    std::ofstream(file) << text;
    RegionTable table = RegionTable::named_in(file, {});
    Parameters p;
    table.declare(p);
    p.read(file);
    return table.build(p);
  }
  template <class Read>
  void refused(const Read& read, const std::string& reason) {
    try {
      read();
      ADD_FAILURE() << "accepted although: " << reason;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
    }
  }
};

const std::string left = "subsection Feeders\nset Names = left\nsubsection left\n";
const std::string box = "set Low corner = 0, 0, 0\nset High corner = 50 mm, 10 mm, 60 mm\n";
const std::string ends = "end\nend\n";

TEST_F(FeederParametersFile, FeederWithSharesAndColours) {
  const auto found =
      feeders(left + box +
              "set Mass = 50 g\nset Templates = seed, pellets\nset Shares = 3, 1\nset Rate = 10 g/s\n"
              "set First group = 2\n" +
              ends);
  ASSERT_EQ(found.size(), 1u);
  const FeederParameters& f = found[0].settings();
  EXPECT_DOUBLE_EQ(f.mass, 0.05);
  EXPECT_DOUBLE_EQ(f.rate, 0.01);
  EXPECT_EQ(f.first_group, 2);
  ASSERT_EQ(f.kinds.size(), 3u);
  EXPECT_DOUBLE_EQ(f.kinds[0].share, 3);
  EXPECT_DOUBLE_EQ(f.kinds[1].share, 0.5) << "the classes of one template share its share";
}

TEST_F(FeederParametersFile, ImpossibleFeedersAreRefused) {
  const auto with = [&](const std::string& lines) { return [=] { feeders(left + lines + ends); }; };
  refused(with(box), "number of seeds or a mass");
  refused(with("set Mass = 1 g\n"), "extent");
  refused(with(box + "set Mass = 1 g\nset Templates = maize\n"), "maize");
  refused(with(box + "set Mass = 1 g\nset Templates = seed, pellets\nset Shares = 1\n"), "shares");
  refused(with(box + "set Mass = 1 g\nset Spacing = 5 mm\n"), "not known");
  refused(with("set Places = list\nset File = missing.csv\n"), "missing.csv");
  refused(with(box + "set Places = lattice\nset Mass = 1 g\nset Jitter = 2\n"), "out of bounds");
}

TEST_F(FeederParametersFile, Regions) {
  const auto found = regions(
      "subsection Regions\nset Names = bin 1, outlet\nsubsection bin 1\nset Action = keep\n"
      "set Low corner = 0, 0, -10 cm\nset High corner = 6, 15, 0 cm\nend\n"
      "subsection outlet\nset Shape = half-space\nset Action = remove\nset Point = 0, 0, -20 cm\n"
      "set Normal = 0, 0, -1\nend\nend\n");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].has({0.03, 0.1, -0.05}));
  EXPECT_FALSE(found[0].has({0.07, 0.1, -0.05}));
  EXPECT_EQ(found[0].action, Region::Action::keep);
  EXPECT_TRUE(found[1].has({9, 9, -0.21}));
  refused([&] { regions("subsection Regions\nset Names = a\nsubsection a\nset Shape = box\nend\nend\n"); },
          "no extent");
}

TEST(SizeClasses, MeanAndDeviationOfANormalDistribution) {
  EXPECT_EQ(size_classes(0.025, 1)[0], 1);
  // Two classes: means of the halves of a normal distribution, 1 -+ sigma sqrt(2/pi).
  EXPECT_NEAR(size_classes(0.025, 2)[0], 1 - 0.025 * std::sqrt(2 / M_PI), 1e-12);
  const std::vector<double> d = size_classes(0.025, 400);
  double mean = 0, square = 0;
  for (const double x : d) mean += x / 400;
  for (const double x : d) square += (x - mean) * (x - mean) / 400;
  EXPECT_NEAR(mean, 1, 1e-12);
  // The spread inside the classes is missing, most of it in the outermost two.
  EXPECT_NEAR(std::sqrt(square), 0.025, 1e-3 * 0.025 + 5e-5);
  EXPECT_LT(std::sqrt(square), 0.025);
  EXPECT_THROW(size_classes(0.8, 5), InputError);
}

TEST(SizeClasses, ScaledTemplateKeepsDensityAndShape) {
  const SeedTemplate a = test::lattice_seed(), b = scaled(a, 1.1);
  EXPECT_NEAR(b.mass / a.mass, 1.331, 1e-12);
  EXPECT_NEAR(b.inertia.x / a.inertia.x, std::pow(1.1, 5), 1e-9);
  EXPECT_NEAR(b.bounding_radius / a.bounding_radius, 1.1, 1e-12);
  EXPECT_EQ(b.seed_density, a.seed_density);
  EXPECT_NEAR(b.bond[0].radius / a.bond[0].radius, 1.1, 1e-12);
}

}  // namespace
}  // namespace seedflow
