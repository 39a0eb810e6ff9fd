// What a run leaves behind.
#include <nlohmann/json.hpp>
#include <regex>

#include "tiny_run.h"

namespace seedflow {
namespace {

namespace fs = std::filesystem;

class RunFiles : public TinyRun {
 protected:
  nlohmann::json summary() const { return nlohmann::json::parse(read_file(out() / "summary.json")); }
};

TEST_F(RunFiles, SummaryHasItsNames) {
  // Prescribed air: 0.2 s cost a second.
  ASSERT_EQ(run({"Air/Model=prescribed", "Run/End time=0.2 s", "Coupling/Undisturbed velocity=none",
                 "Seeds/Rigid=true", "Seeds motion/Time step=2e-6",
                 "Air domain/Upper corner=24 mm, 24 mm, 120 mm", "Seeds/Position=11 mm, 13 mm, 100 mm"})
                .status,
            exit_done);
  const auto json = summary();
  for (const char* name :
       {"velocity_0.05s", "velocity_0.10s", "velocity_0.15s", "velocity_0.20s", "terminal_velocity"}) {
    ASSERT_TRUE(json["observables"].contains(name)) << name;
    EXPECT_EQ(json["observables"][name]["unit"], "m/s");
  }
  const auto speed = [&](const char* name) { return json["observables"][name]["value"].get<double>(); };
  EXPECT_LT(speed("velocity_0.05s"), speed("velocity_0.10s"));
  // Per-seed drag with full buoyancy in fluid at rest: the Schiller-Naumann root, 0.1018 m/s. At 0.2 s the
  // seed is four to five relaxation times old.
  EXPECT_NEAR(speed("terminal_velocity"), 0.10175, 0.01 * 0.10175);
  EXPECT_NEAR(speed("terminal_velocity"), speed("velocity_0.20s"), 1e-3);
}

TEST_F(RunFiles, CoupledSummaryHasBalancesAndRates) {
  ASSERT_EQ(run({}).status, exit_done);
  const auto json = summary();
  EXPECT_GE(json["conservation"].size(), 4u);
  for (const auto& error : json["conservation"].items())
    EXPECT_TRUE(error.value().is_number()) << error.key();
  for (const char* name : {"wall_time_s", "peak_memory_MiB", "sub_sphere_steps_per_second_per_core",
                           "cell_steps_per_second_per_core"}) {
    ASSERT_TRUE(json["performance"].contains(name)) << name;
    EXPECT_GT(json["performance"][name].get<double>(), 0) << name;
  }
}

TEST_F(RunFiles, ReportIsOneFile) {
  ASSERT_EQ(run({}).status, exit_done);
  const std::string html = read_file(out() / "report.html");
  expect_contains(html, "<svg");
  expect_contains(html, "terminal_velocity");
  expect_contains(html, "What agrees, what cannot, and why");
  expect_contains(html, "</html>");
  // Nothing is loaded from elsewhere.
  const std::regex loads(
      R"(<(link|script|img|iframe|object)[^>]*(src|href)\s*=|@import|url\(\s*['"]?(?!#|data:))");
  EXPECT_FALSE(std::regex_search(html, loads));
}

TEST_F(RunFiles, UsedParametersRunAgainToTheLastBit) {
  ASSERT_EQ(run({"Air/Dynamic viscosity=0.0137", "Seeds/Orientation=0.1, 0.2, 0.3",
                 "Effects/Added mass/Strength=0.7"})
                .status,
            exit_done);
  const RunOutcome again = run_here({(out() / "used.prm").string(), "--output", out("again").string()});
  ASSERT_EQ(again.status, exit_done) << again.message;
  EXPECT_EQ(read_file(out() / "seeds.csv"), read_file(out("again") / "seeds.csv"));
  EXPECT_EQ(read_file(out() / "used.prm"), read_file(out("again") / "used.prm"));
}

TEST_F(RunFiles, UsedParametersFindTheirFiles) {
  fs::create_directory(folder / "shapes");
  write(
      "shapes/cube.stl",
      "solid c\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid "
      "c\n");
  const std::string prm =
      write("stl.prm", std::string(tiny_settling) +
                           "subsection Seeds\n  set Shape = stl\n  set File = shapes/cube.stl\nend\n");
  const RunOutcome first = run_here({prm, "--output", out().string(), "--set", "Run/End time=2 ms"});
  ASSERT_EQ(first.status, exit_done) << first.message;
  ASSERT_EQ(run_here({(out() / "used.prm").string(), "--output", out("again").string()}).status, exit_done);
  EXPECT_EQ(read_file(out() / "seeds.csv"), read_file(out("again") / "seeds.csv"));
}

TEST_F(RunFiles, PvdListsFilesThatExist) {
  ASSERT_EQ(run_program({"Run/Field interval=5 ms"}, "out", 2).status, exit_done);
  for (const char* name : {"seeds.pvd", "air.pvd"}) {
    const std::string text = read_file(out() / name);
    const std::regex entry("timestep=\"([^\"]*)\"[^>]*file=\"([^\"]*)\"");
    int count = 0;
    for (std::sregex_iterator m(text.begin(), text.end(), entry), end; m != end; ++m, ++count) {
      EXPECT_NEAR(std::stod((*m)[1]), 5e-3 * count, 1e-12);
      EXPECT_GT(fs::file_size(out() / std::string((*m)[2])), 500u) << (*m)[2];
      // A .pvtu names its pieces.
      const std::string listed = read_file(out() / std::string((*m)[2]));
      const std::regex piece("Source=\"([^\"]*)\"");
      for (std::sregex_iterator p(listed.begin(), listed.end(), piece); p != end; ++p)
        EXPECT_TRUE(fs::exists(out() / std::string((*p)[1]))) << (*p)[1];
    }
    EXPECT_EQ(count, 3) << name;  // 0, 5 and 10 ms
  }
  EXPECT_TRUE(fs::exists(out() / "walls.vtp"));
}

}  // namespace
}  // namespace seedflow
