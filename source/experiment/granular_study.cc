#include "seedflow/experiment/granular_study.h"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/parameter_file.h"
#include "seedflow/base/parameters.h"
#include "seedflow/base/together.h"
#include "seedflow/base/units.h"
#include "seedflow/experiment/agreement.h"
#include "seedflow/output/checkpoint.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

std::string printed(const StudyAxis& axis, double value) {
  return printed_number(value * axis.printed_factor) + " " + axis.printed_unit;
}

std::vector<StudyCase> all_cases_of(const GranularStudyParameters& study) {
  const std::vector<double> along = study.axis.values.empty() ? std::vector<double>{0} : study.axis.values;
  std::vector<StudyCase> cases;
  for (int repeat = 1; repeat <= study.repeats; ++repeat)  // one of each before the second of any
    for (const std::string& motion : study.motions)
      for (const std::string& reading : study.readings)
        for (const std::string& caliper : study.calipers)
          for (const double n : study.models)
            for (const double value : along) {
              StudyCase one;
              one.n_spheres = static_cast<int>(n);
              one.motion = motion, one.reading = reading, one.caliper = caliper;
              one.along = value, one.repeat = repeat;
              one.group = motion + ", " + reading + (caliper == "equal" ? ", equal caliper" : "");
              one.filling_name = "N" + std::to_string(one.n_spheres) + "_" + motion + "_" + reading +
                                 (caliper == "equal" ? "_equal" : "") + "_" + std::to_string(repeat);
              one.folder_name = one.filling_name;
              if (!study.axis.values.empty()) {
                std::ostringstream at;
                at << value * study.axis.printed_factor;
                one.folder_name += "_" + at.str() + study.axis.printed_unit;
                one.group += ", " + printed(study.axis, value);
              }
              cases.push_back(one);
            }
  return cases;
}

/// Does the work; why it failed, or "". Other errors than RunError go on. Collective.
std::string failure_of(const std::function<void()>& work, Meeting& meeting) {
  std::string reason;
  try {
    work();
  } catch (const RunError& error) {
    reason = error.what();
  }
  // A rank that failed alone cannot go on: the others wait for it within the run.
  if (!meeting.all_arrive(reason.empty() ? HUGE_VAL : 10.0 /* s */)) throw RunError(reason);
  int mine = !reason.empty(), any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, meeting.comm());
  return any && reason.empty() ? "failed on another process" : reason;
}

}  // namespace

void GranularStudyParameters::declare(Parameters& p, const StudyAxis& of_experiment) {
  axis = of_experiment;
  const auto section = p.section(
      "Study",
      "Used by the study of this experiment only: every combination of these lists is one run, averaged over "
      "the repeats.");
  p.numbers("Models", models, "1", Range::between(1, 2000), "Numbers of sub-spheres.");
  p.choices("Motions", motions, {"rigid", "bonded"}, "How the sub-spheres of a seed hold together.");
  p.choices("Readings", readings, {"radius", "diameter"}, "Table 2's sizes read as radius or as diameter.");
  p.choices("Calipers", calipers, {"as packed", "equal"},
            "equal: the clump is enlarged to the real seed's mean caliper.");
  p.integer("Repeats", repeats, Range::between(1, 1000), "Runs with other random numbers, for the scatter.");
  if (!axis.name.empty())
    p.numbers(axis.name, axis.values, axis.unit, Range::any(), "Values of " + axis.path + ".");
}

GranularStudy::GranularStudy(const GranularStudyParameters& parameters, const RunOptions& run_options,
                             std::string name, Run run_one, TextOf text)
    : study(parameters),
      options(run_options),
      experiment(std::move(name)),
      run(run_one),
      text_of(text),
      all_cases(all_cases_of(parameters)) {}

RunOptions GranularStudy::options_of(const StudyCase& one) const {
  const std::filesystem::path folder = options.output;
  RunOptions own = options;
  own.output = (folder / "runs" / one.folder_name).string();
  const auto set = [&own](const std::string& path, const std::string& value) { set_entry(own, path, value); };
  set("Experiment", experiment);
  set("Seeds/Sub-spheres", std::to_string(one.n_spheres));
  set("Seeds/Rigid", one.motion == "rigid" ? "true" : "false");
  set("Seeds/Reading", one.reading);
  set("Seeds/Equal mean caliper", one.caliper == "equal" ? "true" : "false");
  set("Filling/Random number", std::to_string(one.repeat));
  // What else is in the study does not belong to this run.
  set("Study/Models", "70");
  set("Study/Motions", "rigid");
  set("Study/Readings", "radius");
  set("Study/Calipers", "as packed");
  set("Study/Repeats", "1");
  if (!study.axis.values.empty()) {
    set("Study/" + study.axis.name, "0");
    set(study.axis.path, exact_text(one.along));
    set("Filling/Cache", std::filesystem::absolute(folder / "fillings" / one.filling_name).string());
  }
  return own;
}

void set_entry(RunOptions& options, const std::string& path, const std::string& value) {
  options.overrides.erase(
      std::remove_if(options.overrides.begin(), options.overrides.end(),
                     [&](const std::string& text) { return path_of(scan_override(text)) == path; }),
      options.overrides.end());
  options.overrides.push_back(path + "=" + value);
}

void run_unless_finished(RunOptions options, int (*run)(const RunOptions&),
                         std::string (*text_of)(const RunOptions&)) {
  const std::filesystem::path folder = options.output;
  bool finished = false, begun = false;
  together(MPI_COMM_WORLD, [&] {
    const bool same =
        std::filesystem::exists(folder / "used.prm") && read_file(folder / "used.prm") == text_of(options);
    finished = same && std::filesystem::exists(folder / "summary.json");
    begun = same && checkpoint_exists(folder / "checkpoint");
  });
  if (finished) return;
  options.resume = begun;
  run(options);
}

bool GranularStudy::carry_out() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (!options.dry_run) prepare_output_folder(options.output);
  int number = 0;
  std::vector<StudyCase> made;
  Meeting meeting(MPI_COMM_WORLD);
  for (const StudyCase& one : all_cases) {
    const RunOptions own = options_of(one);
    ++number;
    if (rank == 0)
      std::cout << "run " << number << " of " << all_cases.size() << ": " << one.folder_name << std::endl;
    if (own.dry_run) {
      run(own);
      continue;
    }
    const std::string why = failure_of([&] { run_unless_finished(own, run, text_of); }, meeting);
    if (why.empty()) {
      made.push_back(one);
      continue;
    }
    failures.push_back(one.folder_name + ": " + why);
    if (rank == 0) std::cout << "failed: " << why << std::endl;
  }
  if (options.dry_run) return false;
  all_cases = made;
  if (made.empty())
    throw RunError("All " + std::to_string(number) + " runs failed. The first is " + failures.front());
  return true;
}

Series GranularStudy::series_of(const StudyCase& one) const {
  return read_series(std::filesystem::path(options_of(one).output) / "series.csv");
}

StudyTable GranularStudy::table(const std::vector<std::string>& observables) const {
  StudyTable table;
  table.observables = observables;
  std::map<std::string, std::vector<const StudyCase*>> repeats;
  std::vector<std::string> order;
  for (const StudyCase& one : all_cases) {
    const std::string key = one.group + std::to_string(one.n_spheres);
    if (repeats[key].empty()) order.push_back(key);
    repeats[key].push_back(&one);
  }
  for (const std::string& key : order) {
    StudyTable::Row row;
    row.of = *repeats[key].front();
    row.repeats = static_cast<int>(repeats[key].size());
    std::map<std::string, std::vector<double>> values;
    for (const StudyCase* one : repeats[key]) {
      const Summary summary = Summary::read(std::filesystem::path(options_of(*one).output) / "summary.json");
      for (const std::string& name : observables) values[name].push_back(summary.observable(name));
    }
    for (const std::string& name : observables) {
      double sum = 0, square = 0;
      for (const double v : values[name]) sum += v;
      const double mean = sum / row.repeats;
      for (const double v : values[name]) square += (v - mean) * (v - mean);
      row.mean[name] = mean;
      row.deviation[name] =
          row.repeats > 1 ? std::sqrt(square / (row.repeats - 1)) : std::numeric_limits<double>::quiet_NaN();
    }
    table.rows.push_back(row);
  }
  return table;
}

void GranularStudy::finish(Report& report, const StudyTable& table) const {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const std::filesystem::path folder = options.output;
  together(MPI_COMM_WORLD, [&] {
    if (rank != 0) return;
    std::ostringstream csv;
    csv.precision(10);
    csv << "sub-spheres,motion,reading,caliper"
        << (study.axis.values.empty() ? "" : "," + study.axis.path + " [" + study.axis.unit + "]")
        << ",repeats";
    for (const std::string& name : table.observables) csv << "," << name << "," << name << " deviation";
    csv << "\n";
    Summary summary;
    summary.text("experiment", experiment + " study");
    for (const StudyTable::Row& row : table.rows) {
      csv << row.of.n_spheres << "," << row.of.motion << "," << row.of.reading << "," << row.of.caliper;
      if (!study.axis.values.empty()) csv << "," << row.of.along;
      csv << "," << row.repeats;
      for (const std::string& name : table.observables) {
        csv << "," << row.mean.at(name) << "," << row.deviation.at(name);
        summary.observe("N = " + std::to_string(row.of.n_spheres) + ", " + row.of.group + ": " + name,
                        row.mean.at(name), "1");
      }
      csv << "\n";
    }
    write_file_atomically(folder / "study.csv", csv.str());
    summary.write(folder / "summary.json");
    report.paragraph("The same numbers are in `study.csv`; every run with its own report is in `runs/`.");
    if (!failures.empty()) report.heading("Runs that failed");
    for (const std::string& failure : failures) report.paragraph(failure);
    report.write(folder / "report.html");
    std::cout << "report: " << (folder / "report.html").string() << std::endl;
  });
  if (!failures.empty())
    throw RunError(std::to_string(failures.size()) + " of " +
                   std::to_string(failures.size() + all_cases.size()) +
                   " runs of the study failed, the report has the others. The first is " + failures.front());
}

}  // namespace seedflow
