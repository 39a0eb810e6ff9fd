#include "seedflow/experiment/settling_tank.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>

#include "seedflow/base/interrupt.h"
#include "seedflow/experiment/command_of.h"
#include "seedflow/experiment/measurements.h"
#include "seedflow/experiment/run_loop.h"
#include "seedflow/experiment/settling.h"
#include "seedflow/experiment/settling_reference.h"
#include "seedflow/output/checkpoint.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/report.h"

namespace seedflow {

namespace {

struct TankInput {
  std::string name = "settling tank";
  std::string measurements, conditions;
  double near_floor = 1.0;
  SimulationParameters simulation;

  void declare(Parameters& p) {
    declare_experiment_name(p, name);
    {
      const auto section = p.section("Comparison", "Measured data and the conditions they were taken under.");
      p.file("Measurements", measurements,
             "CSV: condition,quantity,unit,coordinate,coordinate_unit,value,"
             "standard_uncertainty. The quantity is `velocity` (downward, m/s) over time (s).");
      p.file("Conditions", conditions, "CSV: condition,held_out, and one column per entry that differs.");
      p.number("Near floor", near_floor, "1", Range::non_negative(),
               "Gap between sphere and floor, in diameters, below which values count as 'near the floor'.");
    }
    simulation.declare(p);
  }
};

/// How one condition compares with its measurements.
struct Comparison {
  std::string name;
  Series seeds;
  std::vector<double> time, measured, simulated;
  double wide_vessel = 0;  ///< terminal speed without walls [m/s]
  double peak_measured = 0, peak_simulated = 0;
  double rms = 0, rms_near_floor = 0;  ///< relative to the measured peak
};

double rms(const std::vector<double>& a) {
  double sum = 0;
  for (const double x : a) sum += x * x;
  return a.empty() ? 0.0 : std::sqrt(sum / a.size());
}

Comparison compare(const Condition& condition, const std::vector<Measurement>& data, const Series& seeds,
                   const TankInput& input) {
  Comparison c;
  c.name = condition.name;
  c.seeds = seeds;
  const SimulationParameters& p = input.simulation;
  c.wide_vessel = settling_reference::sphere_speed(p);
  std::vector<double> away, near;
  for (const Measurement& m : data) {
    if (m.condition != condition.name) continue;
    const double v = settling_speed(seeds, p.dem.gravity, m.coordinate);
    if (!std::isfinite(v)) continue;
    c.time.push_back(m.coordinate);
    c.measured.push_back(m.value);
    c.simulated.push_back(v);
    c.peak_measured = std::max(c.peak_measured, m.value);
  }
  const auto &t = seeds["time"], &z = seeds["position z"];
  for (std::size_t i = 0; i < t.size(); ++i)
    c.peak_simulated = std::max(c.peak_simulated, settling_speed(seeds, p.dem.gravity, t[i]));
  for (std::size_t i = 0; i < c.time.size(); ++i) {
    const auto row = std::lower_bound(t.begin(), t.end(), c.time[i]) - t.begin();
    const double gap =
        z[std::min<std::size_t>(row, z.size() - 1)] - p.domain.lower.z - 0.5 * p.seeds.model.diameter;
    (gap < input.near_floor * p.seeds.model.diameter ? near : away).push_back(c.simulated[i] - c.measured[i]);
  }
  c.rms = rms(away) / c.peak_measured;
  c.rms_near_floor = rms(near) / c.peak_measured;
  return c;
}

void write_report(const std::vector<Comparison>& all, const RunOptions& options) {
  Report report("A sphere settling in a closed tank", command_of(options), "seedflow");
  report.lead(
      "A 15 mm sphere in silicone oil at four Reynolds numbers, beside the measurements of ten Cate et al. "
      "(2002). Walls and floor act through the flow that is computed in the tank.");
  double worst = 0;
  for (const Comparison& c : all) worst = std::max(worst, c.rms);
  std::ostringstream verdict;
  verdict.precision(3);
  verdict << "Away from the floor the speed is within " << 100 * worst
          << " % (rms, of the peak) of the measured one at all Reynolds numbers.";
  report.verdict(worst < 0.05 ? Report::Verdict::agrees : Report::Verdict::doubtful, verdict.str());
  LinePlot plot{"Settling speed", {"time", "s"}, {"speed", "m/s", false, 0.0}};
  int style = 0;
  for (const Comparison& c : all) {
    std::vector<double> speed;
    for (const double z : c.seeds["velocity z"]) speed.push_back(-z);
    LineSeries line{c.name, c.seeds["time"], speed};
    line.style = style;
    LineSeries points{c.name + " measured", c.time, c.measured};
    points.draw = LineSeries::Draw::markers;
    points.style = style++;
    plot.series.push_back(line);
    plot.series.push_back(points);
  }
  plot.caption = "Lines: computed. Markers: measured (digitised; systematic uncertainty 1e-3 m/s).";
  report.add(plot);
  Table table{
      "Comparison",
      {"condition", "peak measured [m/s]", "peak computed [m/s]", "ratio", "measured peak / wide vessel",
       "computed peak / wide vessel", "rms away from the floor [% of peak]", "rms near the floor [%]"}};
  for (const Comparison& c : all)
    table.rows.push_back({c.name, Table::number(c.peak_measured), Table::number(c.peak_simulated),
                          Table::number(c.peak_simulated / c.peak_measured),
                          Table::number(c.peak_measured / c.wide_vessel),
                          Table::number(c.peak_simulated / c.wide_vessel), Table::number(100 * c.rms, 3),
                          Table::number(100 * c.rms_near_floor, 3)});
  report.add(table);
  report.paragraph(
      "The film between sphere and floor is thinner than the exchange kernel at the end, so the last "
      "diameter before the floor is outside what this model resolves.");
  report.write(std::filesystem::path(options.output) / "report.html");
}

/// One condition ready to run. Bound to its Parameters, so it must not move.
struct TankCase {
  TankCase(const Condition& c, const std::string& conditions_file, const RunOptions& all)
      : condition(c), options(all) {
    input.declare(parameters);
    std::vector<std::string> overrides = condition.overrides;
    overrides.insert(overrides.end(), all.overrides.begin(), all.overrides.end());
    try {
      parameters.read(all.prm, overrides);
      input.simulation.check(parameters);
    } catch (const InputError& error) {
      throw InputError(conditions_file + ", condition \"" + condition.name + "\": " + error.what());
    }
    options.output = (std::filesystem::path(all.output) / condition.name).string();
  }
  TankCase(const TankCase&) = delete;
  TankCase& operator=(const TankCase&) = delete;

  Condition condition;
  RunOptions options;
  TankInput input;
  Parameters parameters;
};

/// Every measured value is one this experiment produces, under a condition that exists, and every condition
/// was measured.
void require_conditions(const std::vector<Measurement>& data, const std::vector<Condition>& conditions,
                        const TankInput& base) {
  for (const Measurement& m : data) {
    const std::string where = base.measurements + ":" + std::to_string(m.line) + ": ";
    if (m.quantity != "velocity" || m.unit != "m/s" || m.coordinate_unit != "s")
      throw InputError(where + "this experiment produces the quantity velocity [m/s] over time [s], not " +
                       m.quantity + " [" + m.unit + "] over [" + m.coordinate_unit + "].");
    if (!(m.coordinate >= 0))
      throw InputError(where + "a velocity needs its time as coordinate, in s after the release.");
    if (std::none_of(conditions.begin(), conditions.end(),
                     [&](const Condition& c) { return c.name == m.condition; }))
      throw InputError(where + "there is no condition \"" + m.condition + "\" in " + base.conditions + ".");
  }
  for (const Condition& c : conditions)
    if (std::none_of(data.begin(), data.end(), [&](const Measurement& m) { return m.condition == c.name; }))
      throw InputError(base.conditions + ": nothing was measured under the condition \"" + c.name + "\"; " +
                       base.measurements + " does not name it. Remove it or add its measurements.");
}

void require_within_run(const std::vector<Measurement>& data, const TankInput& input,
                        const std::string& condition, const std::string& file) {
  const double end = input.simulation.run.end_time;
  for (const Measurement& m : data)
    if (m.condition == condition && m.coordinate > end * (1 + 1e-9))
      throw InputError(file + ":" + std::to_string(m.line) + ": measured at " + std::to_string(m.coordinate) +
                       " s, but the run of this condition ends at " + std::to_string(end) +
                       " s. Raise Run/End time or remove the point.");
}

}  // namespace

int run_settling_tank(const RunOptions& options) {
  const MPI_Comm comm = options.comm;
  const bool writes = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
  TankInput base;
  Parameters base_parameters;
  base.declare(base_parameters);
  base_parameters.read(options.prm, options.overrides);
  const std::vector<Measurement> data = read_measurements(base.measurements);
  const std::vector<Condition> conditions = read_conditions(base.conditions);
  require_conditions(data, conditions, base);

  // All conditions are checked before the first one runs.
  const InterruptGuard signals(comm);
  std::vector<std::unique_ptr<TankCase>> cases;
  bool begun = false;
  for (const Condition& condition : conditions) {
    cases.push_back(std::make_unique<TankCase>(condition, base.conditions, options));
    TankCase& one = *cases.back();
    require_within_run(data, one.input, condition.name, base.measurements);
    const Simulation check(one.input.simulation, comm);
    if (options.dry_run && writes) std::cout << condition.name << "\n" << check.describe() << std::endl;
    begun = begun || checkpoint_exists(std::filesystem::path(one.options.output) / "checkpoint");
  }
  if (options.dry_run) return exit_done;
  if (options.resume && !begun)
    throw InputError("There is no checkpoint in '" + options.output +
                     "' to resume from. Check the output folder, or start without --resume.");

  Summary summary;
  summary.text("experiment", base.name);
  std::vector<Comparison> comparisons;
  Summary::Performance total;
  for (const auto& one : cases) {
    prepare_output_folder(one->options.output);
    one->options.resume =
        options.resume && checkpoint_exists(std::filesystem::path(one->options.output) / "checkpoint");
    Simulation simulation(one->input.simulation, comm);
    Summary part;
    run_to_end(simulation, one->parameters, one->options, part);
    for (const auto& b : part.balances())
      summary.conserve(one->condition.name + ": " + b.name, b.relative_error, b.limit);
    total.wall_time_s += part.performance.wall_time_s;
    total.peak_memory_MiB = std::max(total.peak_memory_MiB, part.performance.peak_memory_MiB);
    total.cell_steps_per_second_per_core = part.performance.cell_steps_per_second_per_core;
    total.sub_sphere_steps_per_second_per_core = part.performance.sub_sphere_steps_per_second_per_core;
    if (!writes) continue;
    comparisons.push_back(compare(one->condition, data,
                                  read_series(std::filesystem::path(one->options.output) / "seeds.csv"),
                                  one->input));
    const Comparison& c = comparisons.back();
    summary.observe(c.name + ": peak velocity", c.peak_simulated, "m/s");
    summary.observe(c.name + ": measured peak velocity", c.peak_measured, "m/s");
    summary.observe(c.name + ": rms difference / peak, away from the floor", c.rms, "1");
    summary.observe(c.name + ": rms difference / peak, near the floor", c.rms_near_floor, "1");
  }
  summary.performance = total;
  if (writes) {
    summary.write(std::filesystem::path(options.output) / "summary.json");
    write_report(comparisons, options);
  }
  summary.require_conservation();
  return exit_done;
}

void describe_settling_tank(std::ostream& out, const std::string& section) {
  TankInput input;
  Parameters parameters;
  input.declare(parameters);
  parameters.describe(out, section);
}

}  // namespace seedflow
