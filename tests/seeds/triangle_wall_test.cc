// Walls of triangles: the same as the analytic surface, no bumps at seams, one contact for each feature.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "seedflow/base/error.h"
#include "seedflow/seeds/surface_mesh.h"
#include "seedflow/seeds/walls.h"

namespace seedflow {
namespace {

// A flat square of side 2a at z = 0 in n x n cells of two triangles, cut along alternating diagonals.
TriangleSurface square(double a, int n) {
  TriangleSurface s;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) s.vertex.push_back({a * (2.0 * i / n - 1), a * (2.0 * j / n - 1), 0});
  const auto at = [&](int i, int j) { return i + (n + 1) * j; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), t = at(i, j + 1);
      if ((i + j) % 2) {
        s.triangle.push_back({p, q, r}), s.triangle.push_back({p, r, t});
      } else {
        s.triangle.push_back({p, q, t}), s.triangle.push_back({q, r, t});
      }
    }
  return s;
}

TriangleSurface box(const Vec3& low, const Vec3& high) {
  TriangleSurface s;
  for (int c = 0; c < 8; ++c)
    s.vertex.push_back({c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z});
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
    s.triangle.push_back({a, b, c}), s.triangle.push_back({a, c, d});
  return s;
}

std::vector<WallPoint> points(const Mesh& mesh, const Vec3& x, double reach) {
  std::vector<WallPoint> out;
  mesh.points_near(x, reach, out);
  return out;
}

TEST(TriangleWall, SeamsOfAPlaneAreNoBumps) {
  const Mesh mesh(square(10e-3, 7), Mesh::Side::both, "square");
  EXPECT_EQ(mesh.surface->n_facets(), 1);
  const double height = 1.9e-3;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-9e-3, 9e-3);
  std::vector<Vec3> path;
  // Along edges, through corners, along diagonals, and anywhere.
  for (int i = 0; i <= 4000; ++i) {
    const double a = 9e-3 * (i / 2000.0 - 1);
    path.push_back({a, 0, height});
    path.push_back({a, 10e-3 / 7, height});
    path.push_back({a, a, height});
    path.push_back({u(random), u(random), -height});
  }
  for (int i = 0; i <= 7; ++i)
    for (int j = 1; j < 7; ++j)
      path.push_back(
          {10e-3 * (2.0 * std::max(1, std::min(i, 6)) / 7 - 1), 10e-3 * (2.0 * j / 7 - 1), height});
  for (const Vec3& x : path) {
    const auto found = points(mesh, x, 2e-3);
    ASSERT_EQ(found.size(), 1u) << x.x << " " << x.y;
    // Hertz force goes with overlap^1.5: 1e-10 of an overlap of 1e-4 m is 1e-14 m.
    EXPECT_NEAR(found[0].distance, height, 1e-14);
    EXPECT_NEAR(found[0].normal.z, x.z > 0 ? 1 : -1, 1e-13);
    EXPECT_EQ(found[0].feature, 0);
  }
}

TEST(TriangleWall, SeamsWhoseCornersDoNotMatch) {
  // Two triangles on the left, four on the right whose corners lie between those of the left.
  TriangleSurface s;
  s.vertex = {{-1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-1, 1, 0}, {0, -0.3, 0}, {0, 0.4, 0}, {1, 0, 0}};
  s.triangle = {{0, 1, 2}, {0, 2, 3}, {1, 6, 4}, {4, 6, 5}, {5, 6, 2}};
  const Mesh mesh(s, Mesh::Side::both, "seam");
  for (int i = -400; i <= 400; ++i)
    for (const double y : {-0.3, 0.0, 0.1, 0.4}) {
      const auto found = points(mesh, {i * 1e-3, y, 0.9}, 1.0);
      ASSERT_EQ(found.size(), 1u) << i << " " << y;
      EXPECT_NEAR(found[0].distance, 0.9, 1e-12);
    }
}

TEST(TriangleWall, ConvexEdgesAndCornersAreTouchedOnce) {
  const Vec3 low{-10e-3, -8e-3, -5e-3}, high{10e-3, 8e-3, 5e-3};
  for (const auto side : {Mesh::Side::both, Mesh::Side::outside}) {
    const Mesh mesh(box(low, high), side, "box");
    EXPECT_EQ(mesh.surface->n_facets(), 6);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> u(-14e-3, 14e-3);
    std::set<int> features;
    int outside = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3 x{u(random), u(random), u(random)};
      Vec3 nearest;
      for (int d = 0; d < 3; ++d) nearest[d] = std::clamp(x[d], low[d], high[d]);
      const double distance = norm(x - nearest);
      if (distance == 0 || distance > 3e-3) continue;
      ++outside;
      const auto found = points(mesh, x, 3e-3);
      ASSERT_EQ(found.size(), 1u);
      EXPECT_NEAR(found[0].distance, distance, 1e-15);
      EXPECT_NEAR(norm(found[0].normal - (x - nearest) / distance), 0, 1e-11);
      features.insert(found[0].feature);
    }
    EXPECT_GT(outside, 500);
    EXPECT_EQ(features.size(), 6u + 12u + 8u);
  }
}

TEST(TriangleWall, SlidingOverAnEdgeOfABoxIsSmooth) {
  const Mesh mesh(box({-10e-3, -10e-3, -10e-3}, {10e-3, 10e-3, 10e-3}), Mesh::Side::outside, "box");
  const double height = 1.95e-3;
  Vec3 last{0, 0, 1};
  for (int i = 0; i <= 6000; ++i) {
    // From the top over the edge to the side, the contact always at the same distance.
    const double way = i * 1e-6, arc = 0.5 * M_PI * height;
    const double flat = 1e-3, turn = std::clamp((way - flat) / height, 0.0, 0.5 * M_PI);
    Vec3 x{10e-3 + height * std::sin(turn), 0.31e-3, 10e-3 + height * std::cos(turn)};
    if (way < flat) x.x -= flat - way;
    if (way > flat + arc) x.z -= way - flat - arc;
    const auto found = points(mesh, x, 2e-3);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].distance, height, 1e-14);
    EXPECT_LT(norm(found[0].normal - last), 1.1e-6 / height);
    last = found[0].normal;
  }
  EXPECT_NEAR(last.x, 1, 1e-12);
}

TEST(TriangleWall, ConcaveEdgeGivesOneContactWithEachFace) {
  const Mesh mesh(box({-10e-3, -10e-3, -10e-3}, {10e-3, 10e-3, 10e-3}), Mesh::Side::inside, "room");
  EXPECT_EQ(points(mesh, {0, 0, -8.1e-3}, 2e-3).size(), 1u);
  EXPECT_EQ(points(mesh, {0, 8.5e-3, -8.1e-3}, 2e-3).size(), 2u);
  const auto corner = points(mesh, {8.2e-3, 8.5e-3, -8.1e-3}, 2e-3);
  ASSERT_EQ(corner.size(), 3u);
  for (const WallPoint& p : corner) EXPECT_GT(p.distance, 1.4e-3);
  // A centre beyond the wall is pushed back in.
  const auto behind = points(mesh, {10.1e-3, 0, 0}, 2e-3);
  ASSERT_EQ(behind.size(), 1u);
  EXPECT_NEAR(behind[0].distance, -0.1e-3, 1e-15);
  EXPECT_NEAR(behind[0].normal.x, -1, 1e-12);
}

TEST(TriangleWall, ThinSolidPushesToTheSideOfTheCentre) {
  const Mesh mesh(box({-10e-3, -10e-3, -0.1e-3}, {10e-3, 10e-3, 0.1e-3}), Mesh::Side::outside, "sheet");
  for (const double z : {0.12e-3, 1e-3, -0.12e-3, -1e-3}) {
    const auto found = points(mesh, {1e-3, 2e-3, z}, 2e-3);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].distance, std::abs(z) - 0.1e-3, 1e-15);
    EXPECT_NEAR(found[0].normal.z, z > 0 ? 1 : -1, 1e-12);
  }
}

TEST(TriangleWall, ManyTrianglesLikeTheCylinderTheyApproximate) {
  // 720 x 2 triangles of a drum; the sagitta of a facet is R (1 - cos(pi / 720)).
  const double radius = 50e-3;
  const int n = 720;
  TriangleSurface s;
  for (int i = 0; i < n; ++i)
    for (const double z : {-20e-3, 20e-3})
      s.vertex.push_back({radius * std::cos(2 * M_PI * i / n), radius * std::sin(2 * M_PI * i / n), z});
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = 2 * ((i + 1) % n);
    s.triangle.push_back({a, b, b + 1}), s.triangle.push_back({a, b + 1, a + 1});
  }
  const Mesh mesh(s, Mesh::Side::both, "drum");
  EXPECT_EQ(mesh.surface->n_facets(), n);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(-48.1e-3, 48.1e-3);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x{u(random), u(random), 0.3 * u(random)};
    const double gap = radius - std::hypot(x.x, x.y);
    if (gap < 0.5e-3 || gap > 3e-3) continue;
    double least = 1e300;
    for (const WallPoint& p : points(mesh, x, 4e-3)) least = std::min(least, p.distance);
    EXPECT_LE(least, gap + 1e-12);
    EXPECT_GE(least, gap - radius * (1 - std::cos(M_PI / n)) - 1e-12);
  }
}

TEST(TriangleWall, OpenSurfacesAreRefusedWhereAClosedOneIsNeeded) {
  TriangleSurface open = box({0, 0, 0}, {1, 1, 1});
  open.triangle.pop_back();
  EXPECT_NO_THROW(Mesh(open, Mesh::Side::both, "open"));
  try {
    Mesh(open, Mesh::Side::outside, "hopper");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("hopper"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("open"), std::string::npos);
  }
  EXPECT_THROW(read_wall_triangles("no_such_file.stl", 1e-3, {}), InputError);
}

TEST(TriangleWall, FileInMillimetresMovedIntoPlace) {
  const auto file =
      std::filesystem::temp_directory_path() / ("seedflow_wall_" + std::to_string(getpid()) + ".stl");
  std::ofstream(file) << "solid open\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\n"
                         "vertex 0 10 0\nendloop\nendfacet\nendsolid open\n";
  const Mesh mesh(read_wall_triangles(file.string(), 1e-3, {0, 0, 5e-3}), Mesh::Side::both, "file");
  std::filesystem::remove(file);
  const auto found = points(mesh, {2e-3, 2e-3, 6e-3}, 2e-3);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].distance, 1e-3, 1e-15);
}

}  // namespace
}  // namespace seedflow
