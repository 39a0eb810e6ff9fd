#pragma once

#include <functional>

#include "seedflow/experiment/experiment.h"
#include "seedflow/experiment/simulation.h"
#include "seedflow/output/summary.h"

namespace seedflow {

/// Runs a simulation to its end time with all that belongs to a run: used.prm, series and fields, progress,
/// checkpoints, interruption, resumption, balances and rates in the summary. Throws Interrupted after writing
/// a checkpoint, RunError after saving the state of a failed run.
void run_to_end(Simulation& simulation, const Parameters& parameters, const RunOptions& options,
                Summary& summary);

/// Adds the balances of the coupled run, with the limits they are asserted to, to the summary.
void add_conservation(Simulation& simulation, double largest_mass_error, Summary& summary);

}  // namespace seedflow
