// Walls as a user writes them, and what is refused.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "seedflow/base/error.h"
#include "seedflow/base/parameters.h"
#include "seedflow/seeds/wall_parameters.h"

namespace seedflow {
namespace {

class WallParameters : public ::testing::Test {
 protected:
  std::string file =
      (std::filesystem::temp_directory_path() / ("seedflow_walls_" + std::to_string(getpid()) + ".prm"))
          .string();
  void TearDown() override { std::filesystem::remove(file); }

  std::vector<Wall> read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    std::ofstream(file) << text;
    WallTable table = WallTable::named_in(file, overrides);
    Parameters p;
    table.declare(p);
    p.read(file, overrides);
    return table.build(p, [](const std::string& name) {
      if (name != "seed" && name != "steel") throw InputError("There is no material \"" + name + "\".");
      return name == "steel" ? 1 : 0;
    });
  }
  void refused(const std::string& text, const std::string& reason) {
    try {
      read(text);
      ADD_FAILURE() << "accepted although: " << reason;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(file + ":"), std::string::npos) << error.what();
    }
  }
};

std::string wall(const std::string& name, const std::string& lines) {
  return "  subsection " + name + "\n" + lines + "\n  end\n";
}
std::string walls(const std::string& names, const std::string& rest) {
  return "subsection Walls\n  set Names = " + names + "\n" + rest + "end\n";
}

const std::string sieve =
    "set Shape = plate\nset Length = 300 mm\nset Width = 150 mm\nset Thickness = 1 mm\n"
    "set Holes = staggered\nset Hole diameter = 4.2 mm\nset Pitch along = 6 mm\nset Pitch across = 5.2 mm\n";

TEST_F(WallParameters, ShapesMotionsAndUnits) {
  const auto found = read(
      walls("drum, gate, sieve",
            wall("drum",
                 "set Shape = cylinder\nset Radius = 50 mm\nset Length = 2 cm\nset Material = steel\n"
                 "subsection Motion\nset Rotation = constant\nset Angular speed = 40 rpm\nend") +
                wall("gate",
                     "set Shape = rectangle\nset Length = 100 mm\nset Width = 50 mm\nset Normal = 1, 0, 0\n"
                     "set Along = 0, 0, 1\nsubsection Motion\nset Translation = constant\nset Speed = 1\n"
                     "set Displacement start = 0.5\nend") +
                wall("sieve", sieve)));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].material, 1);
  EXPECT_DOUBLE_EQ(std::get<Cylinder>(found[0].surface).radius, 0.05);
  EXPECT_NEAR(placement(found[0], 3).spin.z, 40 * 2 * M_PI / 60, 1e-14);
  EXPECT_DOUBLE_EQ(placement(found[1], 0.75).shift.z, 0.25);
  const auto& holes = std::get<HoleLattice>(std::get<Plate>(found[2].surface).holes);
  // (300 - 3 - 4.2) / 6 = 48.8 pitches along, (150 - 4.2) / 5.2 = 28.04 across.
  EXPECT_EQ(holes.n_along, 49);
  EXPECT_EQ(holes.n_across, 29);
}

TEST_F(WallParameters, AnOverrideMayChangeTheShape) {
  const auto found =
      read(walls("w", wall("w", "set Shape = plane")),
           {"Walls/w/Shape=cylinder", "Walls/w/Radius=3 mm", "Walls/w/Length=1 cm", "Walls/w/Side=outside"});
  EXPECT_EQ(std::get<Cylinder>(found.at(0).surface).side, Cylinder::Side::outside);
}

TEST_F(WallParameters, WhatIsWrittenCanBeReadAgain) {
  const std::string text = walls("sieve", wall("sieve", sieve));
  std::ofstream(file) << text;
  WallTable table = WallTable::named_in(file, {});
  Parameters p;
  table.declare(p);
  p.read(file);
  std::ofstream out(file);
  p.write(out);
  out.close();
  WallTable again = WallTable::named_in(file, {});
  Parameters q;
  again.declare(q);
  EXPECT_NO_THROW(q.read(file));
  EXPECT_EQ(again.size(), 1);
}

TEST_F(WallParameters, ImpossibleInputIsRefusedWithFileAndLine) {
  refused(walls("a, a", ""), "twice");
  refused(walls("a", wall("b", "")), "not known");
  refused(walls("a", wall("a", "set Shape = sphere")), "sphere");
  refused(walls("a", wall("a", "set Radius = 3 mm")), "not known");
  refused(walls("a", wall("a", "set Material = cheese")), "cheese");
  refused(walls("a", wall("a", "set Shape = cylinder\nset Radius = 3 mm")), "length");
  refused(walls("a", wall("a", sieve + "set Holes across = 40")), "does not lie inside");
  refused(walls("a", wall("a", sieve + "set Chamfer width = 1 mm\nset Chamfer depth = 0.6 mm")), "overlap");
  refused(walls("a", wall("a",
                          "set Shape = plate\nset Length = 30 mm\nset Width = 3 mm\nset Thickness = 1 mm\n"
                          "set Holes = list\nset Hole diameter = 4.2 mm\nset Hole positions = 0, 0")),
          "larger than the plate");
  refused(walls("a", wall("a",
                          "set Shape = plate\nset Outline = disc\nset Radius = 80 mm\nset Thickness = 0\n"
                          "set Holes = ring\nset Number of holes = 60\nset Pitch radius = 70 mm\n"
                          "set Hole diameter = 2 mm")),
          "thickness");
  refused(walls("a", wall("a",
                          "set Shape = plate\nset Outline = disc\nset Radius = 80 mm\nset Thickness = 4 mm\n"
                          "set Holes = ring\nset Number of holes = 60\nset Pitch radius = 90 mm\n"
                          "set Hole diameter = 2 mm")),
          "pitch radius");
  refused(walls("a", wall("a", "set Shape = mesh\nset File = missing.stl")), "missing.stl");
  refused(
      walls("a", wall("a", "subsection Motion\nset Translation = expression\nset Displacement = sin(\nend")),
      "does not read");
}

}  // namespace
}  // namespace seedflow
