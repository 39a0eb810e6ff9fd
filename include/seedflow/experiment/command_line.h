#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/experiment/experiment.h"

namespace seedflow {

struct CommandLine;

/// A word behind `seedflow` and what it does.
struct Command {
  std::string name, usage, description;
  /// Gets the words behind the name; returns an ExitStatus.
  std::function<int(const CommandLine&, const std::vector<std::string>& arguments, std::ostream& out)>
      execute;
};

/// `FILE.prm [--set "Section/Entry=value"]... [--output DIR] [--resume] [--dry-run]` as options of a run. The
/// output folder is output/FILE unless it is given. InputError for an unknown option.
RunOptions read_run_options(const std::vector<std::string>& arguments);

/// What the program can do, as data: tests and the main program give their own tables.
struct CommandLine {
  std::vector<Experiment> experiments = experiment_catalogue();
  std::vector<Bench> benches = bench_catalogue();
  std::vector<Command> commands = {};  ///< of layers to the right, beside the built-in ones
  int rank = 0;                        ///< only rank 0 writes results of commands

  /// Carries out `run FILE [--set "Section/Entry=value"]... [--output DIR] [--resume] [--dry-run]` (`run` may
  /// be left out before a .prm file), `parameters [SECTION]`, `effects [NAME]`, `bench [NAME]` or `help`.
  /// Returns an ExitStatus; throws InputError for an unknown command, option or name, with the nearest valid
  /// one.
  int execute(const std::vector<std::string>& arguments, std::ostream& out) const;
};

}  // namespace seedflow
