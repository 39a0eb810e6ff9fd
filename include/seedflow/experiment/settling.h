#pragma once

#include <string>
#include <vector>

#include "seedflow/experiment/experiment.h"
#include "seedflow/experiment/simulation_parameters.h"
#include "seedflow/output/series.h"
#include "seedflow/output/summary.h"

namespace seedflow {

/// Experiment "settling": one bonded seed falls in a box of fluid (Xu et al. 2024, section 3.2.4).
int run_settling(const RunOptions& options);
void describe_settling(std::ostream& out, const std::string& section);
/// Quantities: velocity over time, terminal velocity.
Observer settling_observer();

/// Adds velocity_0.05s, 0.10, 0.15, 0.20 (where the run got that far), terminal_velocity and what they are
/// compared with; all speeds downward positive [m/s].
void add_settling_observables(const Series& seeds, const SimulationParameters& parameters, Summary& summary);

/// Speed along gravity at the given time, linear between rows [m/s].
double settling_speed(const Series& seeds, const Vec3& gravity, double time);

/// report.html of one run.
void write_settling_report(const Series& seeds, const SimulationParameters& parameters,
                           const Summary& summary, const RunOptions& options);

}  // namespace seedflow
