#include <filesystem>

#include "seedflow/base/error.h"
#include "seedflow/base/units.h"
#include "seedflow/experiment/file_observer.h"
#include "seedflow/experiment/settling.h"
#include "seedflow/output/series.h"
#include "seedflow/output/summary.h"

namespace seedflow {

namespace {

struct Input {
  std::string name = "settling";
  SimulationParameters simulation;
  Parameters parameters;

  explicit Input(const RunOptions& options) {
    declare_experiment_name(parameters, name);
    simulation.declare(parameters);
    parameters.read(options.prm, options.overrides);
    simulation.check(parameters);
  }
};

double value(const std::string& folder, const WantedValue& wanted, const RunOptions& options) {
  if (wanted.quantity == "terminal velocity")
    return Summary::read(std::filesystem::path(folder) / "summary.json").observable("terminal_velocity");
  const Input input(options);
  return settling_speed(read_series(std::filesystem::path(folder) / "seeds.csv"),
                        input.simulation.dem.gravity, wanted.coordinate);
}

}  // namespace

Observer settling_observer() {
  FileObserver files;
  files.run = run_settling;
  files.read = [](const RunOptions& options, const std::function<void(const Parameters&)>& look) {
    const Input input(options);
    look(input.parameters);
  };
  files.observables = {{"velocity", "m/s", "time", "s", "speed along gravity"},
                       {"terminal velocity", "m/s", "", "", "mean over the last twentieth of the run"}};
  files.uncertainties = {{"seed diameter", "Seeds/Diameter", 0.01, true, false},
                         {"seed density", "Seeds/Density", 0.005, true, false},
                         {"fluid viscosity", "Air/Dynamic viscosity", 0.02, true, false},
                         {"drag level", "Effects/Drag/Strength", 0.04, true, false}};
  files.range = [](const Parameters& p, const std::string&) {
    return CoordinateRange{0, to_si(p.value("Run/End time"), "s"), false,
                           "The run ends at Run/End time; raise it in the model, or take the point out."};
  };
  files.value = value;
  files.time_step = "Run/Air step";
  return make_observer(files);
}

}  // namespace seedflow
