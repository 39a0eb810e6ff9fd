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
  EXPECT_NEAR(a, b, 0.05 * b);  // the kernel has the seed's width, so the mesh may change little
}

}  // namespace
}  // namespace seedflow
