#include <cmath>
#include <iostream>
#include <sstream>

#include "seedflow/experiment/command_of.h"
#include "seedflow/experiment/single_seed.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/report.h"
#include "seedflow/output/series.h"
#include "seedflow/output/summary.h"

namespace seedflow {

namespace {

std::vector<double> output_times(const SingleSeedParameters& p) {
  std::vector<double> times;
  const auto n = static_cast<long>(std::floor(p.end_time / p.series_interval * (1 + 1e-12)));
  for (long i = 0; i <= n; ++i) times.push_back(std::min(i * p.series_interval, p.end_time));
  if (times.back() < p.end_time) times.push_back(p.end_time);
  return times;
}

Series series_of(const std::vector<double>& times, const std::vector<SingleSeedSample>& samples) {
  Series s;
  s.columns = {{"time", "s"},         {"position x", "m"},   {"position y", "m"},   {"position z", "m"},
               {"velocity x", "m/s"}, {"velocity y", "m/s"}, {"velocity z", "m/s"}, {"spin x", "rad/s"},
               {"spin y", "rad/s"},   {"spin z", "rad/s"}};
  s.values.resize(s.columns.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    s.values[0].push_back(times[i]);
    for (int d = 0; d < 3; ++d) {
      s.values[1 + d].push_back(samples[i].state.position[d]);
      s.values[4 + d].push_back(samples[i].state.velocity[d]);
      s.values[7 + d].push_back(samples[i].state.angular_velocity[d]);
    }
  }
  return s;
}

void write_report(const SingleSeedParameters& p, const Series& s, const RunOptions& options) {
  Report report("One seed in a prescribed flow", command_of(options), "seedflow");
  std::ostringstream lead;
  lead << "A seed of " << 1e3 * p.seed.diameter << " mm and " << p.seed.density << " kg/m3 in a fluid of "
       << p.density << " kg/m3 and " << p.viscosity << " Pa s.";
  report.lead(lead.str());
  LinePlot plot{"Velocity", {"time", "s"}, {"velocity", "m/s"}};
  for (const char* name : {"velocity x", "velocity y", "velocity z"})
    plot.series.push_back({name, s["time"], s[name]});
  report.add(plot);
  LinePlot path{"Position", {"time", "s"}, {"position", "m"}};
  for (const char* name : {"position x", "position y", "position z"})
    path.series.push_back({name, s["time"], s[name]});
  report.add(path);
  report.write(std::filesystem::path(options.output) / "report.html");
}

}  // namespace

int run_single_seed_experiment(const RunOptions& options) {
  SingleSeedParameters p;
  Parameters parameters;
  p.declare(parameters);
  parameters.read(options.prm, options.overrides);
  p.check(parameters);
  int rank = 0;
  MPI_Comm_rank(options.comm, &rank);
  if (rank != 0) return exit_done;  // one rank has all the work there is
  if (options.dry_run) {
    std::cout << "One seed, " << std::ceil(p.end_time / p.time_step) << " steps of at most " << p.time_step
              << " s: well under a second.\n";
    return exit_done;
  }
  prepare_output_folder(options.output);
  const std::vector<double> times = output_times(p);
  std::vector<std::string> idle;
  const std::vector<SingleSeedSample> samples = run_single_seed(p, times, &idle);
  const Series series = series_of(times, samples);
  const std::filesystem::path folder = options.output;
  write_series(folder / "seeds.csv", series);
  std::ostringstream used;
  parameters.write(used);
  write_file_atomically(folder / "used.prm", used.str());
  Summary summary;
  summary.text("experiment", p.name);
  const SingleSeedSample& last = samples.back();
  const double g = norm(p.gravity);
  summary.observe("terminal_velocity",
                  g > 0 ? dot(last.state.velocity, p.gravity) / g : norm(last.state.velocity), "m/s");
  summary.observe("reynolds_number", reynolds(last.flow), "1");
  summary.performance.peak_memory_MiB = peak_memory_MiB();
  summary.write(folder / "summary.json");
  write_report(p, series, options);
  std::cout << "velocity at the end " << summary.observable("terminal_velocity")
            << " m/s, report: " << (folder / "report.html").string() << std::endl;
  for (const std::string& effect : idle)
    throw RunError("The effect \"" + effect +
                   "\" is switched on but added nothing during the whole run.\nRemedy: set its Strength to "
                   "0, or check its inputs.");
  return exit_done;
}

void describe_single_seed(std::ostream& out, const std::string& section) {
  SingleSeedParameters p;
  Parameters parameters;
  p.declare(parameters);
  parameters.describe(out, section);
}

}  // namespace seedflow
