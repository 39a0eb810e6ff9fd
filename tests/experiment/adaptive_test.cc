// A run on a mesh that follows the seed: it refines where it should, keeps its balances and can be resumed.
#include "tiny_run.h"

namespace seedflow {
namespace {

class Adaptive : public TinyRun {
 protected:
  const std::vector<std::string> follow = {"Air domain/Adaptive refinement/Interval=3",
                                           "Air domain/Adaptive refinement/Highest level=1",
                                           "Air domain/Adaptive refinement/Seed distance=4 mm"};
  std::vector<std::string> until(const std::string& end_time) const {
    std::vector<std::string> set = follow;
    set.push_back("Run/End time=" + end_time);
    return set;
  }
};

TEST_F(Adaptive, ResumeIsTheSameToTheLastBit) {
  ASSERT_EQ(run(until("8 ms"), "parts").status, exit_done);
  ASSERT_EQ(run(until("16 ms"), "parts", {"--resume"}).status, exit_done);
  ASSERT_EQ(run(until("16 ms"), "whole").status, exit_done);
  EXPECT_EQ(read_file(out("parts") / "seeds.csv"), read_file(out("whole") / "seeds.csv"));
}

TEST_F(Adaptive, BalancesHoldAndTheMeshMatters) {
  ASSERT_EQ(run(until("8 ms"), "fine").status, exit_done);  // broken balances end with another status
  ASSERT_EQ(run({"Run/End time=8 ms"}, "coarse").status, exit_done);
  const Summary fine = Summary::read(out("fine") / "summary.json"),
                coarse = Summary::read(out("coarse") / "summary.json");
  const double a = fine.observable("terminal_velocity"), b = coarse.observable("terminal_velocity");
  EXPECT_NE(a, b) << "nothing was refined";
  // The kernel has the seed's width and after 8 ms the drag is a tenth of the net weight: what cells of 2
  // instead of 4 mm change in the air's answer (a fortieth of the drag) stays far below 0.5 %.
  EXPECT_NEAR(a, b, 5e-3 * b);
}

/// The air's momentum before and after the mesh changes: the transfer gives back what interpolation lost.
TEST_F(Adaptive, MomentumIsKeptWhenTheMeshChanges) {
  ASSERT_EQ(run(until("12 ms"), "out").status, exit_done);
  bool found = false;
  const Summary summary = Summary::read(out() / "summary.json");
  for (const auto& balance : summary.balances())
    if (balance.name.find("adapt") != std::string::npos) {
      found = true;
      EXPECT_LT(balance.relative_error, 1e-10) << balance.name;
    }
  EXPECT_TRUE(found);
}

/// Cells in which the void fraction changes are refined: the seed's surroundings, and no others.
TEST_F(Adaptive, VoidFractionDecides) {
  const auto cells = [&](const std::string& jump, const std::string& name) {
    EXPECT_EQ(
        run({"Air domain/Adaptive refinement/Interval=3", "Air domain/Adaptive refinement/Highest level=1",
             "Air domain/Adaptive refinement/Void fraction jump=" + jump, "Run/End time=6 ms"},
            name)
            .status,
        exit_done);
    return Summary::read(out(name) / "summary.json").observable("air_cells");
  };
  const double none = cells("0.9", "none"), some = cells("0.01", "some"), many = cells("0.0002", "many");
  EXPECT_EQ(none, 432);  // 6 x 6 x 12
  EXPECT_GT(some, none);
  // Cells of 4 mm, a Gaussian of s = 4 mm with at most V/(2 pi s^2)^(3/2) = 0.033: its steepest slope, at s
  // from the centre, changes it by 0.033 exp(-1/2) = 0.02 over a cell. Half of that lies within about two
  // cells of the seed.
  EXPECT_LT(some, 432 + 7 * 64);
  EXPECT_GT(many, some);
}

}  // namespace
}  // namespace seedflow
