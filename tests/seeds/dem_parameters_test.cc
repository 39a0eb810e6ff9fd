#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "seedflow/base/parameters.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

DemParameters read(const std::string& text) {
  const std::string name = testing::TempDir() + "seeds_motion.prm";
  std::ofstream(name) << text;
  DemParameters d;
  Parameters p;
  d.declare(p);
  p.read(name);
  std::remove(name.c_str());
  return d;
}

TEST(DemParameters, EntriesReachTheirVariablesAndDefaultsAreThePapers) {
  const DemParameters d = read(
      "subsection Seeds motion\n"
      "  set Time step = 2e-6\n"
      "  set Gravity = 0, 0, -1\n"
      "  subsection Bonds\n"
      "    set Form = incremental\n"
      "    set Moments = printed\n"
      "    set Damping ratio = 0.1\n"
      "  end\n"
      "  subsection Time step limits\n"
      "    set Rayleigh fraction = 0.2\n"
      "  end\n"
      "end\n");
  EXPECT_EQ(d.time_step, 2e-6);
  EXPECT_EQ(d.gravity.z, -1.0);
  EXPECT_EQ(d.bonds.form, "incremental");
  EXPECT_EQ(d.bonds.moments, "printed");
  EXPECT_EQ(d.bonds.damping_ratio, 0.1);
  EXPECT_EQ(d.bonds.normal_stiffness, 1e8);  // Table 4
  EXPECT_EQ(d.bonds.shear_stiffness, 5e7);
  EXPECT_FALSE(d.bonds.can_break());
  EXPECT_EQ(d.limits.rayleigh_fraction, 0.2);
}

TEST(DemParameters, ImpossibleValuesAreRefused) {
  EXPECT_THROW(read("subsection Seeds motion\n set Time step = 0\nend\n"), InputError);
  EXPECT_THROW(read("subsection Seeds motion\n subsection Bonds\n set Normal stiffness = -1\n end\nend\n"),
               InputError);
  EXPECT_THROW(read("subsection Seeds motion\n subsection Bonds\n set Form = springs\n end\nend\n"),
               InputError);
}

}  // namespace
}  // namespace seedflow
