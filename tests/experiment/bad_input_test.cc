// Bad input of a coupled run: the message says where, what, what is allowed and what to do; status 2.
#include "tiny_run.h"

namespace seedflow {
namespace {

class BadInput : public TinyRun {};

TEST_F(BadInput, UnknownSectionAndEntry) {
  expect_bad_input(
      {"Airs/Density=1"},
      "--set \"Airs/Density=1\": section \"Airs\" is not known. Nearest valid section: \"Air\".");
  expect_bad_input({"Air/Densty=1"}, "entry \"Densty\" is not known. Nearest valid entry: \"Density\".");
  expect_bad_input({"Effects/Drag/Lav=Rong"}, "Nearest valid entry: \"Law\".");
  const std::string file =
      write("wrong.prm", std::string(tiny_settling) + "subsection Coupling\n  set Kernel with = 4 mm\nend\n");
  const RunOutcome result = run_here({file, "--output", out().string()});
  EXPECT_EQ(result.status, exit_bad_input);
  expect_contains(result.message,
                  "wrong.prm:21: section \"Coupling\": entry \"Kernel with\" is not known. Nearest valid "
                  "entry: \"Kernel width\".");
}

TEST_F(BadInput, WrongTypeAndBounds) {
  expect_bad_input({"Air/Density=heavy"}, "entry \"Density\" = \"heavy\"");
  expect_bad_input({"Air/Density=1000 mm"}, "kg/m3");
  expect_bad_input({"Air/Density=-1"}, "out of bounds");
  expect_bad_input({"Air/Density=nan"}, "entry \"Density\"");
  expect_bad_input({"Seeds/Sub-spheres=3.5"}, "entry \"Sub-spheres\" = \"3.5\"");
  expect_bad_input({"Seeds/Rigid=perhaps"}, "entry \"Rigid\" = \"perhaps\"");
  expect_bad_input({"Coupling/Exchange kernel=gausian"}, "gaussian");
  expect_bad_input({"Coupling/Lowest void fraction=1.5"}, "out of bounds");
  expect_bad_input({"Air domain/Cells=6, 6"}, "Cells");
  expect_bad_input({"Air domain/Cells=6, 6, 2.5"}, "Cells");
  expect_bad_input({"Seeds/Position=1 mm, 2 mm"}, "entry \"Position\"");
}

TEST_F(BadInput, AllMistakesAreListedAtOnce) {
  const RunOutcome result = run({"Air/Densty=1", "Seeds/Diameter=-4 mm"});
  expect_contains(result.message, "Densty");
  expect_contains(result.message, "Diameter");
}

TEST_F(BadInput, EntriesThatContradictEachOther) {
  expect_bad_input({"Coupling/Drag on=sub-sphere"}, "Undisturbed velocity");
  expect_bad_input({"Coupling/Kernel width=1 mm"}, "Use at least 0.002000 m, or smaller cells.");
  expect_bad_input({"Run/Air step=20 ms"}, "it is longer than the run");
  expect_bad_input({"Effects/Drag/Law=Di Felice", "Effects/Hindered settling/Strength=1"}, "count twice");
  expect_bad_input({"Air domain/Upper corner=24 mm, 24 mm, 0 mm"}, "it must lie above Lower corner");
  expect_bad_input({"Air/Boundary conditions=botom: wall; *: wall"}, "\"bottom\"");
}

TEST_F(BadInput, MissingFiles) {
  RunOutcome result = run_here({(folder / "none.prm").string(), "--output", out().string()});
  EXPECT_EQ(result.status, exit_bad_input);
  expect_contains(result.message,
                  "none.prm: this file cannot be opened. Check its name and that it can be read.");
  expect_bad_input({"Seeds/Shape=stl", "Seeds/File=" + (folder / "none.stl").string()},
                   "none.stl' (missing or empty); give the name of an STL file.");
  expect_bad_input(
      {"Seeds/Shape=csv", "Seeds/Sub-spheres=70", "Seeds/File=" + (folder / "none.csv").string()},
      "none.csv'; give the name of a readable CSV file.");
  expect_bad_input({"Seeds/Shape=stl"}, "none is given");
}

const char* const tetrahedron[] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};

std::string stl_of(const std::vector<std::array<int, 3>>& triangles) {
  std::string text = "solid seed\n";
  for (const auto& t : triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int v : t) text += std::string("vertex ") + tetrahedron[v] + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid seed\n";
}

TEST_F(BadInput, Surfaces) {
  const std::string open = write("open.stl", stl_of({{0, 2, 1}, {0, 1, 3}, {0, 3, 2}}));
  expect_bad_input({"Seeds/Shape=stl", "Seeds/File=" + open}, "open.stl: 3 edges");
  std::string text = stl_of({{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  text.replace(text.find("1 0 0"), 5, "nan 0 0");
  expect_bad_input({"Seeds/Shape=stl", "Seeds/File=" + write("nan.stl", text)}, "nan.stl, line");
  expect_bad_input({"Seeds/Shape=stl", "Seeds/File=" + write("cut.stl", "solid seed\nfacet normal 0 0 1\n")},
                   "cut.stl");
}

TEST_F(BadInput, Templates) {
  const auto csv = [&](const std::string& text) {
    return std::vector<std::string>{"Seeds/Shape=csv", "Seeds/Sub-spheres=70",
                                    "Seeds/File=" + write("seed.csv", text)};
  };
  const std::string head = "name,pellet\nvolume,3.35e-8\ndensity,1340\n";
  expect_bad_input(csv(head), "there is no row 'sphere,...'; at least one is needed.");
  expect_bad_input(csv(head + "sphere,0,0,0,1e-3,1e-5\nsphere,0,0,nan,1e-3,1e-5\n"), "seed.csv, line 5");
  expect_bad_input(csv(head + "sphere,0,0\n"), "seed.csv, line 4");
  expect_bad_input(csv(head + "spher,0,0,0,1e-3,1e-5\n"), "seed.csv, line 4");
  expect_bad_input({"Seeds/Shape=csv", "Seeds/File=" + write("seed.csv", head)},
                   "it has no effect with Shape = csv");
}

TEST_F(BadInput, PlaceOfTheSeed) {
  expect_bad_input({"Seeds/Position=11 mm, 13 mm, 60 mm"}, "the seed starts outside the air domain");
  expect_bad_input({"Seeds/Position=11 mm, 13 mm, 1 mm"}, "m inside wall 'z-'. Move the seed.");
  expect_bad_input({"Seeds/Position=11 mm, 23.5 mm, 30 mm"}, "m inside wall 'y+'. Move the seed.");
}

TEST_F(BadInput, TimeStepAboveItsLimit) {
  const RunOutcome result = run({"Seeds motion/Time step=1e-4"});
  EXPECT_EQ(result.status, exit_bad_input);
  expect_contains(result.message, "The DEM time step of 0.0001 s is above its limit of ");
  const std::string remedy = "Set 'Time step' to at most ";
  expect_contains(result.message, remedy);
  // The remedy is right: the limit itself runs.
  const std::string limit = result.message.substr(result.message.find(remedy) + remedy.size(), 20);
  const double step = std::stod(limit);
  EXPECT_GT(step, 1e-7);
  EXPECT_LT(step, 1e-4);
  EXPECT_EQ(
      run({"Seeds motion/Time step=" + std::to_string(step * 1e6 * 0.999) + "e-6"}, "limit", {"--dry-run"})
          .status,
      exit_done);
}

TEST_F(BadInput, OutputFolderThatCannotBeWritten) {
  write("plain", "a file");
  const RunOutcome result = run({}, "plain/below");
  EXPECT_EQ(result.status, exit_bad_input);
  expect_contains(result.message,
                  "plain/below' cannot be created: Not a directory. Choose another folder with --output.");
}

TEST_F(BadInput, MoreRanksThanCells) {
  const ShellResult result =
      run_program({"Air domain/Cells=1, 1, 2", "Coupling/Kernel width=15 mm"}, "out", 3);
  EXPECT_EQ(result.status, exit_bad_input);
  EXPECT_EQ(result.err,
            "The air mesh has 2 cells, too few for 3 ranks. Use fewer ranks (--mpi) or a finer mesh.\n");
}

TEST_F(BadInput, DryRunFindsItAndWritesNothing) {
  EXPECT_EQ(run({"Seeds/Position=11 mm, 13 mm, 1 mm"}, "out", {"--dry-run"}).status, exit_bad_input);
  EXPECT_EQ(run({}, "out", {"--dry-run"}).status, exit_done);
  EXPECT_FALSE(std::filesystem::exists(out()));
}

}  // namespace
}  // namespace seedflow
