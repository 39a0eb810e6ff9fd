#pragma once

#include "seedflow/diagnose/selection.h"

namespace seedflow {

/// Among the possible experiments (those of the problem, or the conditions with one of their entries changed
/// by factors of 1/4 to 4), the one in which the rivals' predictions differ most against noise and uncertain
/// inputs: T-optimality between fitted rivals (Buzzi-Ferraris & Forzatti 1983,
/// doi:10.1016/0009-2509(83)85004-0).
SuggestedExperiment suggest_experiment(const Problem& problem, ObservableModel& model, const DataNoise& noise,
                                       const std::vector<Tried>& tried,
                                       const std::vector<std::size_t>& rivals);

}  // namespace seedflow
