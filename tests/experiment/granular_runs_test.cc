// The experiments with many seeds from outside: a few soft spheres, seconds of computing.
#include <cmath>

#include "seedflow/experiment/rotating_drum.h"
#include "seedflow/experiment/slope_screening.h"
#include "soft_spheres.h"
#include "tiny_run.h"

namespace seedflow {
namespace {

namespace fs = std::filesystem;

const char* const tiny_repose = R"(
set Experiment = repose angle
subsection Run
  set End time = 0.6 s
  set Series interval = 10 ms
  set Field interval = 0.2 s
end
subsection Filling
  set Mass = 12 g
end
subsection Tester
  set Box width = 40 mm
  set Depth = 16 mm
  set Outlet = 20 mm
  set Drop = 30 mm
  set Floor width = 140 mm
end
)";

const char* const tiny_screen = R"(
set Experiment = slope screening
subsection Run
  set End time = 0.6 s
  set Series interval = 10 ms
  set Field interval = 0
end
subsection Filling
  set Mass = 3 g
end
subsection Screen
  set Width = 30 mm
  set Length = 120 mm
  set Loading length = 20 mm
end
)";

const char* const tiny_drum = R"(
set Experiment = rotating drum
subsection Run
  set Series interval = 25 ms
  set Field interval = 0
end
subsection Filling
  set Mass = 8 g
end
subsection Drum
  set Radius = 24 mm
  set Length = 16 mm
  set Speed = 60 rpm
  set Revolutions = 1
  set Plateau from = 0.5
  set Profile from = 0.5
  set Pictures at = 0.5
end
)";

class GranularRuns : public TinyRun {
 protected:
  void SetUp() override {
    TinyRun::SetUp();
    write("repose.prm", std::string(tiny_repose) + soft_spheres + rough_contacts);
    write("screen.prm", std::string(tiny_screen) + soft_spheres);
    write("drum.prm", std::string(tiny_drum) + soft_spheres);
  }
  std::vector<std::string> with(const std::string& prm, const std::vector<std::string>& set = {},
                                const std::string& name = "out",
                                const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = arguments(set, name, more);
    all[0] = (folder / prm).string();
    return all;
  }
  void refused(const std::string& prm, const std::vector<std::string>& set, const std::string& message) {
    const RunOutcome result = run_here(with(prm, set));
    EXPECT_EQ(result.status, exit_bad_input) << message;
    expect_contains(result.message, message);
    EXPECT_FALSE(fs::exists(out() / "summary.json"));
  }
};

// ---- Filling ----

TEST_F(GranularRuns, FullRoom) {
  refused("repose.prm", {"Filling/Mass=1 kg"}, "Feeder 'upper box' is full after ");
  refused("drum.prm", {"Filling/Mass=50 g"}, "Feeder 'left half of the drum' is full after ");
}

// ---- Bad input ----

TEST_F(GranularRuns, ContradictorySettings) {
  refused("repose.prm", {"Tester/Outlet=50 mm"}, "it is wider than the box. Use at most Tester/Box width");
  refused("repose.prm", {"Tester/Floor width=30 mm"}, "it is narrower than the box");
  refused("repose.prm", {"Tester/Outlet=5 mm"}, "seeds of this diameter would jam in it");
  refused("repose.prm", {"Filling/Mass=1 mg"}, "it is less than half the mass of one seed");
  refused("repose.prm", {"Filling/Diameter deviation=1 mm"}, "it is more than a fifth of the diameter");
  refused("repose.prm", {"Run/Series interval=3 s"}, "it is longer than the run");
  refused("repose.prm", {"Angle/Lowest part=0.5", "Angle/Highest part=0.6"}, "less than a fifth");
  refused("screen.prm", {"Screen/Hole pitch=4 mm"}, "the holes overlap. Use more than Screen/Hole diameter");
  refused("screen.prm", {"Screen/Hole diameter=20 mm", "Screen/Hole pitch=30 mm"}, "no room for such holes");
  refused("screen.prm", {"Seeds motion/Gravity=1, 0, -9.81"}, "gravity must point down");
  refused("drum.prm", {"Run/End time=1 s"}, "Set Drum/Revolutions instead");
  refused("drum.prm", {"Drum/Plateau from=2"}, "the run ends before. Use less than Drum/Revolutions");
  refused("drum.prm", {"Drum/Radius=5 mm"}, "it is less than three seeds");
  refused("drum.prm", {"Drum/Length=5 mm"}, "it is less than two seeds");
}

TEST_F(GranularRuns, UnknownMaterials) {
  refused("repose.prm", {"Tester/Material=photosensitive resn"}, "photosensitive resin");
  refused("drum.prm", {"Drum/Barrel material=steel"}, "steel");
  refused("drum.prm", {"Drum/Measurements=" + (folder / "none.csv").string()}, "none.csv");
}

TEST_F(GranularRuns, TooLargeTimeStep) {
  refused("repose.prm", {"Seeds motion/Time step=1e-3"}, "is above its limit of");
}

TEST_F(GranularRuns, DryRunSaysWhatItWillBe) {
  const RunOutcome result = run_here(with("repose.prm", {}, "out", {"--dry-run"}));
  EXPECT_EQ(result.status, exit_done) << result.message;
  EXPECT_FALSE(fs::exists(out()));
}

// ---- Runs ----

TEST_F(GranularRuns, ReposeAngleLeavesAllFiles) {
  ASSERT_EQ(run_here(with("repose.prm", {"Tester/Outlet=18 mm"})).status, exit_done);
  for (const char* name : {"summary.json", "used.prm", "series.csv", "seeds.pvd", "walls.vtp",
                           "moving_walls.pvd", "report.html", "heap.svg"})
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  const Summary summary = Summary::read(out() / "summary.json");
  EXPECT_EQ(summary.observable("seeds"), 267);  // 12 g / 4.4903e-5 kg
  EXPECT_GT(summary.observable("angle"), 15);
  EXPECT_LT(summary.observable("angle"), 50);
  // All but a few stragglers are at rest: a hundredth of what was to fall.
  const Series series = read_series(out() / "series.csv");
  EXPECT_LT(series["kinetic energy"].back(), 1e-2 * series["potential energy"].front());
  EXPECT_LT(series["potential energy"].back(), series["potential energy"].front());
  const std::string report = read_file(out() / "report.html");
  expect_contains(report, "<svg");
  expect_contains(report, "--set &quot;Tester/Outlet=18 mm&quot;");
  expect_contains(report, "Reduced shear moduli: all are 0.001 times");
  // Two to twelve neighbours in a heap; balls have one contact per pair. Softened a thousandfold, overlaps
  // are to be seen, but no ball has gone through another.
  EXPECT_GT(summary.observable("neighbours_per_seed"), 2);
  EXPECT_LT(summary.observable("neighbours_per_seed"), 12);
  EXPECT_EQ(summary.observable("contacts_per_pair"), 1);
  EXPECT_GT(summary.observable("largest_overlap"), 0.01);
  EXPECT_LT(summary.observable("largest_overlap"), 0.5);
}

// The board is there before the start; while it is pulled away it has moved; then it is gone.
TEST_F(GranularRuns, WallsThatMoveAreSeenMoving) {
  ASSERT_EQ(run_here(with("repose.prm", {"Run/Field interval=0.1 s", "Run/End time=0.25 s"})).status,
            exit_done);
  const std::string first = read_file(out() / "moving_walls_00000.vtp"),
                    second = read_file(out() / "moving_walls_00001.vtp"),
                    third = read_file(out() / "moving_walls_00002.vtp");
  expect_contains(first, "NumberOfPolys=\"1\"");
  expect_contains(third, "NumberOfPolys=\"0\"");
  expect_contains(second, "NumberOfPolys=\"1\"");
  EXPECT_NE(first, second);
  expect_contains(read_file(out() / "walls.vtp"), "Name=\"wall\"");
}

TEST_F(GranularRuns, ResumedRunIsTheSameToTheLastBit) {
  ASSERT_EQ(run_here(with("repose.prm", {}, "whole")).status, exit_done);
  ASSERT_EQ(run_here(with("repose.prm", {"Run/End time=0.2 s"}, "parts")).status, exit_done);
  const RunOutcome resumed = run_here(with("repose.prm", {}, "parts", {"--resume"}));
  ASSERT_EQ(resumed.status, exit_done) << resumed.message;
  EXPECT_EQ(read_file(out("whole") / "series.csv"), read_file(out("parts") / "series.csv"));
  EXPECT_EQ(read_file(out("whole") / "seeds.pvd"), read_file(out("parts") / "seeds.pvd"));
}

// Balls of 100 kg/m3, the drag of which is seen. The balance holds with the impulse of the air in it, a
// resumed run is the same, and so is one from a filling that was settled without air.
TEST_F(GranularRuns, AirDragIsBookedAndResumed) {
  const std::vector<std::string> light = {"Filling/Mass=0.9 g", "Run/End time=0.3 s",
                                          "Filling/Cache=" + (folder / "filling").string(),
                                          "Seeds/Density=100", "Seeds motion/Time step=3e-5"};
  const auto set = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = light;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const std::string on = "Effects/Air drag/Strength=1";
  ASSERT_EQ(run_here(with("repose.prm", set({}), "off")).status, exit_done);
  const RunOutcome whole = run_here(with("repose.prm", set({on}), "whole"));
  ASSERT_EQ(whole.status, exit_done) << whole.message;
  const Summary summary = Summary::read(out("whole") / "summary.json");
  EXPECT_GT(summary.observable("air_drag_over_weight"), 1e-3);
  EXPECT_LT(summary.observable("air_drag_over_weight"), 0.5);
  EXPECT_GT(summary.observable("air_drag_impulse"), 0);
  expect_contains(read_file(out("whole") / "summary.json"), "gravity, walls and air");
  EXPECT_EQ(read_file(out("off") / "summary.json").find("air_drag"), std::string::npos);
  EXPECT_NE(read_file(out("off") / "series.csv"), read_file(out("whole") / "series.csv"));

  std::vector<std::string> part = set({on});
  part[1] = "Run/End time=0.2 s";
  ASSERT_EQ(run_here(with("repose.prm", part, "parts")).status, exit_done);
  const RunOutcome resumed = run_here(with("repose.prm", set({on}), "parts", {"--resume"}));
  ASSERT_EQ(resumed.status, exit_done) << resumed.message;
  EXPECT_EQ(read_file(out("whole") / "series.csv"), read_file(out("parts") / "series.csv"));
  EXPECT_EQ(summary.observable("air_drag_impulse"),
            Summary::read(out("parts") / "summary.json").observable("air_drag_impulse"));
}

TEST_F(GranularRuns, AirDragThatNeverActsIsAnError) {
  const RunOutcome result =
      run_here(with("drum.prm", {"Effects/Air drag/Strength=1", "Drum/Revolutions=0.1",
                                 "Drum/Plateau from=0.01", "Seeds motion/Gravity=0, 0, 0"}));
  EXPECT_EQ(result.status, exit_failed) << result.message;
  expect_contains(result.message, "\"Air drag\" is switched on but added nothing");
}

TEST_F(GranularRuns, InterruptedWhileFilling) {
  write("stop.sh", command(with("repose.prm", {}, "stopped")) + " &\npid=$!\nfor i in $(seq 4000); do [ -f " +
                       (out("stopped") / "used.prm").string() +
                       " ] && break; sleep 0.01; done\nkill -TERM $pid\nwait $pid\n");
  EXPECT_EQ(run_in_shell("sh stop.sh", folder).status, exit_interrupted);
  ASSERT_EQ(run_here(with("repose.prm", {}, "stopped", {"--resume"})).status, exit_done);
  ASSERT_EQ(run_here(with("repose.prm", {}, "whole")).status, exit_done);
  EXPECT_EQ(read_file(out("whole") / "series.csv"), read_file(out("stopped") / "series.csv"));
}

TEST_F(GranularRuns, ScreeningKeepsAccountOfAllSeeds) {
  const RunOutcome result = run_here(with("screen.prm"));
  ASSERT_EQ(result.status, exit_done) << result.message;
  const Summary summary = Summary::read(out() / "summary.json");
  double sum = summary.observable("over_the_end") + summary.observable("left_on_the_plate");
  for (int area = 1; area <= 5; ++area) sum += summary.observable("area_" + std::to_string(area));
  EXPECT_NEAR(sum, 100, 1e-9);
  EXPECT_GT(summary.observable("total_passing"), 5);
  // Nothing passes before the insert plate is taken away.
  EXPECT_EQ(read_series(out() / "series.csv")["area 1"].front(), 0);
}

// Holes smaller than the seeds let none through; seeds much smaller than the holes leave nothing to slide on.
TEST_F(GranularRuns, HolesDecideWhatPasses) {
  ASSERT_EQ(run_here(with("screen.prm", {"Screen/Hole diameter=3 mm"}, "small")).status, exit_done);
  EXPECT_EQ(Summary::read(out("small") / "summary.json").observable("total_passing"), 0);
}

TEST_F(GranularRuns, DrumMixes) {
  const RunOutcome result = run_here(with("drum.prm"));
  ASSERT_EQ(result.status, exit_done) << result.message;
  const Series series = read_series(out() / "series.csv");
  const std::vector<double>& mixing = series["lacey 3d 10 mm"];
  EXPECT_LT(mixing.front(), 40);  // only cells across the diaphragm hold both colours
  EXPECT_GT(mixing.back(), mixing.front() + 10);
  const double angle = Summary::read(out() / "summary.json").observable("dynamic_angle");
  EXPECT_GT(angle, 10);  // rises on the side where the wall goes up
  EXPECT_LT(angle, 70);
  EXPECT_TRUE(fs::exists(out() / "drum_0.5_revolutions.svg"));
}

TEST_F(GranularRuns, StudyRunsEveryCaseOnceAndGoesOn) {
  const std::vector<std::string> set = {"Experiment=slope screening study", "Study/Models=1",
                                        "Study/Repeats=2", "Study/Inclinations=10 deg, 20 deg",
                                        "Run/End time=0.3 s"};
  const RunOutcome result = run_here(with("screen.prm", set));
  ASSERT_EQ(result.status, exit_done) << result.message;
  for (const char* name :
       {"study.csv", "summary.json", "report.html", "fillings/N1_rigid_radius_1/current",
        "runs/N1_rigid_radius_1_10deg/summary.json", "runs/N1_rigid_radius_2_20deg/summary.json"})
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  // One run is lost: only that one is made again, and gives the same.
  const fs::path kept = out() / "runs/N1_rigid_radius_1_10deg/summary.json",
                 lost = out() / "runs/N1_rigid_radius_2_20deg";
  const auto time = fs::last_write_time(kept);
  const std::string before = read_file(out() / "study.csv");
  fs::remove_all(lost);
  ASSERT_EQ(run_here(with("screen.prm", set)).status, exit_done);
  EXPECT_EQ(fs::last_write_time(kept), time);
  EXPECT_TRUE(fs::exists(lost / "summary.json"));
  EXPECT_EQ(read_file(out() / "study.csv"), before);
}

}  // namespace
}  // namespace seedflow
