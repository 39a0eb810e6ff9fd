#include "seedflow/diagnose/benchmark_command.h"

#include <cstdlib>
#include <ostream>

#include "seedflow/base/error.h"
#include "seedflow/diagnose/benchmark.h"
#include "seedflow/experiment/bench_report.h"

namespace seedflow {

namespace {

constexpr long standard_draws = 100;

long read_draws(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return standard_draws;
  char* end = nullptr;
  const long draws = arguments.size() == 2 ? std::strtol(arguments[1].c_str(), &end, 10) : 0;
  if (arguments.size() != 2 || arguments[0] != "--draws" || *end != 0 || draws < 1)
    throw InputError("bench diagnose: expected nothing or --draws N with N a whole number of at least 1.");
  return draws;
}

int run(const CommandLine& program, const std::vector<std::string>& arguments, std::ostream& out) {
  const long draws = read_draws(arguments);
  if (program.rank == 0)
    out << "diagnose: effects hidden in data of an independent generator, " << draws
        << " draws of each effect, amplitude and noise" << std::endl;
  const std::vector<BenchResult> results = run_diagnosis_benchmark(draws, out);
  if (program.rank == 0) write_bench_file(results, "bench.json");
  return exit_done;
}

}  // namespace

Command diagnosis_benchmark_command() {
  return {"bench diagnose", "bench diagnose [--draws N]",
          "how often a hidden effect is named, and how often one is named that is not there", run};
}

}  // namespace seedflow
