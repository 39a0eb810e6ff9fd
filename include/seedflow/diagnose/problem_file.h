#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/base/parameters.h"
#include "seedflow/diagnose/diagnosis.h"
#include "seedflow/diagnose/run_store.h"

namespace seedflow {

/// The parameter file of a diagnosis.
struct ProblemFile {
  std::string model, measurements, conditions, possible_experiments;
  std::vector<std::string> candidates, nuisances;
  std::string other_builds = "ignore";
  int runs = 100000, largest_names = 3, repeats = 3;

  void declare(Parameters& parameters);
};

/// Reads a file and what it names. Overrides of entries of the diagnosis itself (without a '/') go to it, all
/// others to the model. Errors: InputError.
Problem read_problem(const std::string& file, const std::vector<std::string>& overrides);

/// What the file wants with finished runs that another build of the program made.
OtherBuilds read_other_builds(const std::string& file, const std::vector<std::string>& overrides);

/// "Seeds/Diameter +- 1 %", "Seeds/Release time +- 1 ms each" (each: every condition has an error of its
/// own). Errors: InputError.
Nuisance read_nuisance(const std::string& text);

void describe_problem_file(std::ostream& out);

}  // namespace seedflow
