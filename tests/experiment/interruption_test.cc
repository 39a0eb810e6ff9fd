// Runs that are stopped and go on: to the last bit the same as runs that were not.
#include <chrono>
#include <csignal>
#include <thread>

#include "tiny_run.h"

namespace seedflow {
namespace {

namespace fs = std::filesystem;

/// With everything that has a memory: history force, added mass, wall contact material, fields on disk.
const std::vector<std::string> long_run = {"Run/End time=40 ms", "Run/Field interval=10 ms",
                                           "Effects/Added mass/Strength=1",
                                           "Effects/History force/Strength=1"};

std::vector<std::string> with(std::vector<std::string> set, const std::string& more) {
  set.push_back(more);
  return set;
}

class Interruption : public TinyRun {
 protected:
  /// Runs as a program and sends it a signal as soon as seeds.csv has so many lines.
  ShellResult stop(const std::string& signal, int lines, const std::vector<std::string>& set,
                   const std::string& name, int ranks = 1) const {
    const std::string rows = (out(name) / "seeds.csv").string();
    write("stop.sh", command(arguments(set, name), ranks) +
                         " &\npid=$!\n"
                         "for i in $(seq 6000); do\n"
                         "  [ -f " +
                         rows + " ] && [ $(wc -l < " + rows + ") -ge " + std::to_string(lines) +
                         " ] && break\n  kill -0 $pid 2>/dev/null || break\n  sleep 0.005\ndone\n"
                         "kill -" +
                         signal + " $pid\nwait $pid\n");
    return run_in_shell("sh stop.sh", folder);
  }
  void expect_same_results(const std::string& a, const std::string& b) const {
    EXPECT_EQ(read_file(out(a) / "seeds.csv"), read_file(out(b) / "seeds.csv"));
    EXPECT_EQ(read_file(out(a) / "seeds.pvd"), read_file(out(b) / "seeds.pvd"));
    EXPECT_EQ(read_file(out(a) / "air.pvd"), read_file(out(b) / "air.pvd"));
    const Summary left = Summary::read(out(a) / "summary.json"),
                  right = Summary::read(out(b) / "summary.json");
    ASSERT_EQ(left.observables().size(), right.observables().size());
    for (std::size_t i = 0; i < left.observables().size(); ++i) {
      EXPECT_EQ(left.observables()[i].name, right.observables()[i].name);
      EXPECT_EQ(left.observables()[i].value, right.observables()[i].value) << left.observables()[i].name;
    }
    for (std::size_t i = 0; i < left.balances().size(); ++i)
      EXPECT_EQ(left.balances()[i].relative_error, right.balances()[i].relative_error)
          << left.balances()[i].name;
  }
  void expect_stop_and_resume(const std::string& signal, const std::vector<std::string>& set,
                              int ranks) const {
    ASSERT_EQ(run_program(set, "whole", ranks).status, exit_done);
    const ShellResult stopped = stop(signal, 6, set, "stopped", ranks);
    EXPECT_EQ(stopped.status, exit_interrupted) << stopped.err;
    expect_contains(stopped.err,
                    "The checkpoint is written; continue with --resume --output " + out("stopped").string());
    EXPECT_FALSE(fs::exists(out("stopped") / "summary.json"));
    const ShellResult resumed = run_program(set, "stopped", ranks, {"--resume"});
    ASSERT_EQ(resumed.status, exit_done) << resumed.err;
    expect_same_results("whole", "stopped");
  }
};

TEST_F(Interruption, TerminatedRunGoesOnToTheLastBit) {
  expect_stop_and_resume("TERM", long_run, 1);
}

TEST_F(Interruption, LiteralModelInterruptedFromTheKeyboard) {
  std::vector<std::string> set = long_run;
  set.insert(set.end(), literal_model.begin(), literal_model.end());
  expect_stop_and_resume("INT", set, 1);
}

// The launcher passes signals on as SIGUSR1, which mpirun forwards to its processes.
TEST_F(Interruption, TwoRanks) {
  expect_stop_and_resume("USR1", with(long_run, "Seeds motion/Time step=1.5e-6"), 2);
}

TEST_F(Interruption, DuringTheSetUp) {
  const std::vector<std::string> set = {"Seeds/Sub-spheres=164"};
  write("stop.sh", command(arguments(set)) + " &\npid=$!\nfor i in $(seq 6000); do\n  [ -d " +
                       out().string() + " ] && break\n  sleep 0.002\ndone\nkill -TERM $pid\nwait $pid\n");
  const ShellResult stopped = run_in_shell("sh stop.sh", folder);
  EXPECT_EQ(stopped.status, exit_interrupted) << stopped.err;
  expect_contains(stopped.err, "Interrupted at t = 0 s.");
  EXPECT_EQ(run(set, "out", {"--resume"}).status, exit_done);
  EXPECT_EQ(run(set, "whole").status, exit_done);
  EXPECT_EQ(read_file(out() / "seeds.csv"), read_file(out("whole") / "seeds.csv"));
}

TEST_F(Interruption, KilledRunGoesOnFromItsLastCheckpoint) {
  const std::vector<std::string> set = with(long_run, "Run/Checkpoint interval=1 ms");
  ASSERT_EQ(run(set, "whole").status, exit_done);
  EXPECT_EQ(stop("KILL", 8, set, "stopped").status, 128 + SIGKILL);
  const RunOutcome resumed = run(set, "stopped", {"--resume"});
  ASSERT_EQ(resumed.status, exit_done) << resumed.message;
  expect_same_results("whole", "stopped");
}

TEST_F(Interruption, FinishedRunIsContinuedToALaterEnd) {
  ASSERT_EQ(run({"Run/End time=8 ms"}, "parts").status, exit_done);
  ASSERT_EQ(run({"Run/End time=16 ms"}, "parts", {"--resume"}).status, exit_done);
  ASSERT_EQ(run({"Run/End time=16 ms"}, "whole").status, exit_done);
  EXPECT_EQ(read_file(out("parts") / "seeds.csv"), read_file(out("whole") / "seeds.csv"));
  const RunOutcome back = run({"Run/End time=4 ms"}, "parts", {"--resume"});
  EXPECT_EQ(back.status, exit_bad_input);
  expect_contains(back.message, "entry \"End time\" = \"4 ms\": the checkpoint is at 0.016");
  const RunOutcome between = run({"Run/End time=16.5 ms"}, "parts", {"--resume"});
  EXPECT_EQ(between.status, exit_bad_input);
  expect_contains(between.message, "Choose a multiple of the air step");
}

TEST_F(Interruption, OtherParametersAreRefused) {
  ASSERT_EQ(run({}).status, exit_done);
  const auto refused = [&](const std::string& entry, const std::string& change) {
    const RunOutcome result = run({entry}, "out", {"--resume"});
    EXPECT_EQ(result.status, exit_bad_input) << entry;
    expect_contains(result.message,
                    "The run cannot be resumed with other parameters than it was begun with:");
    expect_contains(result.message, change);
    expect_contains(result.message, "Set them back, or start anew in another output folder.");
  };
  refused("Air/Density=900", "Air/Density: 1000 -> 900");
  refused("Run/Air step=0.5 ms", "Run/Air step: 0.001 -> 5e-04");
  refused("Effects/Added mass/Strength=1", "Effects/Added mass/Strength: 0 -> 1");
}

TEST_F(Interruption, ResumingNothing) {
  const RunOutcome none = run({}, "out", {"--resume"});
  EXPECT_EQ(none.status, exit_bad_input);
  expect_contains(none.message, "There is no checkpoint in '" + (out() / "checkpoint").string() +
                                    "' to resume from. Check the output folder, or start without --resume.");
  // A run that is begun anew forgets the states of the one before it.
  ASSERT_EQ(run({}).status, exit_done);
  fs::remove(out() / "seeds.csv");
  fs::create_directory(out() / "seeds.csv");  // stops the new run before its first checkpoint
  EXPECT_EQ(run({}).status, exit_failed);
  fs::remove(out() / "seeds.csv");
  EXPECT_EQ(run({}, "out", {"--resume"}).status, exit_bad_input);
}

TEST_F(Interruption, OtherNumberOfRanks) {
  ASSERT_EQ(run({}).status, exit_done);
  const ShellResult result = run_program({}, "out", 2, {"--resume"});
  EXPECT_EQ(result.status, exit_bad_input);
  expect_contains(result.err, "was written by 1 rank, this run has 2. Resume with --mpi 1.");
}

}  // namespace
}  // namespace seedflow
