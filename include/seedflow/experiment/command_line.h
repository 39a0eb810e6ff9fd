#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/experiment/experiment.h"

namespace seedflow {

/// What the program can do, as data: tests and the main program give their own tables.
struct CommandLine {
  std::vector<Experiment> experiments = experiment_catalogue();
  std::vector<Bench> benches = bench_catalogue();
  int rank = 0;  ///< only rank 0 writes results of commands

  /// Carries out `run FILE [--set "Section/Entry=value"]... [--output DIR] [--resume] [--dry-run]` (`run` may
  /// be left out before a .prm file), `parameters [SECTION]`, `effects [NAME]`, `bench [NAME]` or `help`.
  /// Returns an ExitStatus; throws InputError for an unknown command, option or name, with the nearest valid
  /// one.
  int execute(const std::vector<std::string>& arguments, std::ostream& out) const;
};

}  // namespace seedflow
