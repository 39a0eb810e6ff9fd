// Somebody's own disc is held against the entries of the device.
#include "seedflow/seeds/device_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/seeds/stl_writer.h"

namespace seedflow {
namespace {

/// Four holes on a circle of 10 mm.
DeviceGeometry four_holes() {
  DeviceGeometry g;
  g.holes = 4;
  g.pitch_radius = 10e-3;
  g.disc_radius = 15e-3;
  g.chamber_inner_radius = 5e-3, g.chamber_outer_radius = 14e-3;
  return g;
}

/// A square plate of nine tiles, those in the middle of its sides with a hole of 16 sides and a chamfer.
/// `closed`: the hole that is not there.
TriangleSurface plate(const DeviceGeometry& g, double shift = 0, int closed = -1) {
  TriangleSurface s;
  const auto triangle = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const int first = static_cast<int>(s.vertex.size());
    s.vertex.insert(s.vertex.end(), {a, b, c});
    s.triangle.push_back({first, first + 1, first + 2});
  };
  const auto band = [&](const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const std::size_t n = (i + 1) % a.size();
      triangle(a[i], a[n], b[i]);
      triangle(b[i], a[n], b[n]);
    }
  };
  const double p = g.pitch_radius, r = g.hole_radius(), t = g.thickness;
  const int tile[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      int hole = -1;
      for (int k = 0; k < 4; ++k)
        if (tile[k][0] == i && tile[k][1] == j && k != closed) hole = k;
      const auto ring = [&](double radius, double z, bool square) {
        std::vector<Vec3> points;
        for (int n = 0; n < 16; ++n) {
          const double a = n * M_PI / 8, c = std::cos(a), b = std::sin(a);
          const double scale = square ? 0.5 * p / std::max(std::abs(c), std::abs(b)) : radius;
          points.push_back({i * p + scale * c, j * p + scale * b, z + shift});
        }
        return points;
      };
      const double mouth = hole < 0 ? 1e-9 : r + g.chamfer, bore = hole < 0 ? 1e-9 : r;
      band(ring(0, 0, true), ring(mouth, 0, false));
      band(ring(0, t, true), ring(bore, t, false));
      if (hole < 0) {  // its lids
        for (const double z : {0.0, t}) {
          const auto rim = ring(2e-9, z, false);
          for (int n = 1; n < 15; ++n) triangle(rim[0], rim[n], rim[n + 1]);
        }
        continue;
      }
      band(ring(mouth, 0, false), ring(bore, g.chamfer, false));
      band(ring(bore, g.chamfer, false), ring(bore, t, false));
    }
  return s;
}

std::string message_for(const TriangleSurface& surface, const DeviceGeometry& g) {
  try {
    check_disc(surface, g, "disc.stl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\n does not contain\n" << part;
}

TEST(DeviceSurfaces, ADiscWithTheDeclaredHolesIsAccepted) {
  DeviceGeometry g = four_holes();
  EXPECT_EQ(message_for(plate(g), g), "accepted");
  g.first_angle = M_PI / 2;  // the same holes
  EXPECT_EQ(message_for(plate(g), g), "accepted");
  g = four_holes(), g.drilled = 3;
  EXPECT_EQ(message_for(plate(g, 0, 3), g), "accepted");
}

TEST(DeviceSurfaces, HolesAreWhereTheyAreDeclared) {
  const DeviceGeometry g = four_holes();
  std::string message = message_for(plate(g, 0, 2), g);
  expect_part(message, "is not open at hole 2 (at x = -10 mm");
  expect_part(message, "lies across its axis");
  DeviceGeometry other = g;
  other.hole_diameter = 2.4e-3;  // the inner radius of 16 sides: cos(pi/16) = 0.981
  expect_part(message_for(plate(g), other), "comes within 0.9808 mm of the hole's axis");
  other.hole_diameter = 1.6e-3;
  expect_part(message_for(plate(g), other), "the nearest triangle is 0.9808 mm from its axis");
  other = g, other.first_angle = 0.3;
  expect_part(message_for(plate(g), other), "is not open at hole 0");
  other = g, other.drilled = 3;
  expect_part(message_for(plate(g), other), "has no solid on the circle of the holes at");
  TriangleSurface metres = plate(g);
  for (Vec3& x : metres.vertex) x = 1e3 * x;
  expect_part(message_for(metres, g), "Device/Surface unit");
}

TEST(DeviceSurfaces, TheFrontIsInItsPlane) {
  const DeviceGeometry g = four_holes();
  expect_part(message_for(plate(g, 0.5e-3), g), "and are at 0.5 mm and 2.5 mm");
  EXPECT_EQ(message_for(plate(g, 0.05e-3), g), "accepted");  // within 5 % of 2 mm
}

TEST(DeviceSurfaces, TheChamferIsInFront) {
  DeviceGeometry g = four_holes();
  TriangleSurface turned = plate(g);
  for (Vec3& x : turned.vertex) x.z = g.thickness - x.z;
  expect_part(message_for(turned, g),
              "1.15 mm from its axis the front should be at z = 0.15 mm and is at 0 mm");
  DeviceGeometry sharp = g;
  sharp.chamfer = 0;
  EXPECT_EQ(message_for(plate(sharp), sharp), "accepted");
  expect_part(message_for(plate(sharp), g), "has no edge as Device/Chamfer says at hole 0");
  expect_part(message_for(plate(g), sharp), "has no edge as Device/Chamfer says at hole 0");
}

TEST(DeviceSurfaces, WhatStandsLeavesTheDiscFree) {
  const DeviceGeometry g = four_holes();
  const auto strip = [&](double from, double to, double low, double high) {
    TriangleSurface s;
    s.vertex = {{from, 0, low}, {to, 0, low}, {to, 0, high}};
    s.triangle = {{0, 1, 2}};
    return s;
  };
  EXPECT_NO_THROW(check_standing(strip(6e-3, 14e-3, -5e-3, -0.5e-3), g, "blade"));
  EXPECT_NO_THROW(check_standing(strip(-4e-3, 4e-3, -5e-3, 5e-3), g, "shaft"));
  EXPECT_NO_THROW(check_standing(strip(16e-3, 18e-3, -5e-3, 5e-3), g, "rim"));
  EXPECT_NO_THROW(check_standing(strip(6e-3, 14e-3, 2e-3, 3e-3), g, "seal"));
  EXPECT_THROW(check_standing(strip(6e-3, 14e-3, -5e-3, 0.5e-3), g, "blade"), InputError);
  EXPECT_THROW(check_standing(strip(-40e-3, 40e-3, -5e-3, 5e-3), g, "no corner in the disc"), InputError);
}

TEST(DeviceSurfaces, WrittenSurfaceIsReadAgain) {
  TriangleSurface s;
  s.vertex = {{0, 0, 0}, {15e-3, 1e-3 / 3, 0}, {0, 15e-3, 0}, {1e-3, 2e-3, -15e-3 / 7}};
  s.triangle = {{0, 1, 2}, {0, 3, 1}, {2, 3, 0}};
  std::ostringstream text;
  write_stl(s, 1e-3, text);
  const std::string bytes = text.str();
  ASSERT_EQ(bytes.size(), 84 + 50 * s.triangle.size());
  const std::string file = testing::TempDir() + "plate.stl";
  std::ofstream(file, std::ios::binary) << bytes;
  const TriangleSurface read = read_triangles(file);
  EXPECT_EQ(read.vertex.size(), 4u) << "equal corners are one";
  ASSERT_EQ(read.triangle.size(), s.triangle.size());
  for (std::size_t i = 0; i < s.triangle.size(); ++i)
    for (int c = 0; c < 3; ++c)  // single precision of 15 mm
      EXPECT_LT(norm(1e-3 * read.vertex[read.triangle[i][c]] - s.vertex[s.triangle[i][c]]), 2e-9);
}

}  // namespace
}  // namespace seedflow
