// A contact that passes from one feature of a wall to the next goes on: friction does not notice how a
// surface is divided.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "sample_templates.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

constexpr double radius = 2e-3, friction = 0.3;

Dem one_sphere(const Surface& surface, double step, double restitution, double skin = 0) {
  DemParameters p;
  p.time_step = step;
  p.contacts.skin = skin;
  Dem dem(p);
  const int m = dem.add_material({"seed", 1340, 0.4, 1.5e7});
  dem.set_contact(m, m, {restitution, friction, 0.02});
  dem.add_template(test::single_sphere(2 * radius), m, true);
  dem.add_wall({"floor", surface, m});
  return dem;
}

// A floor of strips along y whose triangles do not share corners across the strips' borders, so every strip
// is a facet of its own.
TriangleSurface floor_of_strips(double half, int n) {
  TriangleSurface t;
  for (int i = 0; i < n; ++i) {
    const double low = half * (2.0 * i / n - 1), high = half * (2.0 * (i + 1) / n - 1);
    const int parts = 2 + i % 2;  // borders of neighbours are divided differently
    for (int j = 0; j < parts; ++j) {
      const double a = half * (2.0 * j / parts - 1), b = half * (2.0 * (j + 1) / parts - 1);
      const int v = static_cast<int>(t.vertex.size());
      for (const Vec3& x : {Vec3{low, a, 0}, Vec3{high, a, 0}, Vec3{high, b, 0}, Vec3{low, b, 0}})
        t.vertex.push_back(x);
      t.triangle.push_back({v, v + 1, v + 2}), t.triangle.push_back({v, v + 2, v + 3});
    }
  }
  return t;
}

// First it bounces and slides, at the end it rolls without sliding: 5/7 of the speed, v = omega R.
SeedState run_across(const Surface& surface, double skin, int* n_facets = nullptr) {
  Dem dem = one_sphere(surface, 2e-6, 0.5, skin);
  dem.add_seed(0, {-17e-3, -3e-3, radius}, {}, {0.2, 0.03, 0}, {});
  dem.advance(0.12);
  if (n_facets) *n_facets = std::get<Mesh>(surface).surface->n_facets();
  return dem.seed_state(0);
}

TEST(WallInheritance, FacetsOfAPlaneAreThePlane) {
  int n_facets = 0;
  const Mesh mesh(floor_of_strips(20e-3, 20), Mesh::Side::both, "floor");
  const SeedState plane = run_across(Plane{{}, {0, 0, 1}}, 0), strips = run_across(mesh, 0, &n_facets);
  ASSERT_GE(n_facets, 20);
  EXPECT_GT(plane.centre.x, -3e-3) << "has crossed many borders";
  // The same contacts up to round-off of the distances, 1e-18 m of an overlap of 1e-7 m.
  EXPECT_LT(norm(plane.centre - strips.centre), 1e-10);
  EXPECT_LT(norm(plane.velocity - strips.velocity), 1e-8);
  EXPECT_LT(norm(plane.spin - strips.spin), 1e-5);
}

// What is inherited does not depend on when the lists were made.
TEST(WallInheritance, SkinChangesNoBit) {
  const Mesh mesh(floor_of_strips(20e-3, 20), Mesh::Side::both, "floor");
  const SeedState a = run_across(mesh, 1e-3), b = run_across(mesh, 1e-6);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(a.centre[c], b.centre[c]);
    EXPECT_EQ(a.velocity[c], b.velocity[c]);
  }
}

// A sphere slides along y over a plate and meanwhile passes from the plate's face to the edge of a hole:
// friction is mu N in every substep. A spring that began anew would need 1e-7 m, five substeps.
TEST(WallInheritance, SlidingOverTheEdgeOfAHole) {
  Plate plate;
  plate.thickness = 1e-3;
  plate.outline = RectangleOutline{60e-3, 20e-3};
  HoleLattice one;
  one.pitch_along = one.pitch_across = 10e-3;
  one.n_along = one.n_across = 1;
  plate.holes = one;
  plate.hole_radius = 2.1e-3;
  const double step = 1e-6;
  Dem dem = one_sphere(plate, step, 1);
  // 1 um beyond the edge, 5e-8 m a substep towards it.
  dem.add_seed(0, {2.101e-3, 0, 0.5e-3 + radius - 1e-6}, {}, {-0.05, 0.02, 0}, {0, 0.05 / radius, 0});
  dem.advance(10 * step);
  int on_face = 0, on_edge = 0;
  for (int k = 0; k < 20; ++k) {
    const Vec3 before = dem.wall_impulses()[0];
    dem.advance(step);
    const Vec3 given = dem.wall_impulses()[0] - before;
    const Vec3 x = dem.seed_state(0).centre;
    (std::hypot(x.x, x.y) < plate.hole_radius ? on_edge : on_face) += 1;
    // The edge's normal leaves the vertical by 1e-6 m / 2 mm = 5e-4 at the end.
    EXPECT_NEAR(std::hypot(given.x, given.y) / std::abs(given.z), friction, 1e-3) << "substep " << k;
  }
  EXPECT_GT(on_face, 5);
  EXPECT_GT(on_edge, 5);
}

}  // namespace
}  // namespace seedflow
