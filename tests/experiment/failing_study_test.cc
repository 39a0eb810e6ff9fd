// What a study of beds does with its runs; the runs themselves are made up.
#include "seedflow/experiment/granular_study.h"

#include "tiny_run.h"

namespace seedflow {
namespace {

constexpr double angle_of_finished = 20;

int fails_for_36(const RunOptions& options) {
  for (const std::string& entry : options.overrides)
    if (entry == "Seeds/Sub-spheres=36") throw RunError("The heap has rolled away.");
  std::filesystem::create_directories(options.output);
  Summary summary;
  summary.observe("angle", angle_of_finished, "deg");
  summary.write(std::filesystem::path(options.output) / "summary.json");
  return exit_done;
}
int always_fails(const RunOptions&) {
  throw RunError("The heap has rolled away.");
}
std::string no_text(const RunOptions&) {
  return "";
}

class FailingStudy : public TinyRun {
 protected:
  RunOptions options() const {
    RunOptions o;
    o.prm = (folder / "tiny.prm").string();
    o.output = out().string();
    return o;
  }
  static GranularStudyParameters two_models() {
    GranularStudyParameters study;
    study.models = {36, 70};
    study.repeats = 1;
    return study;
  }
};

TEST_F(FailingStudy, GoesOnAndReportsIt) {
  const RunOptions o = options();
  GranularStudy study(two_models(), o, "repose angle", fails_for_36, no_text);
  ASSERT_TRUE(study.carry_out());
  ASSERT_EQ(study.cases().size(), 1u);
  const StudyTable table = study.table({"angle"});
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].of.n_spheres, 70);
  EXPECT_EQ(table.rows[0].mean.at("angle"), angle_of_finished);
  Report report("Study", "", "");
  try {
    study.finish(report, table);
    ADD_FAILURE() << "a failed run must show in the exit status";
  } catch (const RunError& error) {
    expect_contains(error.what(), "1 of 2 runs");
    expect_contains(error.what(), "N36_rigid_radius_1: The heap has rolled away.");
  }
  expect_contains(read_file(out() / "report.html"), "The heap has rolled away.");
  EXPECT_TRUE(std::filesystem::exists(out() / "study.csv"));
}

TEST_F(FailingStudy, WithoutAnyResultFails) {
  const RunOptions o = options();
  GranularStudy study(two_models(), o, "repose angle", always_fails, no_text);
  EXPECT_THROW(study.carry_out(), RunError);
}

}  // namespace
}  // namespace seedflow
