#include "seedflow/seeds/template_file.h"

#include <gtest/gtest.h>

#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

void expect_same(const SeedTemplate& a, const SeedTemplate& b) {
  EXPECT_EQ(a.name, b.name);
  ASSERT_EQ(a.n_spheres(), b.n_spheres());
  ASSERT_EQ(a.bond.size(), b.bond.size());
  for (int i = 0; i < a.n_spheres(); ++i) {
    for (int d = 0; d < 3; ++d) EXPECT_EQ(a.position[i][d], b.position[i][d]);
    EXPECT_EQ(a.radius[i], b.radius[i]);
    EXPECT_EQ(a.sphere_mass[i], b.sphere_mass[i]);
    EXPECT_EQ(a.sphere_inertia[i], b.sphere_inertia[i]);
  }
  for (std::size_t k = 0; k < a.bond.size(); ++k) {
    EXPECT_EQ(a.bond[k].first, b.bond[k].first);
    EXPECT_EQ(a.bond[k].second, b.bond[k].second);
    EXPECT_EQ(a.bond[k].radius, b.bond[k].radius);
  }
  EXPECT_EQ(a.relative_density, b.relative_density);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.seed_volume, b.seed_volume);
  EXPECT_EQ(a.seed_frame.w, b.seed_frame.w);
  EXPECT_EQ(a.bounding_radius, b.bounding_radius);
  for (int d = 0; d < 3; ++d) {
    EXPECT_EQ(a.inertia[d], b.inertia[d]);
    EXPECT_EQ(a.seed_semi_axes[d], b.seed_semi_axes[d]);
    EXPECT_EQ(a.seed_centre[d], b.seed_centre[d]);
    EXPECT_EQ(a.seed_frame.v[d], b.seed_frame.v[d]);
  }
}

TEST(TemplateFile, RoundTripIsExact) {
  for (const std::string shape : {"sphere", "ellipsoid"})
    for (const bool real_inertia : {false, true}) {
      SeedTemplateParameters p;
      p.shape = shape;
      p.n_spheres = 50;
      p.real_inertia = real_inertia;
      const SeedTemplate seed = make_seed_template(p);
      std::stringstream file;
      write_template(file, seed);
      expect_same(read_template(file, "memory"), seed);
    }
}

const std::string good =
    "# a comment\n"
    "name, pair \n"
    "volume,1e-8\r\n"
    "density, 1300\n"
    "\n"
    "sphere,0,0,0,1e-3\n"
    "sphere,2e-3,0,0,1e-3\n"
    "bond,0,1,1e-3\n";

TEST(TemplateFile, HandWrittenFile) {
  std::istringstream in(good);
  const SeedTemplate seed = read_template(in, "pair.csv");
  EXPECT_EQ(seed.name, "pair");
  EXPECT_EQ(seed.bond.size(), 1u);
  EXPECT_NEAR(seed.mass, 1.3e-5, 1e-19);
  EXPECT_NEAR(norm(seed.position[0] + seed.position[1]), 0, 1e-18) << "moved to the centre of mass";
  EXPECT_NEAR(seed.seed_semi_axes.x, 0.5 * seed.equivalent_diameter, 1e-17);
}

void expect_rejected(const std::string& text, const std::string& where, const std::string& reason) {
  std::istringstream in(text);
  try {
    read_template(in, "seed.csv");
    ADD_FAILURE() << "accepted; expected: " << reason;
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(where), std::string::npos) << message;
    EXPECT_NE(message.find(reason), std::string::npos) << message;
  }
}

TEST(TemplateFile, MalformedFilesAreRejectedWithFileLineAndReason) {
  expect_rejected(good + "sphere,0,0,zero,1e-3\n", "seed.csv, line 9", "'zero' is not a finite number");
  expect_rejected(good + "sphere,0,0,nan,1e-3\n", "line 9", "'nan' is not a finite number");
  expect_rejected(good + "sphere,0,0,,1e-3\n", "line 9", "'' is not a finite number");
  expect_rejected(good + "sphere,0,0,0\n", "line 9", "has 3 numbers, it needs 4 or 5");
  expect_rejected(good + "sphere,0,0,0,1e-3,2,\n", "line 9", "'' is not a finite number");
  expect_rejected(good + "sphere,0,0,0,-1e-3\n", "line 9", "must be positive");
  expect_rejected(good + "sphere,0,0,0,1e-3,2\n", "line 9", "in all rows 'sphere' or in none");
  expect_rejected(good + "bond,0,1,1e-3\n", "line 9", "given twice");
  expect_rejected(good + "bond,0,5,1e-3\n", "line 9", "out of 0..1");
  expect_rejected(good + "bond,0.5,1,1e-3\n", "line 9", "not the number of a sub-sphere");
  expect_rejected(good + "volume,2\n", "line 9", "'volume' is given twice");
  expect_rejected(good + "colour,2\n", "line 9", "'colour' is unknown; allowed: name");
  expect_rejected(good + "nonsense\n", "line 9", "not a row");
  expect_rejected(good + "frame,1,1,0,0\n", "line 9", "length 1");
  expect_rejected("volume,1\nsphere,0,0,0,1\n", "seed.csv", "'density,...' is missing");
  expect_rejected("volume,1\ndensity,1\n", "seed.csv", "no row 'sphere");
  expect_rejected(good + "sphere,9e-3,0,0,1e-3\n", "seed.csv", "2 pieces");
  EXPECT_THROW(read_template("there is no such file.csv"), InputError);
}

}  // namespace
}  // namespace seedflow
