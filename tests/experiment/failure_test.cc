// Computations that fail: status 3; the message says what, where, when and what to do; the state is saved.
#include "tiny_run.h"

namespace seedflow {
namespace {

namespace fs = std::filesystem;

class Failure : public TinyRun {
 protected:
  void expect_failure(const RunOutcome& result, const std::vector<std::string>& parts,
                      bool saved = true) const {
    EXPECT_EQ(result.status, exit_failed) << result.message;
    for (const std::string& part : parts) expect_contains(result.message, part);
    EXPECT_EQ(fs::exists(out() / "failed" / "current"), saved);
    if (saved)
      expect_contains(result.message,
                      "The state at the failure is saved in '" + (out() / "failed").string() + "'.");
    EXPECT_FALSE(fs::exists(out() / "summary.json"));
  }
};

TEST_F(Failure, SolverThatDoesNotConverge) {
  expect_failure(run({"Air/Linear solver/Largest number of iterations=1"}),
                 {"Air, step from t = ", "with dt = 0.001 s", "equation was not solved in 1 iterations."});
}

const char* const nan_inlet =
    "Air/Boundary conditions=bottom: velocity inlet, 0, 0, 0.01*sqrt(0.0035-t); top: pressure outlet, 0; *: "
    "wall";

TEST_F(Failure, AirIsNotFinite) {
  expect_failure(run({nan_inlet}), {"Air, step from t = 0.003 s", "the velocity is not finite.",
                                    "Check that the boundary conditions give numbers at this time"});
}

TEST_F(Failure, SeedIsNotFinite) {
  expect_failure(run({"Air/Model=prescribed", "Air/Prescribed/Velocity z=0.01*sqrt(0.0035-t)",
                      "Coupling/Undisturbed velocity=none"}),
                 {"at t = 0.004", "is negative or not a number."});
}

TEST_F(Failure, SameStatusOnTwoRanks) {
  const ShellResult result = run_program({nan_inlet}, "out", 2);
  expect_failure({result.status, result.err}, {"Air, step from t = 0.003 s"});
}

TEST_F(Failure, VoidFractionBelowItsBound) {
  expect_failure(run({"Air domain/Cells=12, 12, 24", "Coupling/Void fraction kernel=sampled"}),
                 {"The void fraction falls to ", " at t = 0 s, near ",
                  "the lower bound is 0.05 (Coupling/Lowest void fraction).",
                  "Remedy: 'Void fraction kernel = gaussian'"},
                 false);
}

TEST_F(Failure, EffectWithoutEffect) {
  const RunOutcome result = run({"Air/Model=prescribed", "Air/Prescribed/Velocity z=0.01",
                                 "Effects/Saffman lift/Strength=1", "Coupling/Undisturbed velocity=none"});
  EXPECT_EQ(result.status, exit_failed);
  expect_contains(
      result.message,
      "The effect \"Saffman lift\" is switched on but added nothing during the whole run.\nRemedy: ");
}

// Only rank 0 writes; the others must learn of it.
TEST_F(Failure, FullDiskOnTwoRanks) {
  fs::create_directory(out());
  fs::create_symlink("/dev/full", out() / "seeds.csv");
  const ShellResult result = run_program({}, "out", 2);
  EXPECT_EQ(result.status, exit_failed);
  expect_contains(result.err,
                  "Cannot write '" + (out() / "seeds.csv").string() + "': No space left on device.");
  EXPECT_EQ(result.err.find("Rank"), std::string::npos) << result.err;
}

TEST_F(Failure, SavedStateIsKeptApartFromCheckpoints) {
  expect_failure(run({nan_inlet, "Run/Checkpoint interval=1 ms"}), {"Air, step from"});
  EXPECT_TRUE(fs::exists(out() / "checkpoint" / "current"));
  // The checkpoint is sound: it leads to the same failure again.
  expect_failure(run({nan_inlet, "Run/Checkpoint interval=1 ms"}, "out", {"--resume"}),
                 {"Air, step from t = 0.003 s"});
}

}  // namespace
}  // namespace seedflow
