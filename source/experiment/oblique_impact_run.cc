// The run of experiment "oblique impact": sweep, comparison, files.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>

#include "oblique_impact_report.h"
#include "seedflow/base/error.h"
#include "seedflow/base/parameters.h"
#include "seedflow/base/units.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/series.h"
#include "seedflow/output/summary.h"

namespace seedflow {

namespace {

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// One condition ready to run. Bound to its Parameters, so it must not move.
struct ImpactCase {
  ImpactCase(const std::string& case_name, const std::string& prm, const std::vector<std::string>& overrides)
      : name(case_name), input(prm, overrides) {
    input.declare(parameters);
    parameters.read(prm, overrides);
    input.check(parameters);
  }
  ImpactCase(const ImpactCase&) = delete;
  ImpactCase& operator=(const ImpactCase&) = delete;

  std::string name;
  ObliqueImpactParameters input;
  Parameters parameters;
};

/// The measured values of one condition, checked and in SI.
std::vector<MeasuredImpact> measured_under(const std::string& condition, const std::string& file,
                                           const std::vector<Measurement>& data) {
  const std::vector<Observable> known = oblique_impact_observer().observables;
  std::vector<MeasuredImpact> result;
  for (const Measurement& m : data) {
    if (m.condition != condition) continue;
    const std::string where = file + ":" + std::to_string(m.line) + ": ";
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Observable& o) { return o.name == m.quantity; });
    if (found == known.end())
      throw InputError(where +
                       "this experiment produces tangential restitution, rebound spin and rebound "
                       "angle, not \"" +
                       m.quantity + "\".");
    try {
      const auto si = [](double value, const std::string& unit, const std::string& wanted) {
        return to_si(exact_text(value) + (unit == "1" ? "" : " " + unit), wanted);
      };
      MeasuredImpact impact;
      impact.quantity = m.quantity;
      impact.angle = si(m.coordinate, m.coordinate_unit, "rad");
      impact.value = si(m.value, m.unit, found->unit);
      impact.uncertainty = si(m.standard_uncertainty, m.unit, found->unit);
      if (!(impact.angle > 0 && impact.angle < M_PI / 2))
        throw InputError("the impact angle must lie between 0 and 90 degrees.");
      result.push_back(impact);
    } catch (const InputError& error) {
      throw InputError(where + error.what());
    }
  }
  return result;
}

Sweep sweep_of(const ImpactCase& one, std::vector<MeasuredImpact> measured) {
  Sweep sweep{one.name, one.input.angles, {}, std::move(measured), sliding_angle(one.input), 0};
  for (MeasuredImpact& m : sweep.measured) {
    m.computed = value_of(oblique_impact(one.input, m.angle), m.quantity);
  }
  std::sort(sweep.angles.begin(), sweep.angles.end());
  for (const double angle : sweep.angles) {
    const Rebound r = oblique_impact(one.input, angle);
    sweep.rebounds.push_back(r);
    if (angle < sweep.sliding_from) continue;
    const double expected = 1 - sliding_rebound(one.input, angle).tangential_restitution;
    sweep.sliding_error =
        std::max(sweep.sliding_error, std::abs((1 - r.tangential_restitution) / expected - 1));
  }
  return sweep;
}

void write_series(const Sweep& s, const std::filesystem::path& file) {
  SeriesWriter writer(file, {{"impact angle", "rad"},
                             {"tangential restitution", "1"},
                             {"normal restitution", "1"},
                             {"rebound spin", "rad/s"},
                             {"rebound angle", "rad"},
                             {"contact time", "s"},
                             {"largest overlap", "m"}});
  for (std::size_t i = 0; i < s.angles.size(); ++i) {
    const Rebound& r = s.rebounds[i];
    writer.row({s.angles[i], r.tangential_restitution, r.normal_restitution, r.spin, r.angle, r.contact_time,
                r.overlap});
  }
}

}  // namespace

int run_oblique_impact(const RunOptions& options) {
  const ImpactCase base("all angles", options.prm, options.overrides);
  std::vector<Measurement> data;
  std::vector<std::unique_ptr<ImpactCase>> cases;
  if (!base.input.measurements.empty()) {
    data = read_measurements(base.input.measurements);
    for (const Condition& c : read_conditions(base.input.conditions))
      cases.push_back(
          std::make_unique<ImpactCase>(c.name, options.prm, joined(c.overrides, options.overrides)));
    for (const Measurement& m : data)
      if (std::none_of(cases.begin(), cases.end(), [&](const auto& c) { return c->name == m.condition; }))
        throw InputError(base.input.measurements + ":" + std::to_string(m.line) +
                         ": there is no condition \"" + m.condition + "\" in " + base.input.conditions + ".");
  } else {
    cases.push_back(std::make_unique<ImpactCase>(base.name, options.prm, options.overrides));
  }
  int rank = 0;
  MPI_Comm_rank(options.comm, &rank);
  if (rank != 0) return exit_done;  // one rank has all the work there is
  if (options.dry_run) {
    std::cout << cases.size() << " condition(s) of " << base.input.angles.size()
              << " impacts and the measured ones: a few seconds.\n"
              << base.input.materials.notice() << std::endl;
    return exit_done;
  }
  prepare_output_folder(options.output);
  const std::filesystem::path folder = options.output;
  Summary summary;
  summary.text("experiment", base.input.name);
  std::vector<Sweep> sweeps;
  for (const auto& one : cases) {
    sweeps.push_back(sweep_of(*one, measured_under(one->name, base.input.measurements, data)));
    const Sweep& s = sweeps.back();
    const std::string notice = one->input.materials.notice();
    if (!notice.empty()) summary.text(s.name + ": reduced modulus", notice);
    summary.observe(s.name + ": sliding from", s.sliding_from, "rad");
    summary.observe(s.name + ": largest deviation from the sliding impulse", s.sliding_error, "1");
    for (const Observable& o : oblique_impact_observer().observables) {
      const Agreement a = agreement(s, o.name);
      if (a.n == 0) continue;
      summary.observe(s.name + ": " + o.name + ", rms deviation", a.rms, o.unit);
      summary.observe(s.name + ": " + o.name + ", rms deviation / uncertainty", a.rms_scaled, "1");
      summary.observe(s.name + ": " + o.name + ", largest deviation / uncertainty", a.largest_scaled, "1");
    }
    write_series(s, folder / (cases.size() == 1 ? "impacts.csv" : s.name + ".csv"));
    std::ostringstream used;
    one->parameters.write(used);
    write_file_atomically(folder / (cases.size() == 1 ? "used.prm" : s.name + ".prm"), used.str());
  }
  summary.performance.peak_memory_MiB = peak_memory_MiB();
  summary.write(folder / "summary.json");
  write_impact_report(sweeps, cases.front()->input, options);
  std::cout << "report: " << (folder / "report.html").string() << std::endl;
  return exit_done;
}

}  // namespace seedflow
