#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/experiment/experiment.h"

namespace seedflow {

/// name, value, unit, ranks in columns.
void print_bench_table(const std::vector<BenchResult>& results, std::ostream& out);

/// A JSON list of {name, value, unit, ranks}.
void write_bench_file(const std::vector<BenchResult>& results, const std::string& file);

}  // namespace seedflow
