#pragma once

#include <gtest/gtest.h>
#include <mpi.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "places.h"
#include "seedflow/base/error.h"
#include "seedflow/experiment/agreement.h"
#include "seedflow/experiment/command_line.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/series.h"
#include "seedflow/output/summary.h"
#include "shell.h"

namespace seedflow {

/// A settling run that takes a fraction of a second: a seed of 36 sub-spheres, 432 cells, ten air steps.
inline const char* const tiny_settling = R"(
set Experiment = settling
subsection Run
  set End time       = 10 ms
  set Air step       = 1 ms
  set Field interval = 0
end
subsection Air domain
  set Upper corner = 24 mm, 24 mm, 48 mm
  set Cells        = 6, 6, 12
end
subsection Air
  set Density           = 1000 kg/m3
  set Dynamic viscosity = 0.01 Pa s
end
subsection Seeds
  set Sub-spheres = 36
  set Position    = 11 mm, 13 mm, 30 mm
end
)";

/// The paper's literal model (Eqs. 5-8) in place of the default coupling.
inline const std::vector<std::string> literal_model = {
    "Coupling/Drag on=sub-sphere",           "Coupling/Exchange kernel=cell",
    "Coupling/Void fraction kernel=sampled", "Coupling/Solid volume=sub-spheres",
    "Coupling/Undisturbed velocity=none",    "Effects/Drag/Law=As printed"};

/// What a run in this process gave: what the program would return to the shell and write to stderr.
struct RunOutcome {
  int status = -1;
  std::string message;
};

/// A folder with the tiny run in tiny.prm; runs in this process, or as a program on some ranks.
class TinyRun : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "seedflow_run_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder = name;
    write("tiny.prm", tiny_settling);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return (folder / name).string();
  }
  std::filesystem::path out(const std::string& name = "out") const { return folder / name; }

  /// Arguments of the program: tiny.prm into `name`, with entries set.
  std::vector<std::string> arguments(const std::vector<std::string>& set, const std::string& name = "out",
                                     const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {(folder / "tiny.prm").string(), "--output", out(name).string()};
    for (const std::string& entry : set) all.insert(all.end(), {"--set", entry});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// As source/main.cc does it.
  RunOutcome run_here(const std::vector<std::string>& args) const {
    std::ostringstream errors, said;
    std::streambuf* const before = std::cout.rdbuf(said.rdbuf());
    const int status = run_in_agreement(
        MPI_COMM_WORLD, [&] { return CommandLine().execute(args, said); }, errors);
    std::cout.rdbuf(before);
    return {status, errors.str()};
  }
  RunOutcome run(const std::vector<std::string>& set, const std::string& name = "out",
                 const std::vector<std::string>& more = {}) const {
    return run_here(arguments(set, name, more));
  }

  static std::string command(const std::vector<std::string>& args, int ranks = 1) {
    std::string line = places::main_program;
    if (ranks > 1)
      line = std::string(places::mpiexec) + " --allow-run-as-root --oversubscribe --bind-to none -q -n " +
             std::to_string(ranks) + " " + line;
    for (const std::string& a : args) line += " '" + a + "'";
    return line;
  }
  ShellResult run_program(const std::vector<std::string>& set, const std::string& name = "out", int ranks = 1,
                          const std::vector<std::string>& more = {}) const {
    return run_in_shell(command(arguments(set, name, more), ranks), folder);
  }

  /// Bad input: status 2, and the message is (or contains) this.
  void expect_bad_input(const std::vector<std::string>& set, const std::string& message) const {
    const RunOutcome result = run(set);
    EXPECT_EQ(result.status, exit_bad_input) << message;
    EXPECT_NE(result.message.find(message), std::string::npos) << result.message << "\n does not contain\n"
                                                               << message;
    EXPECT_FALSE(std::filesystem::exists(out() / "summary.json"));
  }

  static void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text << "\n does not contain\n" << part;
  }

  std::filesystem::path folder;
};

}  // namespace seedflow
