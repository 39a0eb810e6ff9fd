#include "seedflow/experiment/metering_report.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/coupling/aperture_flow.h"
#include "seedflow/experiment/granular_report.h"
#include "seedflow/output/radar_plot.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

namespace fs = std::filesystem;

constexpr double rpm = 2 * M_PI / 60;

BarPlot stations_plot(const SeedingRecord& record) {
  BarPlot plot{
      "Holes with no, one and more seeds", {"none", "one", "more"}, {"holes", "%", false, 0.0, 100.0}};
  const struct {
    const char* label;
    int Passage::*station;
  } stations[] = {{"before the blade", &Passage::carried},
                  {"behind the blade", &Passage::cleaned},
                  {"at unloading", &Passage::unloaded}};
  for (const auto& s : stations) {
    const SeedingIndices i = indices_of_counts(counts(record, s.station));
    if (i.n == 0) continue;
    const auto half = [](const Share& share) { return 50 * (share.high - share.low); };
    plot.series.push_back({std::string(s.label) + " (" + std::to_string(i.n) + ")",
                           {100 * i.miss.value, 100 * i.quality.value, 100 * i.multiple.value},
                           {half(i.miss), half(i.quality), half(i.multiple)}});
  }
  plot.caption = "Number of holes in brackets; bars: half of Wilson's 95 % interval.";
  return plot;
}

LinePlot track_plot(const SeedingRecord& record, const NamedSeeds& seeds, const std::string& title,
                    const std::string& unit, float SeedSample::*value, bool logarithmic) {
  LinePlot plot{title, {"time", "s"}, {title, unit, logarithmic}};
  for (const auto& [label, name] :
       {std::pair{seeds.a, "A, taken alone"}, {seeds.b, "B, taken with others"}}) {
    if (label < 0) continue;
    LineSeries curve{name, {}, {}};
    for (const SeedSample& s : record.track(static_cast<int>(label))) {
      curve.x.push_back(s.time);
      const double v = s.*value;
      curve.y.push_back(logarithmic && v <= 0 ? std::nan("") : v);
    }
    plot.series.push_back(curve);
  }
  return plot;
}

/// Means over equal parts of the run, as the paper's Fig. 24 puts them on spokes.
RadarPlot radar(const SeedingRecord& record, const NamedSeeds& seeds, const std::string& title,
                const std::string& unit, float SeedSample::*value) {
  constexpr int n = 20;
  RadarPlot plot{title, {}, unit};
  const auto& any = record.track(static_cast<int>(seeds.a >= 0 ? seeds.a : seeds.b));
  const double end = any.back().time;
  for (int i = 0; i < n; ++i) plot.spokes.push_back(fixed(end * (i + 0.5) / n, 2) + " s");
  for (const auto& [label, name] :
       {std::pair{seeds.a, "A, taken alone"}, {seeds.b, "B, taken with others"}}) {
    if (label < 0) continue;
    std::vector<double> sum(n), count(n);
    for (const SeedSample& s : record.track(static_cast<int>(label))) {
      const int i = std::min(n - 1, static_cast<int>(n * s.time / end));
      sum[i] += s.*value, count[i] += 1;
    }
    for (int i = 0; i < n; ++i) sum[i] /= std::max(1.0, count[i]);
    plot.series.push_back({name, sum});
  }
  return plot;
}

/// Speed and pressure on the axis of an open hole.
LinePlot axis_plot(const Metering& m, double drop) {
  LinePlot plot{"Speed of the air on the axis of an open hole",
                {"distance before the mouth", "mm"},
                {"speed", "m/s", false, 0.0}};
  LineSeries curve{"hole sinks", {}, {}};
  const double limit = std::sqrt(2 * drop / m.suction.density), a = m.device.hole_radius();
  const double q = m.suction.hole_coefficient * m.device.hole_area() * limit;
  for (int i = 0; i <= 60; ++i) {
    const double z = 6e-3 * i / 60;
    curve.x.push_back(1e3 * z);
    curve.y.push_back(norm(aperture_velocity({0, 0, z}, a, q, limit)));
  }
  plot.series = {curve};
  plot.caption = "Potential flow into the opening; the mean speed in the hole is " +
                 printed_number(q / m.device.hole_area(), 3) + " m/s. Pressure below ambient: rho/2 u^2.";
  return plot;
}

/// Along the axes of a hole with a seed and an open one, at the end of a run with computed air.
void add_hole_lines(const Metering& m, const fs::path& folder, Report& report) {
  LinePlot pressure{"Pressure along a hole", {"z", "mm"}, {"pressure", "Pa"}};
  LinePlot velocity{"Velocity along a hole", {"z", "mm"}, {"axial velocity", "m/s"}};
  for (const auto& [name, file] :
       {std::pair{"open", "open_hole.csv"}, {"with a seed", "hole_with_seed.csv"}}) {
    if (!fs::exists(folder / file)) continue;
    const Series line = read_series(folder / file);
    std::vector<double> z;
    for (const double metres : line["z"]) z.push_back(1e3 * metres);
    pressure.series.push_back({name, z, line["pressure"]});
    velocity.series.push_back({name, z, line["velocity"]});
  }
  if (pressure.series.empty()) return;
  for (LinePlot* plot : {&pressure, &velocity}) {
    plot->vertical = {{0, "mouth"}, {1e3 * m.device.thickness, "end"}};
    plot->caption = "At the end of the run, on the axis, from the seeds' side into the vacuum chamber.";
    report.add(*plot);
  }
}

}  // namespace

std::string in_words(const Share& s) {
  return fixed(100 * s.value, 1) + " % (" + fixed(100 * s.low, 0) + " to " + fixed(100 * s.high, 0) + ")";
}

void write_metering_report(const Metering& m, const Metering::Gathered& gathered, const GranularRun& run,
                           const Summary& summary, const RunOptions& options) {
  const SeedingRecord& record = gathered.record;
  Report report("Air-suction seed metering", "./seedflow " + options.prm, "seedflow");
  std::ostringstream lead;
  lead << seeds_in_words(run, m.granular) << ", " << m.device.n_holes() << " holes of "
       << printed_number(1e3 * m.device.hole_diameter) << " mm on a circle of radius "
       << printed_number(1e3 * m.device.pitch_radius) << " mm, " << fixed(m.speed / rpm, 1) << " rpm, vacuum "
       << printed_number(1e-3 * m.suction.vacuum) << " kPa, " << fixed(run.time(), 2)
       << " s (Xu et al. 2024, section 5). Air: " << m.air_model << ".";
  report.lead(lead.str());
  const SeedingIndices behind = indices_of_counts(counts(record, &Passage::cleaned));
  const SeedingIndices end = indices_of_counts(counts(record, &Passage::unloaded));
  const SeedingIndices& best = end.n > 0 ? end : behind;
  std::string verdict;
  if (best.n == 0)
    verdict = "No hole came from the pool past the blade: the run is too short to judge the seeding.";
  else
    verdict = "Of " + std::to_string(best.n) + " holes " +
              (end.n > 0 ? "at the unloading point " : "behind the blade ") + in_words(best.quality) +
              " carried exactly one seed, " + in_words(best.multiple) + " more, " + in_words(best.miss) +
              " none (95 % intervals).";
  report.verdict(Report::Verdict::neutral, verdict);
  for (const double at : m.picture_at) {
    const fs::path file = fs::path(options.output) / ("device_" + printed_number(at) + "s.svg");
    if (fs::exists(file))
      report.figure(read_file(file),
                    "After " + printed_number(at) +
                        " s, seen from the seeds' side: seeds carried alone blue, with others "
                        "yellow, laid green; holes under vacuum blue, its arc light blue.");
  }
  report.heading("Seeding quality");
  report.add(stations_plot(record));
  const std::vector<double> gaps = spacings(record.landing_times(), m.forward_speed);
  if (!gaps.empty()) {
    LinePlot plot{"Spacing on the ground", {"number of the gap"}, {"spacing", "m", false, 0.0}};
    LineSeries curve{"this run", {}, gaps};
    for (std::size_t i = 0; i < gaps.size(); ++i) curve.x.push_back(static_cast<double>(i) + 1);
    curve.draw = LineSeries::Draw::both;
    plot.series = {curve};
    plot.horizontal = {{m.target_spacing(), "target"},
                       {0.5 * m.target_spacing(), "multiple below"},
                       {1.5 * m.target_spacing(), "miss above"}};
    plot.caption = "From the times at which seeds leave the guide tube and the forward speed.";
    report.add(plot);
  }
  const Series series = read_series(fs::path(options.output) / "series.csv");
  LinePlot taken{"Holes that carry seeds", {"time", "s"}, {"holes", "1", false, 0.0}};
  taken.series = {{"one seed", series["time"], series["holes with one seed"]},
                  {"more seeds", series["time"], series["holes with more seeds"]}};
  report.add(taken);

  const NamedSeeds seeds = named_seeds(record);
  if (seeds.a >= 0 || seeds.b >= 0) {
    report.heading("Seeds A and B (the paper's Fig. 24)");
    report.paragraph(
        "A: the first seed that a hole carried alone from the pool past the blade, in a short run to the "
        "blade. B: "
        "a seed of the first hole that came to the blade with more than one. Forces are means over a series "
        "interval; the contact force is "
        "what accelerates the seed beside gravity and air.");
    report.figure(radar(record, seeds, "Drag", "N", &SeedSample::drag).svg(), "Drag against time.");
    report.figure(radar(record, seeds, "Pressure force", "N", &SeedSample::pressure).svg(),
                  "Force of the vacuum against time; the paper's model has none.");
    report.figure(radar(record, seeds, "Velocity", "m/s", &SeedSample::speed).svg(),
                  "Velocity against time.");
    report.add(track_plot(record, seeds, "drag", "N", &SeedSample::drag, true));
    report.add(track_plot(record, seeds, "pressure force", "N", &SeedSample::pressure, true));
    report.add(track_plot(record, seeds, "contact force", "N", &SeedSample::contact, true));
    report.add(track_plot(record, seeds, "velocity", "m/s", &SeedSample::speed, false));
  }
  report.heading("Air");
  LinePlot flow{"Air flow", {"time", "s"}, {"flow", "L/s", false, 0.0}};
  LineSeries litres{"fan", series["time"], {}};
  for (const double q : series["air flow"]) litres.y.push_back(1e3 * q);
  flow.series = {litres};
  report.add(flow);
  if (gathered.resolved)
    add_hole_lines(m, options.output, report);
  else
    report.add(axis_plot(m, summary.observable("vacuum")));
  report.add(energy_plot(series, run.n_seeds_at_start()));
  add_numbers(summary, report);
  report.paragraph(
      "`holes.csv`: every way of a hole from the pool with its numbers of seeds; `seed_A.csv`, `seed_B.csv`: "
      "the "
      "two seeds; `landings.csv`: when seeds left the tube.");
  report.write(fs::path(options.output) / "report.html");
}

}  // namespace seedflow
