// The metering device from outside: a few soft spheres and four holes, seconds of computing.
#include "seedflow/experiment/metering.h"

#include <cmath>

#include "seedflow/experiment/seeding_record.h"
#include "seedflow/output/series.h"
#include "tiny_device.h"

namespace seedflow {
namespace {

TEST_F(MeteringRuns, ImpossibleInputIsNamed) {
  refused({"Suction/Vacuum=3 kPa"}, "a vacuum is below the surroundings");
  refused({"Suction/Vacuum=-20 kPa"}, "incompressible");
  refused({"Metering/Blade clearance=-0.1 mm"}, "the blade would cut into the disc");
  refused({"Effects/Disc vibration/Strength=1", "Effects/Disc vibration/Amplitude=0.6 mm"},
          "the shaking disc would strike the blade");
  refused({"Device/Hole diameter=12 mm"}, "neighbouring holes overlap");
  refused({"Device/Vacuum inner radius=89.5 mm"}, "the holes do not open into the vacuum chamber");
  refused({"Device/Vacuum to=-140 deg"}, "the arc must be longer than 0");
  refused({"Metering/Blade height=7 mm"}, "reaches through the chamber's front cover");
  refused({"Device/Hole diameter=4.5 mm"}, "the seeds would be drawn through the holes");
  refused({"Device/Pitch radius=99.5 mm"}, "the holes reach over the disc's rim");
  refused({"Metering/Tube position=-60 mm"}, "fall beside the tube, at x = ");
  refused({"Metering/Blade angle=170 deg"}, "does not stand between the pool");
  refused({"Metering/Disc material=steel"}, "steel");
  refused({"Seeds motion/Gravity=0, 0, -9.81"}, "the disc stands upright");
  refused({"Air/Step=1 ms"}, "a seed falls into a hole within a millisecond");
}

// Spheres on a seat: the mean force of the vacuum is dp x seat area (0.9886 of it: the rim is a polygon).
TEST_F(MeteringRuns, TakesCarriesAndLaysSeeds) {
  const RunOutcome result = run_here(with({"Run/Field interval=0.3 s"}));
  ASSERT_EQ(result.status, exit_done) << result.message;
  for (const char* name : {"summary.json", "used.prm", "series.csv", "report.html", "holes.csv",
                           "landings.csv", "seed_A.csv", "walls.vtp", "moving_walls.pvd", "device_0.3s.svg"})
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  const Summary s = Summary::read(out() / "summary.json");
  EXPECT_EQ(s.observable("unloading_n"), 4);
  EXPECT_GE(s.observable("unloading_good_n"), 2);
  EXPECT_GE(s.observable("seeds_laid"), s.observable("unloading_good_n"));
  EXPECT_NEAR(s.observable("holding_force") / s.observable("pressure_times_seat_area"), 0.98, 0.03);
  EXPECT_NEAR(s.observable("target_spacing"), 0.05, 1e-9);  // 60 holes, 1/s, 3 m/s
  // Four open holes: 4 Cd A sqrt(2 dp/rho) at most, and less while seeds cover them.
  const double open = 4 * 0.8 * M_PI * 1e-6 * std::sqrt(5000.0);
  EXPECT_LT(s.observable("air_flow"), open);
  EXPECT_GT(s.observable("air_flow"), 0.1 * open);
}

TEST_F(MeteringRuns, WithoutVacuumNothingIsTaken) {
  ASSERT_EQ(run_here(with({"Suction/Vacuum=0", "Run/End time=0.5 s"})).status, exit_done);
  const Summary s = Summary::read(out() / "summary.json");
  EXPECT_EQ(s.observable("behind_blade_n"), 4);
  EXPECT_EQ(s.observable("behind_blade_miss_n"), 4);
  EXPECT_EQ(s.observable("air_flow"), 0);
}

TEST_F(MeteringRuns, ResumedRunIsTheSameToTheLastBit) {
  ASSERT_EQ(run_here(with({"Run/End time=0.2 s"}, "whole")).status, exit_done);
  ASSERT_EQ(run_here(with({"Run/End time=0.1 s"}, "parts")).status, exit_done);
  const RunOutcome resumed = run_here(with({"Run/End time=0.2 s"}, "parts", {"--resume"}));
  ASSERT_EQ(resumed.status, exit_done) << resumed.message;
  EXPECT_EQ(read_file(out("whole") / "series.csv"), read_file(out("parts") / "series.csv"));
  EXPECT_EQ(read_file(out("whole") / "holes.csv"), read_file(out("parts") / "holes.csv"));
}

TEST_F(MeteringRuns, SameOnTwoRanks) {
  const std::string prm = (folder / "device.prm").string();
  std::vector<std::string> args = with({"Run/End time=0.1 s"}, "two");
  ASSERT_EQ(run_in_shell(command(args, 2), folder).status, exit_done);
  ASSERT_EQ(run_here(with({"Run/End time=0.1 s"}, "one")).status, exit_done);
  EXPECT_EQ(read_file(out("one") / "series.csv"), read_file(out("two") / "series.csv"));
}

TEST_F(MeteringRuns, ComputedAirRefusesWhatItDoesNotKnow) {
  refused(
      {"Air/Model=resolved", "Effects/Disc vibration/Strength=1", "Effects/Disc vibration/Amplitude=1 mm"},
      "does not shake with the disc");
  refused({"Air/Model=resolved", "Air/Step=2 ms"}, "Use at most 1 ms");
  refused({"Air/Model=resolved", "Suction/Seeds block holes=false"}, "seeds always block the holes");
}

TEST_F(MeteringRuns, DryRunSaysWhatTheAirCosts) {
  const ShellResult result =
      run_in_shell(command(with_computed_air({"Run/End time=60 ms"}, "out", {"--dry-run"})), folder);
  ASSERT_EQ(result.status, exit_done) << result.err;
  expect_contains(result.out, "Air:        2752 cells, 60 steps of 0.001 s");
  EXPECT_FALSE(fs::exists(out()));
}

// All balances of summary.json are within their limits, or the run would not end well.
TEST_F(MeteringRuns, ComputedAirTakesSeeds) {
  const RunOutcome result = run_here(with_computed_air({"Run/End time=60 ms", "Run/Field interval=30 ms"}));
  ASSERT_EQ(result.status, exit_done) << result.message;
  for (const char* name : {"air.pvd", "air_00002.pvtu", "open_hole.csv", "hole_with_seed.csv"})
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  const Series series = read_series(out() / "series.csv");
  EXPECT_GE(series["holes with one seed"].back(), 1);
  const double seat = 3000 * M_PI * 1.69e-6;
  EXPECT_GT(series["largest pressure force"].back(), 0.4 * seat);
  EXPECT_LT(series["largest pressure force"].back(), 1.3 * seat);
  const Summary s = Summary::read(out() / "summary.json");
  EXPECT_GT(s.observable("air_flow"), 0);
  EXPECT_EQ(s.observable("air_steps"), 60);
}

TEST_F(MeteringRuns, ComputedAirWithAFrozenRotorTakesSeeds) {
  const RunOutcome result = run_here(with_computed_air({"Run/End time=60 ms", "Air/Rotor=frozen"}));
  ASSERT_EQ(result.status, exit_done) << result.message;
  EXPECT_GE(read_series(out() / "series.csv")["holes with one seed"].back(), 1);
}

// Iterative solvers: the same to their tolerance, not to the last bit.
TEST_F(MeteringRuns, ComputedAirIsTheSameOnTwoRanksAndAfterAResumption) {
  const auto until = [](const std::string& end) {
    return std::vector<std::string>{"Run/End time=" + end, "Suction/Fan flow=2e-3",
                                    "Effects/Seal leak/Strength=1", "Effects/Suction line loss/Strength=1",
                                    "Effects/Disc vibration/Strength=0.5"};
  };
  ASSERT_EQ(run_here(with_computed_air(until("20 ms"), "one")).status, exit_done);
  ASSERT_EQ(run_in_shell(command(with_computed_air(until("20 ms"), "two"), 2), folder).status, exit_done);
  ASSERT_EQ(run_here(with_computed_air(until("10 ms"), "parts")).status, exit_done);
  const RunOutcome resumed = run_here(with_computed_air(until("20 ms"), "parts", {"--resume"}));
  ASSERT_EQ(resumed.status, exit_done) << resumed.message;
  const Series one = read_series(out("one") / "series.csv");
  for (const char* other : {"two", "parts"}) {
    const Series same = read_series(out(other) / "series.csv");
    ASSERT_EQ(same.n_rows(), one.n_rows()) << other;
    for (const char* column : {"kinetic energy", "air flow", "largest pressure force"})
      EXPECT_NEAR(same[column].back() / one[column].back(), 1, 0.02) << other << ", " << column;
  }
}

TEST_F(MeteringRuns, LeakAndLineTakeVacuumAway) {
  const std::vector<std::string> shared = {"Run/End time=50 ms"};
  ASSERT_EQ(run_here(with(shared, "tight")).status, exit_done);
  std::vector<std::string> leaky = shared;
  leaky.insert(leaky.end(), {"Effects/Seal leak/Strength=1", "Effects/Suction line loss/Strength=1"});
  ASSERT_EQ(run_here(with(leaky, "leaky")).status, exit_done);
  const Summary tight = Summary::read(out("tight") / "summary.json"),
                leak = Summary::read(out("leaky") / "summary.json");
  EXPECT_NEAR(tight.observable("vacuum"), 3000, 1e-9);
  EXPECT_LT(leak.observable("vacuum"), 2900);
  EXPECT_GT(leak.observable("air_flow"), 2 * tight.observable("air_flow"));
}

// The disc's points go around with the disc and to and fro along its axis, from the start of the run on.
TEST(Metering, ShakingDiscMovesAsItsEffectSays) {
  Metering metering;
  metering.speed = 6;
  metering.suction.vibration_strength = 0.5;
  metering.suction.vibration_amplitude = 0.2e-3;
  metering.suction.vibration_frequency = 40;
  Metering::Gathered gathered(metering, metering.effects);
  const GranularScene scene = metering.scene(gathered, {});
  Dem dem(metering.granular.dem);
  const int material = dem.add_material(Material());
  for (Wall wall : metering.walls()) {
    wall.material = material;
    dem.add_wall(wall);
  }
  const double start = 0.3;
  scene.begin(dem, start);
  const WallMotion& motion = dem.walls()[Metering::disc_wall].motion;
  EXPECT_EQ(placement(motion, start - 1e-3).velocity_at({0.09, 0, 0}).z, 0);
  for (const double t : {0.0, 0.004, 0.011}) {
    const Placement place = placement(motion, start + t);
    const Vec3 at = place.to_lab({0.09, 0, 0}), velocity = place.velocity_at(at);
    const double phase = 2 * M_PI * 40 * t;
    EXPECT_NEAR(at.z, 0.1e-3 * std::sin(phase), 1e-12);
    EXPECT_NEAR(velocity.z, 0.1e-3 * 2 * M_PI * 40 * std::cos(phase), 1e-9);
    EXPECT_NEAR(velocity.x, -6 * 0.09 * std::sin(6 * t), 1e-9);
    EXPECT_NEAR(velocity.y, 6 * 0.09 * std::cos(6 * t), 1e-9);
  }
}

TEST_F(MeteringRuns, MapRunsEveryPointOnce) {
  const std::vector<std::string> set = {"Experiment=metering map", "Study/Vacuums=-1 kPa, -3 kPa",
                                        "Study/Speeds=60 rpm, 120 rpm", "Study/Hole diameters=2 mm",
                                        "Study/Turns=0.6"};
  const RunOutcome result = run_here(with(set));
  ASSERT_EQ(result.status, exit_done) << result.message;
  for (const char* name : {"map.csv", "summary.json", "report.html", "runs/1000Pa_60rpm_2mm_1/summary.json",
                           "runs/3000Pa_120rpm_2mm_1/summary.json"})
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  const auto time = fs::last_write_time(out() / "runs/1000Pa_60rpm_2mm_1/summary.json");
  ASSERT_EQ(run_here(with(set)).status, exit_done);
  EXPECT_EQ(fs::last_write_time(out() / "runs/1000Pa_60rpm_2mm_1/summary.json"), time);
}

}  // namespace
}  // namespace seedflow
