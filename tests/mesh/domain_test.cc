#include "seedflow/mesh/domain.h"

#include <gtest/gtest.h>

#include <fstream>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

/// Two hexahedra on top of each other, 1 x 1 x 2 with a bulge: the nodes of the middle plane are moved out by
/// a quarter in x at x = 1. Sides: floor, lid, shell.
const char* const two_cells = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
2 7 "floor"
2 8 "lid"
2 9 "shell"
3 1 "air"
$EndPhysicalNames
$Nodes
12
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1.25 0 1
7 1.25 1 1
8 0 1 1
9 0 0 2
10 1 0 2
11 1 1 2
12 0 1 2
$EndNodes
$Elements
12
1 3 2 7 1 1 2 3 4
2 3 2 8 2 9 10 11 12
3 3 2 9 3 1 2 6 5
4 3 2 9 3 2 3 7 6
5 3 2 9 3 3 4 8 7
6 3 2 9 3 4 1 5 8
7 3 2 9 3 5 6 10 9
8 3 2 9 3 6 7 11 10
9 3 2 9 3 7 8 12 11
10 3 2 9 3 8 5 9 12
11 5 2 1 1 1 2 3 4 5 6 7 8
12 5 2 1 1 5 6 7 8 9 10 11 12
$EndElements
)";

std::string written(const std::string& name, const std::string& text) {
  const std::string file = testing::TempDir() + name;
  std::ofstream(file) << text;
  return file;
}

std::string message_for(const std::string& file) {
  DomainParameters p;
  p.mesh_file = file;
  try {
    Domain<3> domain(p, MPI_COMM_SELF);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Domain, GmshMesh) {
  DomainParameters p;
  p.mesh_file = written("two_cells.msh", two_cells);
  p.refinements = 1;
  Domain<3> domain(p, MPI_COMM_SELF);
  EXPECT_EQ(domain.triangulation().n_active_cells(), 16u);
  EXPECT_NEAR(domain.volume(), 2 * 1.125, 1e-12);  // two prisms, each 1 + 1/8
  std::map<std::string, double> area;
  for (const auto& cell : domain.triangulation().active_cell_iterators())
    for (const auto f : cell->face_indices())
      if (cell->at_boundary(f))
        area[domain.sides().at(cell->face(f)->boundary_id())] += cell->face(f)->measure();
  ASSERT_EQ(area.size(), 3u);
  EXPECT_NEAR(area["floor"], 1, 1e-12);
  EXPECT_NEAR(area["lid"], 1, 1e-12);
  // Two trapezia front and back (2.25 each), the straight side (2), the bulge (2 sqrt(1 + 1/16)).
  EXPECT_NEAR(area["shell"], 2 * 2.25 + 2 + 2 * std::sqrt(1.0625), 1e-12);
  EXPECT_EQ(domain.side("lid"), 8u);
  try {
    domain.side("led");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("lid"), std::string::npos) << error.what();
  }
}

TEST(Domain, GmshMeshesThatCannotBeUsed) {
  EXPECT_NE(message_for("no_such.msh").find("cannot be read"), std::string::npos);
  std::string text = two_cells;
  text.replace(text.find("$PhysicalNames"), text.find("$Nodes") - text.find("$PhysicalNames"), "");
  EXPECT_NE(message_for(written("unnamed.msh", text)).find("names no sides"), std::string::npos);
  text = two_cells;
  text.replace(text.find("2 8 \"lid\"\n"), 10, "");
  text.replace(text.find("$PhysicalNames\n4"), 16, "$PhysicalNames\n3");
  EXPECT_NE(message_for(written("half_named.msh", text)).find("without a name"), std::string::npos)
      << message_for(written("half_named.msh", text));
  text = two_cells;
  text.resize(text.find("$Elements") + 30);
  EXPECT_NE(message_for(written("cut.msh", text)), "accepted");
}

}  // namespace
}  // namespace seedflow
