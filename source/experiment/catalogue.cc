#include "seedflow/base/parameters.h"
#include "seedflow/experiment/experiment.h"

namespace seedflow {

std::vector<Experiment> experiment_catalogue() {
  return {};
}

std::vector<Bench> bench_catalogue() {
  return {};
}

void declare_experiment_name(Parameters& parameters, std::string& name) {
  std::vector<std::string> names;
  for (const Experiment& experiment : experiment_catalogue()) names.push_back(experiment.name);
  parameters.choice("Experiment", name, names, "What is run.");
}

}  // namespace seedflow
