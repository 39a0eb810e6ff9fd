#pragma once

#include "seedflow/truth/truth_seed.h"

namespace seedflow {

/// As truth_states(), with the memory of the slip. The seed must start with the flow's velocity (InputError).
std::vector<TruthState> truth_states_with_history(const TruthSeed& seed, const std::vector<double>& times,
                                                  int steps);

}  // namespace seedflow
