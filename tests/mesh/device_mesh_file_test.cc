// The air of somebody's own device: what is written is read again, and what cannot be used is named.
#include <deal.II/grid/grid_tools.h>
#include <gtest/gtest.h>
#ifdef DEAL_II_GMSH_WITH_API
#include <gmsh.h>
#endif

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "places.h"
#include "seedflow/base/error.h"
#include "seedflow/mesh/device_mesh.h"
#include "seedflow/mesh/gmsh_file.h"

namespace seedflow {
namespace {

DeviceGeometry three_holes() {
  DeviceGeometry g;
  g.drilled = 3;
  return g;
}

DeviceMeshParameters coarse_sizes() {
  DeviceMeshParameters p;
  p.hole_sides = 2;
  p.hole_rings = 1;
  p.hole_layers = 2;
  p.mouth_rings = 2;
  p.vacuum_cell = 4e-3;
  p.face_cell = 0.6e-3;
  p.largest_cell = 15e-3;
  p.growth = 2;
  return p;
}

std::string text_of(const DeviceMesh& mesh, double unit = 1e-3) {
  std::ostringstream out;
  write_device_mesh(mesh, unit, out);
  return out.str();
}

/// Each process has a file of its own, because suites run side by side, and takes it away at its end.
struct MeshFile {
  const std::string name = testing::TempDir() + "device_" + std::to_string(getpid()) + ".msh";
  ~MeshFile() { std::remove(name.c_str()); }
};

DeviceMeshParameters from_file(const std::string& text) {
  static const MeshFile file;
  DeviceMeshParameters p;
  p.file = file.name;
  std::ofstream(p.file) << text;
  return p;
}

std::string message_for(const DeviceGeometry& g, const DeviceMeshParameters& p) {
  try {
    check_device_mesh(g, p, MPI_COMM_SELF);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\n does not contain\n" << part;
}

TEST(DeviceMeshFile, WhatIsWrittenIsReadAgain) {
  const DeviceGeometry g = three_holes();
  const DeviceMesh made(g, coarse_sizes());
  const DeviceMesh read(g, from_file(text_of(made)));
  ASSERT_EQ(read.coarse.n_active_cells(), made.coarse.n_active_cells());
  auto other = made.coarse.begin_active();
  for (const auto& cell : read.coarse.active_cell_iterators()) {
    ASSERT_LT(cell->center().distance(other->center()), 1e-15);
    EXPECT_EQ(cell->material_id(), other->material_id());
    ++other;
  }
  std::map<int, double> area[2];
  int n = 0;
  for (const DeviceMesh* mesh : {&made, &read}) {
    for (const auto& cell : mesh->coarse.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary()) area[n][cell->face(f)->boundary_id()] += cell->face(f)->measure();
    ++n;
  }
  ASSERT_EQ(area[0].size(), area[1].size());
  for (const auto& [id, value] : area[0]) EXPECT_NEAR(area[1][id], value, 1e-12 * value) << id;
  EXPECT_NEAR(made.face_cell(), read.face_cell(), 1e-15);
}

TEST(DeviceMeshFileMpi, IsADomainWithARotor) {
  const DeviceGeometry g = three_holes();
  const DeviceMesh made(g, coarse_sizes());
  Domain<3> a = device_domain(g, coarse_sizes(), MPI_COMM_WORLD),
            b = device_domain(g, from_file(text_of(made)), MPI_COMM_WORLD);
  EXPECT_NEAR(a.volume(), b.volume(), 1e-12 * a.volume());
  EXPECT_EQ(a.triangulation().n_locally_owned_active_cells(),
            b.triangulation().n_locally_owned_active_cells());
  ASSERT_NE(b.rotor(), nullptr);
  a.turn_to(0.3), b.turn_to(0.3);
  EXPECT_NEAR(a.volume(), b.volume(), 1e-12 * a.volume());
}

TEST(DeviceMeshFile, NamesAreThoseOfTheDevice) {
  const DeviceGeometry g = three_holes();
  const std::string good = text_of(DeviceMesh(g, coarse_sizes()));
  EXPECT_EQ(message_for(g, from_file(good)), "accepted");
  const auto without = [&](const std::string& name, const std::string& by) {
    return message_for(g, from_file(replaced(good, "\"" + name + "\"", "\"" + by + "\"")));
  };
  std::string message = without("suction", "suktion");
  expect_part(message, "physical surface \"suktion\"");
  expect_part(message, "suction");
  expect_part(without("turning", "rotor"), "physical volume \"rotor\"");
  message = without("suction", "vacuum wall");
  expect_part(message, "has no physical surface \"suction\"");
  expect_part(message, "found: \"ambient\"");
  expect_part(without("turning", "standing"), "has no physical volume \"turning\"");
  expect_part(without("housing", "vacuum wall"), "belongs to the standing one");
  EXPECT_EQ(without("vacuum wall", "suction"), "accepted") << "optional";
  // One face of the boundary is not listed.
  std::string text = good;
  const auto line = text.find("\n", text.find("$Elements\n") + 10) + 1;
  text.erase(line, text.find("\n", line) + 1 - line);
  const auto count = text.find("$Elements\n") + 10;
  const long n = std::stol(text.substr(count));
  text.replace(count, std::to_string(n).size(), std::to_string(n - 1));
  expect_part(message_for(g, from_file(text)), "1 faces of its boundary in no physical surface");
}

TEST(DeviceMeshFile, MeshAndEntriesMustAgree) {
  const DeviceGeometry g = three_holes();
  const std::string text = text_of(DeviceMesh(g, coarse_sizes()));
  DeviceMeshParameters file = from_file(text);
  file.unit = 1;
  expect_part(message_for(g, file), "at z = 2000 mm");
  file.unit = 1e-3;
  DeviceGeometry other = g;
  other.thickness = 2.5e-3;
  expect_part(message_for(other, file), "at z = 2 mm, which Device/Disc thickness puts at 2.5 mm");
  other = g, other.hole_diameter = 2.4e-3;
  expect_part(message_for(other, file), "mm2 at hole 0");
  other = g, other.pitch_radius = 87e-3;
  expect_part(message_for(other, file), "put no hole; the nearest is hole 0");
  other = g, other.drilled = 4;
  expect_part(message_for(other, file), "0.000000 mm2 at hole 3");
  other = g, other.vacuum_to -= 0.2;
  expect_part(message_for(other, file), "outside the arc of Device/Vacuum from");
  other = g, other.vacuum_from -= 0.2;
  expect_part(message_for(other, file), "interface and arc do not match");
  // A vacuum chamber beside the holes: radii that do not match.
  other = g, other.vacuum_inner_radius = 90e-3 - 0.5e-3;
  expect_part(message_for(g, from_file(text_of(DeviceMesh(other, coarse_sizes())))),
              "interface and arc do not match");
  // A thinner disc whose back is where it should be.
  other = g, other.thickness = 1.8e-3;
  DeviceMesh moved(other, coarse_sizes());
  dealii::GridTools::shift(dealii::Point<3>(0, 0, 0.2e-3), moved.coarse);
  expect_part(message_for(g, from_file(text_of(moved))), "the nearest is at z = 0.2 mm");
  // A chamber that is no body of revolution: r (1 + 0.6 sin(3 theta)) at its open front.
  DeviceMesh bulged(g, coarse_sizes());
  dealii::GridTools::transform(
      [&](const dealii::Point<3>& x) {
        const double wider =
            1 + 0.6 * std::sin(3 * std::atan2(x[1], x[0])) * std::max(0.0, -x[2] / g.chamber_depth);
        return dealii::Point<3>(wider * x[0], wider * x[1], x[2]);
      },
      bulged.coarse);
  expect_part(message_for(g, from_file(text_of(bulged))), "must be a body of revolution");
}

#ifdef DEAL_II_GMSH_WITH_API
// The example for users, with two of its holes, as Gmsh meshes and writes it (format 4).
TEST(DeviceMeshFile, ExampleOfTheDocumentationIsAccepted) {
  std::ifstream in(std::string(places::source_dir) + "/doc/own_device.geo");
  std::stringstream example;
  example << in.rdbuf();
  const std::string geo = testing::TempDir() + "own_device.geo";
  std::ofstream(geo) << replaced(example.str(), "drilled = 12", "drilled = 2");
  DeviceMeshParameters p;
  p.file = testing::TempDir() + "own_device.msh";
  gmsh::initialize();
  gmsh::option::setNumber("General.Verbosity", 1);
  gmsh::open(geo);
  gmsh::model::mesh::generate(3);
  gmsh::write(p.file);
  gmsh::finalize();
  DeviceGeometry g;  // prm/metering_sector.prm
  g.drilled = 2;
  g.first_angle = -165 * M_PI / 180;
  g.chamber_outer_radius = 96e-3, g.chamber_depth = 10e-3;
  EXPECT_EQ(message_for(g, p), "accepted");
  const DeviceMesh mesh(g, p);
  EXPECT_GT(mesh.coarse.n_active_cells(), 5000u);
  EXPECT_NEAR(mesh.face_cell(), 0.3e-3, 1e-9);
  g.first_angle += 0.5 * g.pitch_angle();
  expect_part(message_for(g, p), "put no hole");
}
#endif

TEST(DeviceMeshFile, OtherCellsAreRefused) {
  const std::string tetrahedron = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "disc"
3 2 "turning"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
$EndNodes
$Elements
1
1 4 2 2 1 1 2 3 4
$EndElements
)";
  expect_part(message_for(three_holes(), from_file(tetrahedron)), "is not a mesh of hexahedra");
  expect_part(message_for(three_holes(), from_file(replaced(tetrahedron, "2.2 0 8", "2.2 1 8"))),
              "is binary. Write it as ASCII");
}

}  // namespace
}  // namespace seedflow
