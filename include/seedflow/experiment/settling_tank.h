#pragma once

#include "seedflow/experiment/experiment.h"

namespace seedflow {

/// Experiment "settling tank": the same run under several conditions, its settling speed beside measured ones
/// (ten Cate et al. 2002). The walls and the floor act through the resolved flow.
int run_settling_tank(const RunOptions& options);
void describe_settling_tank(std::ostream& out, const std::string& section);

}  // namespace seedflow
