#pragma once

#include <mpi.h>

#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/experiment/observation.h"

namespace seedflow {

class Parameters;

/// What the command line asks of a run.
struct RunOptions {
  std::string prm;                     ///< the parameter file
  std::vector<std::string> overrides;  ///< "Section/Entry=value", see Parameters::read
  std::string output;                  ///< folder of the results
  bool resume = false;                 ///< continue from the checkpoint in the output folder
  bool dry_run = false;                ///< check everything, say what the run will be, compute nothing
  MPI_Comm comm = MPI_COMM_WORLD;      ///< the processes that share the run
};

/// One kind of run, chosen by the top-level entry `Experiment` of the parameter file.
struct Experiment {
  std::string name;
  std::string description;  ///< one line
  /// Returns an ExitStatus. Throws InputError, RunError or Interrupted.
  int (*run)(const RunOptions&);
  /// Writes the reference of its parameters, see Parameters::describe.
  void (*describe)(std::ostream&, const std::string& section);
  /// How it serves as a model of measurements; null if it does not.
  Observer (*observer)() = nullptr;
  /// Writes walls and air mesh as files to start from, into the output folder, and says so; null if the
  /// experiment has none.
  int (*geometry)(const RunOptions&) = nullptr;
};

/// All experiments.
std::vector<Experiment> experiment_catalogue();

/// Declares the top-level entry that names the experiment; every experiment calls it first.
void declare_experiment_name(Parameters& parameters, std::string& name);

/// A measured quantity of a benchmark.
struct BenchResult {
  std::string name;
  double value = 0;
  std::string unit;
  int ranks = 1;
};

struct Bench {
  std::string name;
  std::string description;  ///< one line
  std::vector<BenchResult> (*run)();
};

/// All benchmarks.
std::vector<Bench> bench_catalogue();

}  // namespace seedflow
