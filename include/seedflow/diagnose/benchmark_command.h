#pragma once

#include "seedflow/experiment/command_line.h"

namespace seedflow {

/// `bench diagnose [--draws N]`: the hidden-effect benchmark, see benchmark.h; its table, and bench.json.
Command diagnosis_benchmark_command();

}  // namespace seedflow
