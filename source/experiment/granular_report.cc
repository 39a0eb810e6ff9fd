#include "seedflow/experiment/granular_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>

#include "seedflow/base/together.h"
#include "seedflow/output/summary_tables.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

/// The largest of a column of series.csv.
double largest(const Series& series, const std::string& column) {
  return *std::max_element(series[column].begin(), series[column].end());
}

void add_contacts(const Series& series, Summary& summary) {
  summary.observe("largest_overlap", largest(series, "largest overlap"), "1");
  summary.observe("neighbours_per_seed", series["neighbours per seed"].back(), "1");
  summary.observe("contacts_per_pair", series["contacts per pair"].back(), "1");
}

}  // namespace

const RunOptions& GranularJob::prepared(const RunOptions& options) {
  if (!options.dry_run) prepare_output_folder(options.output);
  return options;
}

GranularJob::GranularJob(const Parameters&, const RunOptions& run_options, const GranularParameters& granular,
                         const GranularScene& scene)
    : signals(run_options.comm),
      options(prepared(run_options)),
      writes(rank_of(run_options.comm) == 0),
      run(granular, scene, run_options.comm) {}

int GranularJob::say_what_it_will_be() const {
  if (writes) std::cout << run.describe() << std::flush;
  return exit_done;
}

int GranularJob::finish(Summary& summary, const std::function<void()>& write_files) const {
  together(options.comm, [&] {
    if (!writes) return;
    add_contacts(read_series(std::filesystem::path(options.output) / "series.csv"), summary);
    write_files();
    // Last: a folder with a summary holds a finished run.
    summary.write(std::filesystem::path(options.output) / "summary.json");
    std::cout << "report: " << (std::filesystem::path(options.output) / "report.html").string() << std::endl;
  });
  summary.require_conservation();
  run.require_action();
  return exit_done;
}

std::string seeds_in_words(const GranularRun& run, const GranularParameters& granular) {
  const int n = granular.model.n_spheres;
  return std::to_string(run.n_seeds_at_start()) + " seeds of " +
         printed_number(1e3 * granular.model.diameter) + " mm (" +
         (n == 1 ? "plain spheres"
                 : std::to_string(n) + " sub-spheres each, " + (granular.rigid ? "rigid" : "bonded")) +
         ")";
}

LinePlot energy_plot(const Series& series, int n_seeds) {
  LinePlot plot{"Kinetic energy per seed", {"time", "s"}, {"kinetic energy", "J", true}};
  LineSeries curve{"this run", {}, {}};
  for (std::size_t i = 0; i < series.n_rows(); ++i) {
    const double energy = series["kinetic energy"][i] / n_seeds;
    curve.x.push_back(series["time"][i]);
    curve.y.push_back(energy > 0 ? energy : std::numeric_limits<double>::quiet_NaN());
  }
  plot.series.push_back(curve);
  plot.caption = "Translation and rotation; 1e-9 J is a seed of 4 mm at 7 mm/s.";
  return plot;
}

void add_numbers(const Summary& summary, Report& report) {
  for (const auto& [name, words] : summary.texts())
    if (name == "notice") report.paragraph(words);
  report.paragraph(
      "The largest overlap of a contact was " + fixed(100 * summary.observable("largest_overlap"), 1) +
      " % of a sub-sphere's radius, looked up whenever a row of `series.csv` was written; at the end a "
      "seed touched " +
      fixed(summary.observable("neighbours_per_seed"), 1) +
      " seeds and walls, and two touching seeds met in " + fixed(summary.observable("contacts_per_pair"), 1) +
      " sub-sphere contacts.");
  add_summary_tables(summary, report);
  report.paragraph(
      "`series.csv` has the course in time; `seeds.pvd` opens in ParaView (show as Point Gaussian, scaled by "
      "radius, coloured by group) together with `walls.vtp` and `moving_walls.pvd`; `summary.json` has these "
      "numbers for programs.");
}

std::string fixed(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

}  // namespace seedflow
