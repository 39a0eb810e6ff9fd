#include "seedflow/base/device_geometry.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "seedflow/base/error.h"
#include "seedflow/base/parameters.h"

namespace seedflow {
namespace {

constexpr double degree = M_PI / 180;

// 60 holes at 30 rpm pass 30 times a second: 0.1 m apart at 10.8 km/h, the paper's numbers.
TEST(DeviceGeometry, HolesStandOnTheirCircleAndTurnWithTheDisc) {
  DeviceGeometry g;
  g.first_angle = -90 * degree;
  EXPECT_NEAR(g.pitch_angle(), 6 * degree, 1e-15);
  const Vec3 bottom = g.hole_centre(0, 0), right = g.hole_centre(0, 90 * degree), same = g.hole_centre(15, 0);
  EXPECT_NEAR(bottom.y, -g.pitch_radius, 1e-15);
  EXPECT_NEAR(right.x, g.pitch_radius, 1e-15);
  EXPECT_NEAR(norm(right - same), 0, 1e-15);
  EXPECT_EQ(g.n_holes(), 60);
  g.drilled = 5;
  EXPECT_EQ(g.n_holes(), 5);
}

TEST(DeviceGeometry, ExposureIsThePartOfTheHoleOverTheArc) {
  DeviceGeometry g;
  g.vacuum_from = -130 * degree, g.vacuum_to = 180 * degree;
  EXPECT_EQ(g.exposure(0), 1);
  EXPECT_EQ(g.exposure(360 * degree), 1);
  EXPECT_EQ(g.exposure(205 * degree), 0);
  EXPECT_EQ(g.exposure(-155 * degree), 0);
  EXPECT_NEAR(g.exposure(180 * degree), 0.5, 1e-12);
  EXPECT_NEAR(g.exposure(-130 * degree), 0.5, 1e-12);
  // A line at half the radius leaves 0.19550 of a circle: (pi/3 - sqrt(3)/4)/pi.
  const double half = std::asin(0.5 * g.hole_radius() / g.pitch_radius);
  EXPECT_NEAR(g.exposure(180 * degree + half), 0.195501, 1e-6);
  EXPECT_NEAR(g.exposure(180 * degree - half), 1 - 0.195501, 1e-6);
}

std::string complaint(const std::string& lines) {
  DeviceGeometry g;
  Parameters p;
  g.declare(p);
  const auto file = std::filesystem::temp_directory_path() / ("device-" + std::to_string(getpid()) + ".prm");
  std::ofstream(file) << "subsection Device\n" << lines << "\nend\n";
  p.read(file.string());
  std::filesystem::remove(file);
  try {
    g.check(p);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DeviceGeometry, ImpossibleGeometryIsNamed) {
  EXPECT_EQ(complaint(""), "");
  EXPECT_NE(complaint("set Pitch radius = 120 mm").find("Pitch radius"), std::string::npos);
  EXPECT_NE(complaint("set Hole diameter = 9.2 mm").find("overlap"), std::string::npos);
  EXPECT_NE(complaint("set Holes = 600").find("overlap"), std::string::npos);
  EXPECT_NE(complaint("set Chamfer = 2.5 mm\nset Holes = 20").find("as deep as the disc"), std::string::npos);
  EXPECT_NE(complaint("set Vacuum to = -140 deg").find("arc"), std::string::npos);
  EXPECT_NE(complaint("set Vacuum inner radius = 89.5 mm").find("vacuum chamber"), std::string::npos);
  EXPECT_NE(complaint("set Chamber outer radius = 101 mm").find("beyond the disc"), std::string::npos);
  EXPECT_NE(complaint("set Drilled = 61").find("fewer places"), std::string::npos);
}

}  // namespace
}  // namespace seedflow
