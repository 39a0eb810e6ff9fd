#include "seedflow/seeds/stl.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>

#include "seedflow/base/error.h"
#include "seedflow/seeds/packing_random.h"
#include "seedflow/seeds/stl_distance.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

/// The box [low, high], outward corners.
TriangleSurface box(const Vec3& low, const Vec3& high) {
  TriangleSurface s;
  for (int k = 0; k < 8; ++k)
    s.vertex.push_back({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
  s.triangle = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return s;
}

/// The unit sphere as an octahedron whose triangles are split in four `levels` times.
TriangleSurface ball(int levels) {
  TriangleSurface s;
  s.vertex = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  s.triangle = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto split = [&](int a, int b) {
      const auto [at, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<int>(s.vertex.size()));
      if (fresh) {
        const Vec3 m = s.vertex[a] + s.vertex[b];
        s.vertex.push_back(m / norm(m));
      }
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : s.triangle) {
      const int ab = split(a, b), bc = split(b, c), ca = split(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    s.triangle = finer;
  }
  return s;
}

class File {
 public:
  explicit File(const std::string& content) { std::ofstream(name, std::ios::binary) << content; }
  ~File() { std::remove(name.c_str()); }
  const std::string name = testing::TempDir() + "seedflow_stl_" + std::to_string(::getpid()) + ".stl";
};

std::string ascii(const TriangleSurface& s) {
  std::string text = "solid a seed\n";
  char line[200];
  for (const auto& t : s.triangle) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int v : t) {
      std::snprintf(line, sizeof line, "   vertex %.17g %.17g %+.17e\n", s.vertex[v].x, s.vertex[v].y,
                    s.vertex[v].z);
      text += line;
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid a seed\n";
}

std::string binary(const TriangleSurface& s) {
  std::string data = "solid written by a program that begins its binary files so";
  data.resize(80, ' ');
  const auto n = static_cast<std::uint32_t>(s.triangle.size());
  data.append(reinterpret_cast<const char*>(&n), 4);
  for (const auto& t : s.triangle) {
    float f[12] = {0, 0, 0};
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d) f[3 + 3 * c + d] = static_cast<float>(s.vertex[t[c]][d]);
    data.append(reinterpret_cast<const char*>(f), 48).append(2, '\0');
  }
  return data;
}

TEST(Stl, BoxIsExactInBothFormats) {
  const TriangleSurface s = box({1, 2, 3}, {3, 6, 4});
  for (const std::string& content : {ascii(s), binary(s)}) {
    const File file(content);
    const TriangleSurface read = read_stl(file.name);
    EXPECT_EQ(read.vertex.size(), 8u);
    EXPECT_EQ(read.triangle.size(), 12u);
    const SurfaceMoments m = moments(read);
    EXPECT_NEAR(m.volume, 2 * 4 * 1, 1e-13);
    EXPECT_NEAR(norm(m.centroid - Vec3{2, 4, 3.5}), 0, 1e-14);
    EXPECT_NEAR(norm(m.square - Vec3{4.0 / 12, 16.0 / 12, 1.0 / 12}), 0, 1e-13);
    EXPECT_NEAR(norm(m.mixed), 0, 1e-13);
  }
}

// Corners of the inscribed polyhedron: its volume and moments approach the ball's from below with the square
// of the edge; halving it must divide the error by four.
TEST(Stl, BallConvergesWithTheSquareOfTheEdge) {
  double last_volume = 0, last_moment = 0;
  for (int levels = 2; levels <= 5; ++levels) {
    const SurfaceMoments m = moments(ball(levels));
    const double volume_error = 4 * M_PI / 3 - m.volume, moment_error = 0.2 - m.square.x;
    EXPECT_GT(volume_error, 0);
    if (levels > 3) {
      EXPECT_NEAR(last_volume / volume_error, 4, 0.1);
      EXPECT_NEAR(last_moment / moment_error, 4, 0.1);
    }
    last_volume = volume_error, last_moment = moment_error;
  }
}

TEST(Stl, DistanceToABoxIsExact) {
  const Vec3 low{-1, -2, -0.5}, high{1, 2, 0.5};
  const SurfaceDistance distance(box(low, high));
  PortableRandom random(11);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 x = random.in_box(2 * low, 2 * high);
    Vec3 out, n;
    double inside = -1e300;
    for (int d = 0; d < 3; ++d) {
      const double beyond = std::abs(x[d]) - high[d];
      out[d] = std::max(beyond, 0.0);
      inside = std::max(inside, beyond);
    }
    const double exact = inside < 0 ? inside : norm(out);
    EXPECT_NEAR(distance(x, n), exact, 1e-14);
    EXPECT_NEAR(norm(n), 1, 1e-13);
    // Moving against the direction by the distance ends on the surface.
    Vec3 unused;
    EXPECT_NEAR(distance(x - exact * n, unused), 0, 1e-13);
  }
  Vec3 n;
  EXPECT_NEAR(distance({1, 2, 0.5}, n), 0, 1e-15);
  EXPECT_NEAR(norm(n), 1, 1e-13);
  EXPECT_LT(distance({0.999, 1.999, 0.499}, n), 0) << "beside a corner the pseudonormal decides";
  EXPECT_GT(distance({1.001, 2.001, 0.501}, n), 0);
}

TEST(Stl, InsideOutIsTurned) {
  TriangleSurface s = box({0, 0, 0}, {1, 1, 1});
  for (auto& t : s.triangle) std::swap(t[0], t[1]);
  EXPECT_NEAR(moments(s).volume, -1, 1e-14);
  const File file(ascii(s));
  EXPECT_NEAR(moments(read_stl(file.name)).volume, 1, 1e-14);
}

void expect_rejected(const std::string& content, const std::string& reason, const std::string& remedy) {
  SCOPED_TRACE(reason);
  const File file(content);
  try {
    read_stl(file.name);
    ADD_FAILURE() << "accepted; expected: " << reason;
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(file.name), std::string::npos) << message;
    EXPECT_NE(message.find(reason), std::string::npos) << message;
    EXPECT_NE(message.find(remedy), std::string::npos) << message;
  }
}

TEST(Stl, BadSurfacesAreRejectedWithReasonAndRemedy) {
  const TriangleSurface good = box({0, 0, 0}, {1, 1, 1});
  TriangleSurface bad = good;
  bad.triangle.pop_back();
  expect_rejected(ascii(bad), "3 edges belong to one triangle only, so the surface is open",
                  "close the holes");
  bad = good;
  std::swap(bad.triangle[3][0], bad.triangle[3][1]);
  expect_rejected(binary(bad), "opposite orientation", "unify the normals");
  bad = good;
  bad.triangle.push_back(bad.triangle[0]);
  expect_rejected(ascii(bad), "more than two triangles", "remove doubled");
  bad = good;
  bad.vertex.push_back({0, 0, 0.5});
  bad.triangle.push_back({0, 4, 8});
  expect_rejected(ascii(bad), "no area", "degenerate");
  bad = good;
  const TriangleSurface other = box({2, 0, 0}, {3, 1, 1});
  for (const Vec3& x : other.vertex) bad.vertex.push_back(x);
  for (auto t : other.triangle) bad.triangle.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  expect_rejected(ascii(bad), "more than one piece", "one body");
  bad = good;
  bad.vertex[3].y = std::nan("");
  expect_rejected(binary(bad), "triangle 1 (from 0): a coordinate is not a finite number", "export");
  expect_rejected(ascii(bad), "line 13: 'nan' is not a finite coordinate", "export");

  std::string text = ascii(good);
  text.replace(text.find("outer"), 5, "inner");
  expect_rejected(text, "line 3: 'inner' stands where 'outer' is expected", "export");
  text = ascii(good);
  expect_rejected(text.substr(0, text.rfind("endloop")), "the file ends where 'endloop' is expected",
                  "export");
  expect_rejected(text.substr(0, text.rfind(" endfacet")), "the file ends where 'endfacet' is expected",
                  "export");
  expect_rejected(binary(good).substr(0, 500), "12 triangles announced", "cut off");  // begins with "solid"
  text = binary(good);
  text[0] = 'S';
  expect_rejected(text.substr(0, 500), "12 triangles announced", "cut off");
  expect_rejected("solid\nendsolid\n", "no triangles", "export");
  expect_rejected("hello", "no complete STL surface", "export");
  EXPECT_THROW(read_stl("there is no such file.stl"), InputError);
}

TEST(Stl, ShapeOfABoxIsScaledAndTurnedIntoItsAxes) {
  const Shape shape = surface_shape(box({1, 2, 3}, {3, 6, 4}), 4e-3);  // edges 2 x 4 x 1
  EXPECT_NEAR(shape.volume, M_PI / 6 * 64e-9, 1e-22);
  const double scale = std::cbrt(shape.volume / 8);
  EXPECT_NEAR(shape.high.x - shape.low.x, 4 * scale, 1e-15);
  EXPECT_NEAR(shape.high.z - shape.low.z, scale, 1e-15);
  EXPECT_NEAR(shape.inscribed_radius, 0.5 * scale, 1e-12);
  const Vec3 inertia = shape.inertia(12);  // m/12 (b^2 + c^2)
  EXPECT_NEAR(inertia.x / (scale * scale), 4 + 1, 1e-12);
  EXPECT_NEAR(inertia.z / (scale * scale), 16 + 4, 1e-12);
  EXPECT_NEAR(shape.support({1, 0, 0}), 2 * scale, 1e-15);
  EXPECT_NEAR(shape.semi_axes.x * shape.semi_axes.y * shape.semi_axes.z / 8e-9, 1, 1e-13);
  EXPECT_NEAR(shape.semi_axes.x / shape.semi_axes.z, 4, 1e-12);
}

TEST(Stl, SubSpheresFillASurfaceThatIsNotConvex) {
  // A box with its top pressed in to a point: inside, the hull has a reflex region.
  TriangleSurface s = box({-2, -1, -1}, {2, 1, 1});
  const int tip = static_cast<int>(s.vertex.size());
  s.vertex.push_back({0, 0, -0.2});
  s.triangle.erase(s.triangle.begin() + 2, s.triangle.begin() + 4);
  s.triangle.insert(s.triangle.end(), {{4, 5, tip}, {5, 7, tip}, {7, 6, tip}, {6, 4, tip}});
  const File file(ascii(s));
  SeedTemplateParameters p;
  p.shape = "stl";
  p.file = file.name;
  p.n_spheres = 80;
  p.sphere_radius = 0.25e-3;
  p.contact_factor = 2.2;
  const SeedTemplate seed = make_seed_template(p);
  const Shape shape = make_shape(p);
  for (const Vec3& x : seed.position) {
    Vec3 outward;
    const Vec3 in_shape = rotate_back(seed.seed_frame, x - seed.seed_centre);
    EXPECT_LE(shape.signed_distance(in_shape, outward), -0.25e-3 * (1 - 1e-9));
  }
  EXPECT_NEAR(seed.mass / (1340 * M_PI / 6 * 64e-9), 1, 1e-13);
}

// A finely triangulated ball must give a packing as good as the sphere itself does (overlap of N = 70 below 3
// %; the polyhedron of 2048 triangles is up to 1 % smaller in places), within the time allowed.
TEST(Stl, BallFillsLikeASphere) {
  const File file(binary(ball(4)));
  SeedTemplateParameters p;
  p.shape = "stl";
  p.file = file.name;
  const std::clock_t start = std::clock();
  const SeedTemplate seed = make_seed_template(p);
  std::printf("N = 70 in 2048 triangles: %.2f s, %zu bonds\n", double(std::clock() - start) / CLOCKS_PER_SEC,
              seed.bond.size());
  for (int i = 0; i < seed.n_spheres(); ++i)
    for (int j = 0; j < i; ++j) EXPECT_GT(norm(seed.position[i] - seed.position[j]), 0.97 * 0.8e-3);
}

}  // namespace
}  // namespace seedflow
