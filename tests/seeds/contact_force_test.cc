// The sum of contact forces on a seed, and seeds that get behind walls.

#include <gtest/gtest.h>

#include <cmath>

#include "sample_templates.h"
#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

// Whatever carries a seed at rest carries its weight; two seeds on each other push each other.
TEST(ContactForce, CarriesTheWeight) {
  for (const bool rigid : {true, false}) {
    DemParameters p;
    p.time_step = 4e-6;
    p.bonds.damping_ratio = 0.1;
    Dem dem(p);
    const int m = dem.add_material({});
    dem.set_contact(m, m, {0.2, 0.5, 0.1});
    const SeedTemplate model = test::lattice_seed();
    dem.add_template(model, m, rigid);
    dem.add_wall({"floor", {}, {0, 0, 1}, {}, m});
    dem.add_seed(0, {0, 0, 2e-3});
    EXPECT_EQ(norm(dem.contact_force(0)), 0) << "before the first step";
    dem.advance(rigid ? 0.3 : 0.15);
    const Vec3 force = dem.contact_force(0);
    const double weight = model.mass * 9.81;
    EXPECT_NEAR(force.z, weight, 2e-3 * weight) << (rigid ? "rigid" : "bonded");
    EXPECT_NEAR(force.x, 0, 2e-3 * weight);
  }
}

TEST(ContactForce, IsOppositeOnTheOther) {
  DemParameters p;
  p.gravity = {};
  p.time_step = 2e-6;
  Dem dem(p);
  const int m = dem.add_material({});
  dem.add_template(test::single_sphere(), m, true);
  dem.add_seed(0, {0, 0, 0}, {}, {0.1, 0.02, 0});
  dem.add_seed(0, {3.999e-3, 0, 0});
  dem.advance(2e-5);
  EXPECT_GT(norm(dem.contact_force(0)), 0);
  EXPECT_EQ(norm(dem.contact_force(0) + dem.contact_force(1)), 0);
}

std::string complaint(const Surface& surface, double speed) {
  DemParameters p;
  p.time_step = 1e-5;
  Dem dem(p);
  const int m = dem.add_material({"soft", 1340, 0.4, 1e6});
  dem.add_template(test::single_sphere(), m, true);
  dem.add_wall({"obstacle", surface, m});
  dem.add_seed(0, {0.3e-3, 0.2e-3, 4.2e-3}, {}, {0, 0, -speed});
  try {
    dem.advance(3e-3);
  } catch (const RunError& e) {
    return e.what();
  }
  return "";
}

// 225 m/s are 2.25 mm a step: the centre is 1.95 mm above the surface, then 0.3 mm below.
// A sphere shot at a wall so fast that the contact cannot stop it is reported, whatever the wall is made of:
// RunError, status 3, with the wall and the seed.
TEST(BehindAWall, IsReported) {
  Plate plate;
  plate.thickness = 1e-3;
  plate.outline = RectangleOutline{60e-3, 20e-3};
  TriangleSurface square;
  square.vertex = {{-0.02, -0.02, 0}, {0.02, -0.02, 0}, {0.02, 0.02, 0}, {-0.02, 0.02, 0}};
  square.triangle = {{0, 1, 2}, {0, 2, 3}};
  for (const Surface& surface :
       {Surface(Plane{{}, {0, 0, 1}}), Surface(plate), Surface(Mesh(square, Mesh::Side::both, "square"))}) {
    EXPECT_EQ(complaint(surface, 1), "") << "bounces back";
    const std::string words = complaint(surface, 225);
    EXPECT_NE(words.find("passing through wall 'obstacle': seed 0"), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace seedflow
