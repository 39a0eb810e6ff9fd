#include "seedflow/experiment/command_line.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "places.h"
#include "seedflow/base/error.h"
#include "shell.h"

namespace seedflow {
namespace {

namespace fs = std::filesystem;

RunOptions seen;  // what the experiment below was asked to do; an experiment is a plain function

int note_options(const RunOptions& options) {
  seen = options;
  return exit_done;
}
void describe_note(std::ostream& out, const std::string& section) {
  if (!section.empty() && section != "Note") throw InputError("section \"" + section + "\" is not known.");
  out << "reference of note " << section << '\n';
}
std::vector<BenchResult> quick() {
  return {{"quick rate", 2.5e7, "1/s", 1}};
}

class CommandLineTest : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("seedflow_command_line_" + std::to_string(::getpid()));
  fs::path before = fs::current_path();
  CommandLine command_line;

  void SetUp() override {
    fs::create_directories(folder);
    fs::current_path(folder);
    std::ofstream("note.prm") << "set Experiment = note\n";
    std::ofstream("unknown.prm") << "# nothing\nset Experiment = notes\n";
    std::ofstream("empty.prm") << "";
    std::ofstream("diagnosis.prm") << "set Model = model.prm\nset Measurements = m.csv\n";
    seen = {};
    command_line.experiments = {{"note", "Notes its options.", note_options, describe_note},
                                {"other", "The same reference.", note_options, describe_note}};
    command_line.benches = {{"quick", "A quick one.", quick}};
  }
  void TearDown() override {
    fs::current_path(before);
    fs::remove_all(folder);
  }
  std::string output(const std::vector<std::string>& arguments) const {
    std::ostringstream out;
    EXPECT_EQ(command_line.execute(arguments, out), exit_done);
    return out.str();
  }
  std::string message(const std::vector<std::string>& arguments) const {
    std::ostringstream out;
    try {
      command_line.execute(arguments, out);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(CommandLineTest, RunPassesItsOptions) {
  output({"run", "note.prm", "--set", "A/B=1", "--set=C=2", "--output", "out", "--resume", "--dry-run"});
  EXPECT_EQ(seen.prm, "note.prm");
  EXPECT_EQ(seen.overrides, (std::vector<std::string>{"A/B=1", "C=2"}));
  EXPECT_EQ(seen.output, "out");
  EXPECT_TRUE(seen.resume);
  EXPECT_TRUE(seen.dry_run);
}

TEST_F(CommandLineTest, RunIsTheCommandOfAParameterFile) {
  output({"note.prm"});
  EXPECT_EQ(seen.prm, "note.prm");
  EXPECT_EQ(seen.output, "output/note");
  EXPECT_FALSE(seen.resume);
  EXPECT_FALSE(seen.dry_run);
}

TEST_F(CommandLineTest, OverridesMayChooseTheExperiment) {
  output({"unknown.prm", "--set", "Experiment=other"});
  EXPECT_EQ(seen.prm, "unknown.prm");
}

TEST_F(CommandLineTest, UnknownExperiment) {
  EXPECT_EQ(
      message({"unknown.prm"}),
      "unknown.prm:2: entry \"Experiment\" = \"notes\" is not known. Nearest valid experiment: \"note\".");
  EXPECT_EQ(message({"empty.prm"}),
            "empty.prm: the entry \"Experiment\" is missing. Add a line `set Experiment = NAME`. Valid "
            "experiments: "
            "\"note\", \"other\".");
  EXPECT_EQ(message({"run", "diagnosis.prm"}),
            "diagnosis.prm: this is the file of a diagnosis, which is made with\n"
            "  ./seedflow diagnose diagnosis.prm");
}

TEST_F(CommandLineTest, UnknownCommandAndOption) {
  EXPECT_EQ(message({"rum"}), "command \"rum\" is not known. Nearest valid command: \"run\".");
  EXPECT_EQ(message({"tset"}), "command \"tset\" is not known. Nearest valid command: \"test\".");
  EXPECT_EQ(message({"test"}), "\"test\" is a command of the launcher: ./seedflow test.");
  EXPECT_EQ(message({"run", "note.prm", "--ouput", "x"}),
            "option --ouput is not known. Nearest valid option: \"--output\".");
  EXPECT_EQ(message({"run"}), "run needs a parameter file, as in: run prm/settling.prm.");
  EXPECT_EQ(message({"run", "note.prm", "--output"}), "--output needs a value, as in --output output/trial.");
  EXPECT_EQ(message({"run", "note.prm", "--resume=yes"}), "--resume takes no value.");
  EXPECT_EQ(
      message({"run", "note.prm", "empty.prm"}),
      "\"empty.prm\": there is one parameter file per run already, \"note.prm\". Options begin with --.");
  EXPECT_EQ(message({"missing.prm"}),
            "missing.prm: this file cannot be opened. Check its name and that it can be read.");
  EXPECT_EQ(message({"run", "note.prm", "--set", "Experiment"}),
            "--set \"Experiment\": has no name or no '='; write --set \"Section/Entry=value\".");
}

TEST_F(CommandLineTest, CommonReferenceIsWrittenOnce) {
  EXPECT_EQ(output({"parameters"}), "Experiment = note, other\n\nreference of note \n");
  EXPECT_EQ(output({"parameters", "Note"}), "Experiment = note, other\n\nreference of note Note\n");
  EXPECT_EQ(message({"parameters", "Nota"}), "section \"Nota\" is not known.");
  EXPECT_NE(message({"parameters", "A", "B"}).find("one name at most"), std::string::npos);
}

TEST_F(CommandLineTest, BenchWritesItsResults) {
  EXPECT_NE(output({"bench", "quick"}).find("quick rate"), std::string::npos);
  std::ifstream in("bench.json");
  const auto list = nlohmann::json::parse(in);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["name"], "quick rate");
  EXPECT_EQ(list[0]["value"], 2.5e7);
  EXPECT_EQ(list[0]["unit"], "1/s");
  EXPECT_EQ(list[0]["ranks"], 1);
  EXPECT_EQ(message({"bench", "quik"}),
            "benchmark \"quik\" is not known. Nearest valid benchmark: \"quick\".");
  EXPECT_EQ(message({"bench", "quick", "--output", "there"}),
            "option --output is not known; bench has none.");
}

TEST_F(CommandLineTest, EffectsAreListed) {
  EXPECT_FALSE(output({"effects"}).empty());
  EXPECT_NE(message({"effects", "no such effect"}), "no error");
}

TEST_F(CommandLineTest, OnlyRankZeroWrites) {
  command_line.rank = 1;
  EXPECT_EQ(output({"parameters"}) + output({"effects"}) + output({"bench"}) + output({"help"}), "");
}

// The program itself, as a user runs it: exit status, and messages on stderr alone.
TEST_F(CommandLineTest, ProgramReturnsItsStatus) {
  const std::string program = places::main_program;
  const ShellResult help = run_in_shell(program + " --help", folder);
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.out.find("run FILE.prm"), std::string::npos);
  EXPECT_EQ(help.err, "");

  const ShellResult unknown = run_in_shell(program + " efects", folder);
  EXPECT_EQ(unknown.status, 2);
  EXPECT_EQ(unknown.err, "command \"efects\" is not known. Nearest valid command: \"effects\".\n");
  EXPECT_EQ(unknown.out, "");

  const ShellResult missing = run_in_shell(program + " run missing.prm", folder);
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.err,
            "missing.prm: this file cannot be opened. Check its name and that it can be read.\n");
}

TEST_F(CommandLineTest, ProgramOnTwoRanksSpeaksOnce) {
  const ShellResult result =
      run_in_shell(std::string(places::mpiexec) + " --allow-run-as-root --oversubscribe -q -n 2 " +
                       places::main_program + " run missing.prm",
                   folder);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "missing.prm: this file cannot be opened. Check its name and that it can be read.\n");
}

}  // namespace
}  // namespace seedflow
