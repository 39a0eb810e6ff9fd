#pragma once

#include <array>
#include <string>
#include <vector>

#include "seedflow/experiment/experiment.h"
#include "seedflow/experiment/simulation_parameters.h"

namespace seedflow {

/// Section "Study": which variants of the settling run are made. Every combination is one run.
struct SettlingStudyParameters {
  std::vector<double> models{36, 50, 70, 109, 164};  ///< numbers of sub-spheres
  std::vector<std::string> readings{"radius", "diameter"};
  std::vector<std::string> drag{"sub-sphere", "seed"};
  std::vector<std::string> buoyancy{"seed", "sub-spheres", "none"};  ///< of the sub-sphere (literal) runs
  std::vector<std::string> places{"edge", "centre"};
  bool cost = true;  ///< also time a single sphere of 0.3 mm (Fig. 20)

  void declare(Parameters& parameters);
};

/// One run of the study.
struct SettlingCase {
  int n_sub_spheres = 70;
  std::string reading, drag_on, buoyancy, place;
  std::string name() const;  ///< also the name of its file
};

/// What one run gave.
struct SettlingResult {
  SettlingCase setting;
  std::vector<double> time, speed;  ///< [s], [m/s] downwards
  std::array<double, 4> at{};       ///< speeds at the times of Table 5 [m/s]
  double seconds = 0;               ///< wall time of the coupled steps [s]
  double largest_mass_error = 0, total_momentum_error = 0;
};

/// Experiment "settling study": the five models of Table 2 x readings of its sizes x what is dragged x
/// buoyancy x place in the grid, in one table and one report. A finished run is kept in <output>/runs and not
/// repeated by --resume.
int run_settling_study(const RunOptions& options);
void describe_settling_study(std::ostream& out, const std::string& section);

/// The variant's parameters from the base parameters. Sub-sphere drag is the paper's literal model (Eqs. 5-8:
/// cell kernel, sampled void fraction of the sub-spheres' volume, no correction); seed drag keeps the base's
/// coupling.
void apply(const SettlingCase& setting, SimulationParameters& parameters);

/// Runs one case from rest to the end time of the parameters. Collective.
SettlingResult run_settling_case(const SettlingCase& setting, SimulationParameters& parameters,
                                 MPI_Comm comm);

/// settling_study.csv and report.html.
void write_settling_study(const std::vector<SettlingResult>& results, double single_sphere_seconds,
                          const SimulationParameters& base, const RunOptions& options);

}  // namespace seedflow
