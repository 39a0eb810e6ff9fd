#include "seedflow/experiment/settling.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "seedflow/base/interrupt.h"
#include "seedflow/experiment/command_of.h"
#include "seedflow/experiment/run_loop.h"
#include "seedflow/experiment/settling_reference.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/report.h"
#include "seedflow/output/summary_tables.h"

namespace seedflow {

namespace {

namespace reference = settling_reference;

std::string fixed(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string name_at(double time) {
  return "velocity_" + fixed(time, 2) + "s";
}

std::vector<double> speeds_of(const Series& seeds, const Vec3& gravity) {
  const Vec3 down = gravity / norm(gravity);
  const auto &x = seeds["velocity x"], &y = seeds["velocity y"], &z = seeds["velocity z"];
  std::vector<double> speed;
  for (std::size_t i = 0; i < x.size(); ++i) speed.push_back(dot(down, {x[i], y[i], z[i]}));
  return speed;
}

void declare(SimulationParameters& simulation, Parameters& parameters, std::string& name) {
  declare_experiment_name(parameters, name);
  simulation.declare(parameters);
}

/// What the result means, one sentence each.
std::vector<std::string> explain(const SimulationParameters& p, const Summary& summary) {
  std::vector<std::string> words;
  const double terminal = summary.observable("terminal_velocity"), sphere = reference::sphere_speed(p);
  const double off = 100 * (terminal / sphere - 1);
  std::ostringstream text;
  text << "**The physical answer.** A whole seed of this size and weight falls at " << fixed(sphere, 4)
       << " m/s (Schiller-Naumann drag, full buoyancy, wide vessel). This run ends at " << fixed(terminal, 4)
       << " m/s, " << fixed(std::abs(off), 1) << " % " << (off > 0 ? "faster" : "slower") << ".";
  words.push_back(text.str());
  text.str("");
  text << "**Stokes' law** (Eq. 10, " << fixed(reference::stokes_speed(p), 3)
       << " m/s) is the paper's theoretical line. It holds for Re << 1; at that speed Re would be "
       << fixed(reference::stokes_speed(p) * p.air.density * p.seeds.model.diameter / p.air.viscosity, 0)
       << ", where the real drag is several times Stokes'. No correct simulation can agree with it.";
  words.push_back(text.str());
  const std::vector<double> table = reference::table_5(p.seeds.model.n_spheres);
  if (!table.empty()) {
    const double volume = M_PI / 6 * std::pow(p.seeds.model.diameter, 3);
    const double most = norm(p.dem.gravity) * (1 - p.air.density / p.seeds.model.density);
    text.str("");
    text << "**Table 5** needs a mean acceleration of " << fixed(table[0] / 0.05, 2)
         << " m/s2 over the first 0.05 s. With the buoyancy of the whole seed (" << fixed(1e9 * volume, 1)
         << " mm3) no drag law can exceed " << fixed(most, 2)
         << " m/s2 in fluid at rest, so Table 5 cannot be reached with full buoyancy.";
    words.push_back(text.str());
  }
  if (p.coupling.drag_on == "sub-sphere")
    words.push_back(
        "**Drag on every sub-sphere** (Eqs. 6-7, the paper's literal model) counts the drag of each "
        "sub-sphere as if it "
        "were alone in the fluid, though most stand in each other's lee: the sum is several times the whole "
        "seed's drag, "
        "and finer models fall slower, the reverse of the paper's trend. Set `Drag on = seed` for the seed's "
        "own drag.");
  else
    words.push_back(
        "**Drag on the whole seed**, shared over its sub-spheres, does not depend on their number.");
  if (p.coupling.undisturbed_velocity == "none" && p.coupling.two_way && p.air_model == "navier-stokes")
    words.push_back(
        "**The seed's own wake** is part of the air velocity that its drag is computed from (no "
        "undisturbed-velocity "
        "correction): the seed drags the fluid of its cells along and falls too fast, by an amount that "
        "depends on the "
        "mesh and on the place in it.");
  if (p.coupling.buoyancy_volume != "seed")
    words.push_back(
        "**Buoyancy** acts on " +
        std::string(p.coupling.buoyancy_volume == "none" ? "no volume at all" : "the sub-spheres' volume") +
        ", not on the seed's: the driving force is larger than in reality.");
  return words;
}

}  // namespace

double settling_speed(const Series& seeds, const Vec3& gravity, double time) {
  const std::vector<double>& t = seeds["time"];
  const std::vector<double> speed = speeds_of(seeds, gravity);
  if (t.empty() || time > t.back() * (1 + 1e-9)) return std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 1; i < t.size(); ++i)
    if (time <= t[i] * (1 + 1e-12))
      return speed[i - 1] + (speed[i] - speed[i - 1]) * (time - t[i - 1]) / (t[i] - t[i - 1]);
  return speed.back();
}

void add_settling_observables(const Series& seeds, const SimulationParameters& p, Summary& summary) {
  for (const double time : reference::table_5_times) {
    const double v = settling_speed(seeds, p.dem.gravity, time);
    if (std::isfinite(v)) summary.observe(name_at(time), v, "m/s");
  }
  // The last twentieth of the run: what is left of an oscillation is averaged out.
  const std::vector<double>& t = seeds["time"];
  const std::vector<double> speed = speeds_of(seeds, p.dem.gravity);
  double sum = 0;
  int n = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (t[i] >= 0.95 * t.back()) sum += speed[i], ++n;
  summary.observe("terminal_velocity", sum / n, "m/s");
  summary.observe("reference_sphere_velocity", reference::sphere_speed(p), "m/s");
  summary.observe("reference_stokes_velocity", reference::stokes_speed(p), "m/s");
  const std::vector<double> table = reference::table_5(p.seeds.model.n_spheres);
  for (std::size_t i = 0; i < table.size(); ++i)
    summary.observe("paper_" + name_at(reference::table_5_times[i]), table[i], "m/s");
}

void write_settling_report(const Series& seeds, const SimulationParameters& p, const Summary& summary,
                           const RunOptions& options) {
  Report report("Settling of one bonded seed", command_of(options), "seedflow");
  std::ostringstream lead;
  lead << "A seed of " << 1e3 * p.seeds.model.diameter << " mm made of " << p.seeds.model.n_spheres
       << " sub-spheres falls from rest through a fluid of density " << p.air.density
       << " kg/m3 and viscosity " << p.air.viscosity << " Pa s (Xu et al. 2024, section 3.2.4).";
  report.lead(lead.str());
  const double terminal = summary.observable("terminal_velocity"), sphere = reference::sphere_speed(p);
  const double off = std::abs(terminal / sphere - 1);
  std::ostringstream verdict;
  verdict << "The seed ends at " << fixed(terminal, 4) << " m/s; a real one would fall at "
          << fixed(sphere, 4) << " m/s (" << fixed(100 * off, 1) << " % apart).";
  report.verdict(off < 0.03   ? Report::Verdict::agrees
                 : off < 0.15 ? Report::Verdict::doubtful
                              : Report::Verdict::disagrees,
                 verdict.str());

  LinePlot plot{"Settling speed", {"time", "s"}, {"speed", "m/s", false, 0.0}};
  const std::vector<double>& t = seeds["time"];
  plot.series.push_back({"this run", t, speeds_of(seeds, p.dem.gravity)});
  std::vector<double> times;
  for (int i = 0; i <= 100; ++i) times.push_back(t.back() * (i + 1e-9) / 100);
  plot.series.push_back({"sphere, wide vessel", times, reference::sphere_start(p, times)});
  const std::vector<double> table = reference::table_5(p.seeds.model.n_spheres);
  if (!table.empty()) {
    LineSeries printed{"Table 5 (simulated in the paper)", reference::table_5_times, table};
    printed.draw = LineSeries::Draw::markers;
    plot.series.push_back(printed);
  }
  plot.horizontal.push_back({reference::stokes_speed(p), "Stokes (Eq. 10)"});
  plot.horizontal.push_back({sphere, "true terminal speed"});
  plot.caption =
      "The sphere's curve has the drag of the whole seed, full buoyancy, added mass and history force. Table "
      "5 holds the "
      "paper's simulated values; nothing was measured.";
  report.add(plot);
  report.heading("What agrees, what cannot, and why");
  report.list(explain(p, summary));

  add_summary_tables(summary, report);
  report.paragraph(
      "For ParaView: `seeds.pvd` (show as Point Gaussian, scaled by radius), `air.pvd`, `walls.vtp`.");
  report.write(std::filesystem::path(options.output) / "report.html");
}

int run_settling(const RunOptions& options) {
  std::string name = "settling";
  SimulationParameters p;
  Parameters parameters;
  declare(p, parameters, name);
  parameters.read(options.prm, options.overrides);
  p.check(parameters);

  const MPI_Comm comm = options.comm;
  const bool writes = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
  const InterruptGuard signals(comm);  // a signal during the set-up is seen before the first step
  if (!options.dry_run) prepare_output_folder(options.output);
  Simulation simulation(p, comm);
  if (options.dry_run) {
    if (writes) std::cout << simulation.describe() << std::flush;
    return exit_done;
  }

  Summary summary;
  summary.text("experiment", name);
  run_to_end(simulation, parameters, options, summary);
  if (simulation.fluid()) summary.observe("air_cells", simulation.n_cells(), "1");
  const std::vector<std::string> idle = p.effects.idle();
  if (writes) {
    const std::filesystem::path folder = options.output;
    const Series seeds = read_series(folder / "seeds.csv");
    add_settling_observables(seeds, p, summary);
    summary.write(folder / "summary.json");
    write_settling_report(seeds, p, summary, options);
    std::cout << "terminal velocity " << summary.observable("terminal_velocity") << " m/s (true "
              << settling_reference::sphere_speed(p) << "), report: " << (folder / "report.html").string()
              << std::endl;
  }
  for (const std::string& effect : idle) {
    const bool wanted = effect == "Pressure gradient" && p.coupling.buoyancy_volume == "none";
    if (!wanted)
      throw RunError(
          "The effect \"" + effect +
          "\" is switched on but added nothing during the whole run.\nRemedy: set its Strength to 0, or "
          "check its inputs.");
  }
  summary.require_conservation();
  return exit_done;
}

void describe_settling(std::ostream& out, const std::string& section) {
  std::string name = "settling";
  SimulationParameters p;
  Parameters parameters;
  declare(p, parameters, name);
  parameters.describe(out, section);
}

}  // namespace seedflow
