#include "seedflow/experiment/metering_map.h"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "seedflow/base/together.h"
#include "seedflow/base/units.h"
#include "seedflow/experiment/granular_report.h"
#include "seedflow/experiment/granular_study.h"
#include "seedflow/experiment/metering_report.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

namespace fs = std::filesystem;

constexpr double rpm = 2 * M_PI / 60;

struct MapPoint {
  double vacuum = 0, speed = 0, hole = 0;
  int n = 0, good = 0, multiple = 0, miss = 0, runs = 0;
  double flow = 0, power = 0;
};

std::string folder_name(const MapPoint& p, int repeat) {
  std::ostringstream name;
  name << -p.vacuum << "Pa_" << printed_number(p.speed / rpm) << "rpm_" << printed_number(1e3 * p.hole)
       << "mm_" << repeat;
  return name.str();
}

std::string used_text(const RunOptions& options) {
  MeteringInput input(options);
  Parameters parameters;
  input.declare(parameters);
  parameters.read(options.prm, options.overrides);
  return as_text(parameters);
}

RunOptions options_of(const MapPoint& p, int repeat, double turns, const RunOptions& of_study) {
  RunOptions own = of_study;
  const fs::path folder = of_study.output;
  own.output = (folder / "runs" / folder_name(p, repeat)).string();
  set_entry(own, "Experiment", "metering");
  set_entry(own, "Suction/Vacuum", exact_text(p.vacuum));
  set_entry(own, "Metering/Speed", exact_text(p.speed));
  set_entry(own, "Device/Hole diameter", exact_text(p.hole));
  set_entry(own, "Run/End time", exact_text(turns * 2 * M_PI / p.speed));
  set_entry(own, "Filling/Random number", std::to_string(repeat));
  set_entry(own, "Filling/Cache", fs::absolute(folder / "fillings" / std::to_string(repeat)).string());
  // What else is in the study does not belong to this run.
  set_entry(own, "Study/Vacuums", exact_text(p.vacuum));
  set_entry(own, "Study/Speeds", exact_text(p.speed));
  set_entry(own, "Study/Hole diameters", exact_text(p.hole));
  set_entry(own, "Study/Repeats", "1");
  return own;
}

std::vector<MapPoint> all_points(const MeteringMapParameters& map) {
  std::vector<MapPoint> points;
  for (const double hole : map.hole_diameters)
    for (const double speed : map.speeds)
      for (const double vacuum : map.vacuums) points.push_back({vacuum, speed, hole});
  return points;
}

void read_results(const fs::path& file, MapPoint& p) {
  const Summary s = Summary::read(file);
  const auto number = [&](const char* name) { return static_cast<int>(std::lround(s.observable(name))); };
  p.n += number("behind_blade_n");
  p.good += number("behind_blade_good_n");
  p.multiple += number("behind_blade_multiple_n");
  p.miss += number("behind_blade_miss_n");
  p.flow += s.observable("air_flow"), p.power += s.observable("air_power");
  ++p.runs;
}

bool evenly_spaced(const std::vector<double>& values) {
  if (values.size() < 2) return false;
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::abs(values[i] - values.front() - static_cast<double>(i) * step) > 1e-6 * std::abs(step))
      return false;
  return step != 0;
}

struct Index {
  const char* name;
  int MapPoint::*count;
};
const Index indices[] = {
    {"one seed", &MapPoint::good}, {"more seeds", &MapPoint::multiple}, {"no seed", &MapPoint::miss}};

void add_maps(const MeteringMapParameters& map, const std::vector<MapPoint>& points, Report& report) {
  for (const double hole : map.hole_diameters)
    for (const Index& index : indices) {
      const std::string title = std::string("Holes with ") + index.name + " behind the blade, holes of " +
                                printed_number(1e3 * hole) + " mm";
      LinePlot plot{title, {"vacuum", "kPa"}, {index.name, "%", false, 0.0, 100.0}};
      HeatMap heat{title, {"vacuum", "kPa"}, {"speed", "rpm"}, {index.name, "%", false, 0.0, 100.0}};
      for (const double speed : map.speeds) {
        LineSeries curve{printed_number(speed / rpm) + " rpm", {}, {}};
        curve.draw = LineSeries::Draw::both;
        for (const MapPoint& p : points) {
          if (p.hole != hole || p.speed != speed) continue;
          const Share share = share_of(p.*index.count, p.n);
          curve.x.push_back(-1e-3 * p.vacuum);
          curve.y.push_back(p.n > 0 ? 100 * share.value : std::nan(""));
          curve.band_low.push_back(100 * share.low);
          curve.band_high.push_back(100 * share.high);
          heat.values.push_back(curve.y.back());
        }
        plot.series.push_back(curve);
      }
      plot.caption = "Bands: Wilson's 95 % interval.";
      report.add(plot);
      if (!evenly_spaced(map.vacuums) || !evenly_spaced(map.speeds)) continue;
      const auto edges = [](const std::vector<double>& v, double factor, Axis& axis) {
        const double half = 0.5 * (v[1] - v[0]);
        axis.low = factor * (v.front() - half), axis.high = factor * (v.back() + half);
      };
      heat.nx = static_cast<int>(map.vacuums.size()), heat.ny = static_cast<int>(map.speeds.size());
      edges(map.vacuums, -1e-3, heat.x);
      edges(map.speeds, 1 / rpm, heat.y);
      if (*heat.x.low < *heat.x.high && *heat.y.low < *heat.y.high) report.add(heat);
    }
}

Table table_of(const std::vector<MapPoint>& points) {
  Table table{"All points",
              {"vacuum [kPa]", "speed [rpm]", "hole [mm]", "holes counted", "one seed", "more", "none",
               "air [L/s]", "power [W]"},
              {},
              "95 % intervals in brackets."};
  for (const MapPoint& p : points)
    table.rows.push_back({printed_number(-1e-3 * p.vacuum), printed_number(p.speed / rpm),
                          printed_number(1e3 * p.hole), std::to_string(p.n), in_words(share_of(p.good, p.n)),
                          in_words(share_of(p.multiple, p.n)), in_words(share_of(p.miss, p.n)),
                          printed_number(1e3 * p.flow / p.runs, 3), printed_number(p.power / p.runs, 3)});
  return table;
}

void write_results(const MeteringMapParameters& map, const std::vector<MapPoint>& points,
                   const RunOptions& options) {
  const fs::path folder = options.output;
  std::ostringstream csv;
  csv.precision(10);
  csv << "vacuum [Pa],speed [rad/s],hole diameter [m],holes,one seed,more seeds,no seed,air flow "
         "[m3/s],power [W]\n";
  Summary summary;
  summary.text("experiment", "metering map");
  const MapPoint* best = nullptr;
  for (const MapPoint& p : points) {
    csv << p.vacuum << "," << p.speed << "," << p.hole << "," << p.n << "," << p.good << "," << p.multiple
        << "," << p.miss << "," << p.flow / p.runs << "," << p.power / p.runs << "\n";
    if (p.n == 0) continue;
    const std::string at = printed_number(-1e-3 * p.vacuum) + " kPa, " + printed_number(p.speed / rpm) +
                           " rpm, " + printed_number(1e3 * p.hole) + " mm: ";
    for (const Index& index : indices)
      summary.observe(at + index.name, 100 * share_of(p.*index.count, p.n).value, "%");
    if (!best || p.good * best->n > best->good * p.n) best = &p;
  }
  write_file_atomically(folder / "map.csv", csv.str());
  Report report("Seeding quality against vacuum and speed", "./seedflow " + options.prm, "seedflow");
  report.lead("Every point is a run of the metering device; holes are counted behind the cleaning blade.");
  if (best)
    report.verdict(Report::Verdict::neutral,
                   "Most holes with exactly one seed: " + in_words(share_of(best->good, best->n)) + " at " +
                       printed_number(-1e-3 * best->vacuum) + " kPa, " + printed_number(best->speed / rpm) +
                       " rpm and holes of " + printed_number(1e3 * best->hole) + " mm.");
  add_maps(map, points, report);
  report.add(table_of(points));
  report.paragraph("The same numbers are in `map.csv`; every run with its own report is in `runs/`.");
  report.write(folder / "report.html");
  summary.write(folder / "summary.json");
  std::cout << "report: " << (folder / "report.html").string() << std::endl;
}

}  // namespace

void MeteringMapParameters::declare(Parameters& p) {
  const auto section = p.section(
      "Study", "Used by 'metering map' only: every combination of these lists is one run per repeat.");
  p.numbers("Vacuums", vacuums, "Pa", Range::any(), "Values of Suction/Vacuum.");
  p.numbers("Speeds", speeds, "rad/s", Range::positive(), "Values of Metering/Speed.");
  p.numbers("Hole diameters", hole_diameters, "m", Range::positive(), "Values of Device/Hole diameter.");
  p.number("Turns", turns, "1", Range::positive(), "Length of a run in turns of the disc.");
  p.integer("Repeats", repeats, Range::between(1, 1000), "Runs with other random numbers, counted together.");
}

int run_metering_map(const RunOptions& options) {
  MeteringInput input(options);
  Parameters parameters;
  input.declare(parameters);
  parameters.read(options.prm, options.overrides);
  input.experiment.check(parameters);
  std::vector<MapPoint> points = all_points(input.map);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (!options.dry_run) prepare_output_folder(options.output);
  const std::size_t n_runs = points.size() * input.map.repeats;
  std::size_t number = 0;
  for (int repeat = 1; repeat <= input.map.repeats; ++repeat)
    for (MapPoint& p : points) {
      const RunOptions own = options_of(p, repeat, input.map.turns, options);
      if (rank == 0)
        std::cout << "run " << ++number << " of " << n_runs << ": " << folder_name(p, repeat) << std::endl;
      if (options.dry_run) {
        run_metering(own);
        continue;
      }
      run_unless_finished(own, run_metering, used_text);
      together(MPI_COMM_WORLD, [&] { read_results(fs::path(own.output) / "summary.json", p); });
    }
  if (options.dry_run) return exit_done;
  together(MPI_COMM_WORLD, [&] {
    if (rank == 0) write_results(input.map, points, options);
  });
  return exit_done;
}

}  // namespace seedflow
