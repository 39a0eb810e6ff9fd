#include "seedflow/diagnose/benchmark_command.h"

#include <cstdlib>
#include <ostream>

#include "seedflow/base/error.h"
#include "seedflow/diagnose/benchmark.h"
#include "seedflow/experiment/bench_report.h"

namespace seedflow {

namespace {

constexpr long standard_draws = 100;

struct Options {
  long draws = standard_draws;
  std::string folder, only;
};

Options read_options(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); i += 2) {
    const bool draws = arguments[i] == "--draws", only = arguments[i] == "--only";
    if (!(draws || only || arguments[i] == "--output") || i + 1 == arguments.size())
      throw InputError("bench diagnose: expected --draws N, --only WORDS or --output DIR, found \"" +
                       arguments[i] + "\".");
    const std::string& value = arguments[i + 1];
    char* end = nullptr;
    if (draws)
      options.draws = std::strtol(value.c_str(), &end, 10);
    else
      (only ? options.only : options.folder) = value;
    if (draws && (value.empty() || *end != 0 || options.draws < 1))
      throw InputError("bench diagnose: --draws \"" + value + "\": expected a whole number of at least 1.");
  }
  return options;
}

int run(const CommandLine& program, const std::vector<std::string>& arguments, std::ostream& out) {
  const Options options = read_options(arguments);
  if (program.rank == 0)
    out << "diagnose: effects hidden in data of an independent generator, " << options.draws
        << " draws of each effect, amplitude and noise" << std::endl;
  const std::vector<BenchResult> results =
      run_diagnosis_benchmark(options.draws, options.only, options.folder, out);
  if (program.rank == 0) write_bench_file(results, "bench.json");
  return exit_done;
}

}  // namespace

Command diagnosis_benchmark_command() {
  return {"bench diagnose", "bench diagnose [--draws N] [--only WORDS] [--output DIR]",
          "how often a hidden effect is named, and how often one is named that is not there", run};
}

}  // namespace seedflow
