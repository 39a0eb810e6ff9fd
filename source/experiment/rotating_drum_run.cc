// Experiment "rotating drum" as a user gets it: run, summary, report.

#include <cmath>
#include <iostream>
#include <sstream>

#include "seedflow/experiment/command_of.h"
#include "seedflow/experiment/file_observer.h"
#include "seedflow/experiment/granular_report.h"
#include "seedflow/experiment/granular_uncertainties.h"
#include "seedflow/experiment/measurements.h"
#include "seedflow/experiment/rotating_drum.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

namespace reference = drum_reference;
namespace fs = std::filesystem;

constexpr double degree = M_PI / 180;
constexpr double rpm = 2 * M_PI / 60;

/// Mean of a column over the rows from so many revolutions on.
double plateau(const Series& series, const std::string& column, double from) {
  double sum = 0;
  int n = 0;
  for (std::size_t i = 0; i < series.n_rows(); ++i)
    if (series["revolutions"][i] >= from) sum += series[column][i], ++n;
  return n > 0 ? sum / n : series[column].back();
}

/// "lacey view 5 mm" -> "lacey_view_5mm".
std::string observable_of(std::string column) {
  if (const auto unit = column.rfind(" mm"); unit != std::string::npos) column.replace(unit, 3, "mm");
  for (char& c : column)
    if (c == ' ') c = '_';
  return column;
}

std::vector<std::string> mixing_columns(const RotatingDrum& drum) {
  std::vector<std::string> names;
  if (drum.diaphragm)
    for (const double cell : drum.cells)
      for (const char* kind : {"view", "3d"})
        names.push_back(std::string("lacey ") + kind + " " + printed_number(1e3 * cell) + " mm");
  return names;
}

void add_mixing(const RotatingDrum& drum, const Series& series, Report& report) {
  LinePlot plot{
      "Lacey mixing index (the paper's Fig. 17)", {"revolutions"}, {"mixing index", "%", false, 0.0}};
  for (const std::string& column : mixing_columns(drum))
    plot.series.push_back({column.substr(6), series["revolutions"], series[column]});
  if (std::abs(drum.speed / rpm - 40) < 1e-6)
    plot.horizontal = {{reference::measured_plateau, "measured plateau"}};
  plot.caption =
      drum.lacey_count == "seeds"
          ? "view: seeds seen through the front end, in square cells as in the paper (5 mm); 3d: all seeds "
            "in "
            "cubes. 100 % is a random mixture; it scatters about that. In 5 mm cells there are only about "
            "one "
            "and a half seeds seen and two in all."
          : "Sub-spheres are counted. view: in square columns through the whole drum; 3d: in cubes. A random "
            "mixture of seeds stays below 100 %, the more so the fewer seeds a cell holds.";
  report.add(plot);
}

void add_profile(const RotatingDrum& drum, const VelocityProfile& profile, Summary* summary, Report* report) {
  std::vector<double> y, u;
  profile.mean(y, u);
  LinePlot plot{"Velocity across the bed", {"distance from the axis", "m"}, {"velocity downhill", "m/s"}};
  plot.series.push_back({"this run", y, u});
  std::vector<double> wall_y, wall_u;
  for (int i = 0; i <= 20; ++i) {
    wall_y.push_back(-drum.radius * i / 20.0);
    wall_u.push_back(drum.speed * wall_y.back());
  }
  plot.series.push_back({"turning with the drum", wall_y, wall_u});
  if (!drum.measurements.empty()) {
    LineSeries measured{"measured", {}, {}};
    measured.draw = LineSeries::Draw::markers;
    double square = 0;
    int n = 0;
    for (const Measurement& m : read_measurements(drum.measurements)) {
      if (m.quantity != "velocity") continue;
      measured.x.push_back(m.coordinate);
      measured.y.push_back(m.value);
      for (std::size_t i = 1; i < y.size(); ++i) {
        if (m.coordinate < y[i - 1] || m.coordinate > y[i]) continue;
        const double here = u[i - 1] + (u[i] - u[i - 1]) * (m.coordinate - y[i - 1]) / (y[i] - y[i - 1]);
        square += (here - m.value) * (here - m.value), ++n;
        break;
      }
    }
    plot.series.push_back(measured);
    if (summary && n > 0) {
      summary->observe("velocity_rms_to_measured", std::sqrt(square / n), "m/s");
      summary->observe("velocity_points_compared", n, "1");
    }
  }
  plot.caption =
      "Mean velocity of the seeds within two diameters of the line through the axis normal to the free "
      "surface.";
  if (report) report->add(plot);
}

void write_report(const RotatingDrum& drum, const GranularRun& run, const RotatingDrum::Gathered& gathered,
                  const BedContour& bed, const Series& series, const Summary& summary,
                  const RunOptions& options) {
  Report report("Rotating drum", command_of(options), "seedflow");
  std::ostringstream lead;
  lead << seeds_in_words(run, drum.granular) << " in a drum of radius " << 1e3 * drum.radius
       << " mm and length " << 1e3 * drum.length << " mm, " << fixed(drum.speed / rpm, 1) << " rpm, "
       << printed_number(drum.revolutions) << " revolutions"
       << (drum.measurements.empty() ? " (Xu et al. 2024, section 3.2.3)." : ".");
  report.lead(lead.str());
  std::string verdict =
      "The surface is inclined by " + fixed(summary.observable("dynamic_angle"), 1) + " degrees on average.";
  Report::Verdict kind = Report::Verdict::neutral;
  const std::string papers = "lacey_view_5mm";
  if (drum.diaphragm && drum.cells.front() == 5e-3) {
    const double view = summary.observable(papers);
    verdict = "Mixing index after " + printed_number(drum.plateau_from) + " revolutions: " + fixed(view, 1) +
              (drum.lacey_count == "seeds" ? " % in the view through the end, "
                                           : " % in columns through the drum, ") +
              fixed(summary.observable("lacey_3d_5mm"), 1) + " % in 3D (5 mm cells). " + verdict;
    if (std::abs(drum.speed / rpm - 40) < 1e-6) {
      const double off = std::abs(view - reference::measured_plateau);
      kind = off < 3   ? Report::Verdict::agrees
             : off < 7 ? Report::Verdict::doubtful
                       : Report::Verdict::disagrees;
      verdict += " The paper measured a plateau of 85.57 %.";
    }
  } else if (!drum.measurements.empty()) {
    verdict += " The velocity across the bed is " + fixed(summary.observable("velocity_rms_to_measured"), 3) +
               " m/s (rms) from the measured one.";
  }
  report.verdict(kind, verdict);
  for (const double at : drum.picture_at) {
    const fs::path file = fs::path(options.output) / ("drum_" + printed_number(at) + "_revolutions.svg");
    if (at <= drum.revolutions && fs::exists(file))
      report.figure(read_file(file), "After " + printed_number(at) +
                                         (at == 1 ? " revolution" : " revolutions") +
                                         ", seen through the front end.");
  }
  if (drum.diaphragm) add_mixing(drum, series, report);
  report.figure(drum.picture(run.dem(), "At the end", &bed).svg(),
                "The end of the run with the fitted S-shaped contour (dashed).");
  LinePlot contour{"Dynamic contour (the paper's Fig. 18)", {"x", "mm"}, {"height", "mm"}};
  LineSeries pixels{"boundary pixels", {}, {}}, curve{"S-shaped fit", {}, {}};
  for (std::size_t i = 0; i < bed.boundary.x.size(); i += 4) {
    pixels.x.push_back(1e3 * bed.boundary.x[i]);
    pixels.y.push_back(1e3 * bed.boundary.y[i]);
    curve.x.push_back(1e3 * bed.boundary.x[i]);
    curve.y.push_back(1e3 * bed.surface(bed.boundary.x[i]));
  }
  const auto& line = bed.line.parameters;
  contour.series = {pixels,
                    curve,
                    {"straight fit, " + fixed(bed.angle / degree, 1) + " deg",
                     {1e3 * bed.line_from, 1e3 * bed.line_to},
                     {1e3 * (line[0] + line[1] * bed.line_from), 1e3 * (line[0] + line[1] * bed.line_to)}}};
  report.add(contour);
  LinePlot angle{"Dynamic angle", {"revolutions"}, {"angle", "deg"}};
  angle.series = {{"straight fit", series["revolutions"], series["dynamic angle"]},
                  {"middle of the S-shaped fit", series["revolutions"], series["angle in the middle"]}};
  report.add(angle);
  add_profile(drum, gathered.profile, nullptr, &report);
  add_numbers(summary, report);
  report.write(fs::path(options.output) / "report.html");
}

const StudyAxis varied = {"Speeds", "Drum/Speed", "rad/s", {}, "rpm", 1 / rpm};

struct Input : GranularInput<RotatingDrum> {
  Input() : GranularInput("rotating drum", varied) {}
  explicit Input(const RunOptions& options) : GranularInput("rotating drum", varied, options) {}
};

}  // namespace

int run_rotating_drum(const RunOptions& options) {
  Input input(options);
  Parameters parameters;
  input.declare(parameters);
  parameters.read(options.prm, options.overrides);
  RotatingDrum& drum = input.experiment;
  drum.check(parameters);
  if (!drum.measurements.empty()) read_measurements(drum.measurements);  // bad input is found now
  RotatingDrum::Gathered gathered;
  int rank = 0;
  MPI_Comm_rank(options.comm, &rank);
  const GranularScene scene =
      drum.scene(gathered, rank == 0 && !options.dry_run ? fs::path(options.output) : fs::path());
  GranularJob job(parameters, options, drum.granular, scene);
  if (options.dry_run) return job.say_what_it_will_be();
  Summary summary;
  summary.text("experiment", "rotating drum");
  job.run.carry_out(parameters, options, summary);

  return job.finish(summary, [&] {
    const Series series = read_series(fs::path(options.output) / "series.csv");
    for (const std::string& column : mixing_columns(drum))
      summary.observe(observable_of(column), plateau(series, column, drum.plateau_from), "%");
    summary.observe("dynamic_angle", plateau(series, "dynamic angle", drum.plateau_from), "deg");
    summary.observe("angle_in_the_middle", plateau(series, "angle in the middle", drum.plateau_from), "deg");
    summary.observe("centre_of_mass_angle", plateau(series, "centre of mass angle", drum.plateau_from),
                    "deg");
    if (drum.diaphragm) summary.observe("measured_lacey_40rpm", reference::measured_plateau, "%");
    add_profile(drum, gathered.profile, &summary, nullptr);
    const BedContour bed = drum.measure_contour(job.run.dem());
    write_file_atomically(fs::path(options.output) / "drum_end.svg",
                          drum.picture(job.run.dem(), "", &bed).svg());
    Series profile{{{"distance from the axis", "m"}, {"velocity downhill", "m/s"}}, {{}, {}}};
    gathered.profile.mean(profile.values[0], profile.values[1]);
    write_series(fs::path(options.output) / "velocity_profile.csv", profile);
    write_report(drum, job.run, gathered, bed, series, summary, options);
    std::cout << "dynamic angle " << fixed(summary.observable("dynamic_angle"), 1) << " degrees";
    if (drum.diaphragm)
      std::cout << ", mixing index " << fixed(summary.observable(observable_of(mixing_columns(drum)[0])), 1)
                << " % (view)";
    std::cout << std::endl;
  });
}

void describe_rotating_drum(std::ostream& out, const std::string& section) {
  Input input;
  Parameters parameters;
  input.declare(parameters);
  parameters.describe(out, section);
}

Observer rotating_drum_observer() {
  FileObserver files;
  files.run = run_rotating_drum;
  files.read = look_at_checked<Input>;
  files.observables = {
      {"surface angle", "rad", "", "", "of a straight line through the middle of the bed's contour"},
      {"centre of mass angle", "rad", "", "",
       "of the line from the axis to the centre of mass, to the vertical"}};
  files.uncertainties = {{"mass of the filling", "Filling/Mass", 0.02, true, false},
                         {"speed of the drum", "Drum/Speed", 0.01, true, false}};
  files.further_uncertainties = [](const Parameters& p) {
    return granular_uncertainties(p, {"Drum/Barrel material", "Drum/End material"});
  };
  files.value = [](const std::string& folder, const WantedValue& wanted, const RunOptions&) {
    const Summary summary = Summary::read(fs::path(folder) / "summary.json");
    return degree *
           summary.observable(wanted.quantity == "surface angle" ? "dynamic_angle" : "centre_of_mass_angle");
  };
  files.random_entry = "Filling/Random number";
  return make_observer(files);
}

int run_rotating_drum_study(const RunOptions& options) {
  Input input(options);
  Parameters parameters;
  input.declare(parameters);
  parameters.read(options.prm, options.overrides);
  const RotatingDrum& drum = input.experiment;
  GranularStudy study(input.study, options, "rotating drum", run_rotating_drum, used_text<Input>);
  if (!study.carry_out()) return exit_done;

  std::vector<std::string> observables;
  for (const std::string& column : mixing_columns(drum)) observables.push_back(observable_of(column));
  observables.insert(observables.end(), {"dynamic_angle", "angle_in_the_middle"});
  const StudyTable table = study.table(observables);
  Report report("Rotating drum: seed models beside the measurement", command_of(options), "seedflow");
  report.lead(
      "The paper's rotating container experiment with its seed models (Table 2): mixing index against "
      "revolutions and the dynamic contour.");
  report.verdict(Report::Verdict::neutral,
                 table.verdict(observables.front(), reference::measured_plateau, 0) +
                     "The measured plateau is at 40 rpm.");
  // Fig. 17: one plot per speed and kind of model, the first repeat of each model.
  std::vector<std::string> groups;
  for (const StudyCase& one : study.cases())
    if (std::find(groups.begin(), groups.end(), one.group) == groups.end()) groups.push_back(one.group);
  for (const std::string& group : groups) {
    LinePlot plot{"Mixing index, " + group + " (Fig. 17)",
                  {"revolutions"},
                  {"mixing index, view, smallest cells", "%", false, 0.0}};
    for (const StudyCase& one : study.cases()) {
      if (one.group != group || one.repeat != 1) continue;
      const Series series = study.series_of(one);
      plot.series.push_back({"N = " + std::to_string(one.n_spheres), series["revolutions"],
                             series[mixing_columns(drum).front()]});
    }
    plot.horizontal = {{reference::measured_plateau, "measured, 40 rpm"}};
    report.add(plot);
  }
  LinePlot plateaus = table.against_roughness(observables.front(), "Mixing index after four revolutions",
                                              {"mixing index", "%"});
  LineSeries papers{
      "paper, simulated, 40 rpm",
      {0.125, 0.1, 0.075},
      {reference::simulated_plateau[0], reference::simulated_plateau[1], reference::simulated_plateau[2]}};
  papers.draw = LineSeries::Draw::markers;
  plateaus.series.push_back(papers);
  plateaus.horizontal = {{reference::measured_plateau, "measured, 40 rpm"}};
  report.add(plateaus);
  report.add(table.against_roughness("dynamic_angle", "Dynamic angle (straight fit, cf. Fig. 18)",
                                     {"dynamic angle", "deg"}));
  report.add(table.all("Mixing index [%] and dynamic angle [degrees], averaged over the plateau"));
  study.finish(report, table);
  return exit_done;
}

}  // namespace seedflow
