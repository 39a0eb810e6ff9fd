// The heap and the sieve as models of measurements: a few dozen soft spheres, a second each.
#include <cmath>

#include "seedflow/experiment/repose_angle.h"
#include "seedflow/experiment/slope_screening.h"
#include "soft_spheres.h"
#include "tiny_run.h"

namespace seedflow {
namespace {

const char* const small_heap = R"(
set Experiment = repose angle
subsection Run
  set End time        = 0.5 s
  set Series interval = 20 ms
  set Field interval  = 0
end
subsection Filling
  set Mass = 4 g
  set Rest energy = 1e-7 J
end
subsection Tester
  set Box width = 30 mm
  set Depth = 12 mm
  set Outlet = 18 mm
  set Drop = 24 mm
  set Floor width = 110 mm
end
)";

const char* const small_sieve = R"(
set Experiment = slope screening
subsection Run
  set End time        = 0.5 s
  set Series interval = 20 ms
  set Field interval  = 0
end
subsection Filling
  set Mass = 1.5 g
  set Rest energy = 1e-7 J
end
subsection Screen
  set Width = 20 mm
  set Length = 100 mm
  set Loading length = 20 mm
end
)";

class GranularObservers : public TinyRun {
 protected:
  /// What a user's run of the file leaves in summary.json.
  Summary run_by_hand(const std::string& prm, const std::vector<std::string>& set = {}) {
    std::vector<std::string> all = arguments(set);
    all[0] = prm;
    const RunOutcome result = run_here(all);
    EXPECT_EQ(result.status, exit_done) << result.message;
    return Summary::read(out() / "summary.json");
  }
  static bool has(const std::vector<UsualUncertainty>& all, const std::string& path) {
    return std::any_of(all.begin(), all.end(), [&](const UsualUncertainty& u) { return u.path == path; });
  }
};

TEST_F(GranularObservers, HeapGivesWhatItsRunLeaves) {
  const std::string prm = write("heap.prm", std::string(small_heap) + soft_spheres + rough_contacts);
  const Observer observer = repose_angle_observer();
  EXPECT_EQ(observer.random_entry, "Filling/Random number");
  const PreparedRun run = observer.prepare(prm, {});
  const std::vector<double> values =
      run.observe({{"Filling/Random number", 2}}, {{"angle of repose"}, {"angle left"}, {"angle right"}});
  const Summary summary = run_by_hand(prm, {"Filling/Random number=2"});
  const double degree = M_PI / 180;
  // Written with all digits; the conversion rounds once.
  EXPECT_NEAR(values[0], degree * summary.observable("angle"), 1e-14);
  EXPECT_NEAR(values[1], degree * summary.observable("angle_left"), 1e-14);
  EXPECT_NEAR(values[2], degree * summary.observable("angle_right"), 1e-14);
  EXPECT_NEAR(values[0], 0.5 * (values[1] + values[2]), 1e-14);
  EXPECT_GT(values[0], 5 * degree);
  EXPECT_LT(values[0], 60 * degree);
}

TEST_F(GranularObservers, AHeapOfSlipperySpheresIsFlatter) {
  const std::string prm = write("heap.prm", std::string(small_heap) + soft_spheres + rough_contacts);
  const PreparedRun run = repose_angle_observer().prepare(prm, {});
  const double rough = run.observe({}, {{"angle of repose"}})[0];
  const double smooth = run.observe({{"Contact pairs/seed - seed/Rolling friction", 0},
                                     {"Contact pairs/seed - photosensitive resin/Rolling friction", 0}},
                                    {{"angle of repose"}})[0];
  // Repetitions of so small a heap scatter by 2 to 3 degrees.
  EXPECT_LT(smooth, rough - 0.1);
}

TEST_F(GranularObservers, HeapKnowsWhatIsUncertain) {
  const std::string prm = write("heap.prm", std::string(small_heap) + soft_spheres + rough_contacts);
  const PreparedRun run = repose_angle_observer().prepare(prm, {});
  for (const char* path : {"Seeds/Diameter", "Seeds/Density", "Contact pairs/seed - seed/Static friction",
                           "Contact pairs/seed - photosensitive resin/Static friction",
                           "Contact pairs/seed - transparent plexiglass/Static friction"}) {
    EXPECT_TRUE(has(run.uncertainties, path)) << path;
    EXPECT_GT(run.value(path), 0) << path;
  }
  EXPECT_EQ(run.unit("Seeds/Diameter"), "m");
  // The order in which the materials are named is the user's.
  const std::string sieve = write("sieve.prm", std::string(small_sieve) + soft_spheres);
  const PreparedRun other = slope_screening_observer().prepare(
      sieve, {"Materials/Names=transparent plexiglass, seed", "Screen/Material=transparent plexiglass"});
  EXPECT_TRUE(has(other.uncertainties, "Contact pairs/transparent plexiglass - seed/Static friction"));
}

TEST_F(GranularObservers, SieveGivesWhatItsRunLeaves) {
  const std::string prm = write("sieve.prm", std::string(small_sieve) + soft_spheres);
  const Observer observer = slope_screening_observer();
  EXPECT_EQ(observer.random_entry, "Filling/Random number");
  const PreparedRun run = observer.prepare(prm, {"Screen/Inclination=15 deg"});
  std::vector<WantedValue> wanted = {{"total passing"}, {"over the end"}};
  for (int area = 1; area <= 5; ++area) wanted.push_back({"passing", static_cast<double>(area)});
  const std::vector<double> values = run.observe({}, wanted);
  const Summary summary = run_by_hand(prm, {"Screen/Inclination=15 deg"});
  EXPECT_NEAR(values[0], 0.01 * summary.observable("total_passing"), 1e-14);
  EXPECT_NEAR(values[1], 0.01 * summary.observable("over_the_end"), 1e-14);
  double sum = 0;
  for (int area = 1; area <= 5; ++area) {
    EXPECT_NEAR(values[area + 1], 0.01 * summary.observable("area_" + std::to_string(area)), 1e-14);
    sum += values[area + 1];
  }
  EXPECT_NEAR(sum, values[0], 1e-12);
  EXPECT_GT(values[0], 0.05);
  EXPECT_LE(values[0] + values[1], 1 + 1e-12);
}

TEST_F(GranularObservers, SieveHasFiveAreas) {
  const std::string prm = write("sieve.prm", std::string(small_sieve) + soft_spheres);
  const Observer observer = slope_screening_observer();
  EXPECT_TRUE(has(observer.uncertainties, "Screen/Hole diameter"));
  const PreparedRun run = observer.prepare(prm, {});
  const CoordinateRange areas = run.range("passing");
  EXPECT_EQ(areas.low, 1);
  EXPECT_EQ(areas.high, 5);
  EXPECT_TRUE(areas.whole);
  EXPECT_TRUE(has(run.uncertainties, "Contact pairs/seed - photosensitive resin/Static friction"));
  EXPECT_THROW(observer.prepare(prm, {"Screen/Hole pitch=4 mm"}), InputError);  // before anything runs
}

}  // namespace
}  // namespace seedflow
