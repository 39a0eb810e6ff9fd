#include "seedflow/experiment/settling_study.h"

#include <chrono>
#include <cmath>
#include <iostream>
#include <sstream>

#include "seedflow/base/interrupt.h"
#include "seedflow/experiment/settling_reference.h"
#include "seedflow/experiment/simulation.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/progress.h"
#include "seedflow/output/series.h"
#include "seedflow/output/summary.h"

namespace seedflow {

namespace {

constexpr double single_sphere_diameter = 0.3e-3;  // of Fig. 20 [m]

double at_time(const SettlingResult& r, double time) {
  for (std::size_t i = 1; i < r.time.size(); ++i)
    if (time <= r.time[i] * (1 + 1e-9))
      return r.speed[i - 1] +
             (r.speed[i] - r.speed[i - 1]) * (time - r.time[i - 1]) / (r.time[i] - r.time[i - 1]);
  return std::numeric_limits<double>::quiet_NaN();
}

void fill_table_times(SettlingResult& r) {
  for (std::size_t i = 0; i < r.at.size(); ++i) r.at[i] = at_time(r, settling_reference::table_5_times[i]);
}

/// One run as a small CSV: the speeds, and in the last row the figures that are not a series.
void save_result(const SettlingResult& r, const std::filesystem::path& file) {
  const std::size_t n = r.time.size();
  write_series(
      file,
      {{{"time", "s"}, {"speed", "m/s"}, {"wall time", "s"}, {"mass error", "1"}, {"momentum error", "1"}},
       {r.time, r.speed, std::vector<double>(n, r.seconds), std::vector<double>(n, r.largest_mass_error),
        std::vector<double>(n, r.total_momentum_error)}});
}

SettlingResult load_result(const SettlingCase& setting, const std::filesystem::path& file) {
  const Series s = read_series(file);
  SettlingResult r;
  r.setting = setting;
  r.time = s["time"];
  r.speed = s["speed"];
  r.seconds = s["wall time"].back();
  r.largest_mass_error = s["mass error"].back();
  r.total_momentum_error = s["momentum error"].back();
  fill_table_times(r);
  return r;
}

std::vector<SettlingCase> all_cases(const SettlingStudyParameters& study) {
  std::vector<SettlingCase> cases;
  for (const std::string& drag : study.drag)
    for (const std::string& reading : study.readings)
      for (const std::string& buoyancy : drag == "seed" ? std::vector<std::string>{"seed"} : study.buoyancy)
        for (const std::string& place : study.places)
          for (const double n : study.models)
            cases.push_back({static_cast<int>(n), reading, drag, buoyancy, place});
  return cases;
}

struct StudyInput {
  std::string name = "settling study";
  SettlingStudyParameters study;
  SimulationParameters base;

  void declare(Parameters& p) {
    declare_experiment_name(p, name);
    study.declare(p);
    base.declare(p);
  }
};

/// The parameters of the single small sphere that Fig. 20 compares with.
void make_single_sphere(SimulationParameters& p) {
  p.seeds.model.n_spheres = 1;
  p.seeds.model.diameter = single_sphere_diameter;
  p.seeds.model.sphere_radius = 0.5 * single_sphere_diameter;
  // The same step as the seeds, two thirds of this light sphere's Rayleigh time: stable, and it touches
  // nothing.
  p.dem.limits.rayleigh_fraction = 0.9;
  p.dem.limits.hertz_fraction = 0.5;
  apply({1, "radius", "sub-sphere", "seed", "edge"}, p);
}

}  // namespace

void SettlingStudyParameters::declare(Parameters& p) {
  const auto section = p.section("Study", "Every combination of these lists is one run.");
  p.numbers("Models", models, "1", Range::between(1, 2000), "Numbers of sub-spheres.");
  p.choices("Readings", readings, {"radius", "diameter"}, "Table 2's sizes read as radius or as diameter.");
  p.choices("Drag on", drag, {"sub-sphere", "seed"},
            "'sub-sphere' runs the paper's literal model, 'seed' the model of the section Coupling.");
  p.choices(
      "Buoyancy volumes", buoyancy, {"seed", "sub-spheres", "none"},
      "For the literal model, which does not say what buoyancy acts on; seed drag always has the seed's.");
  p.choices(
      "Places", places, {"edge", "centre"},
      "Where the axis of the fall lies in the grid: at Seeds/Position, or half a cell beside it in x and y.");
  p.flag("Cost", cost, "Also time a single sphere of 0.3 mm, the unit of the paper's Fig. 20.");
}

std::string SettlingCase::name() const {
  return "N" + std::to_string(n_sub_spheres) + "_" + reading + "_" + drag_on + "_" + buoyancy + "_" + place;
}

void apply(const SettlingCase& c, SimulationParameters& p) {
  p.seeds.model.n_spheres = c.n_sub_spheres;
  p.seeds.model.reading = c.reading;
  if (c.place == "centre")
    for (int d = 0; d < 2; ++d)
      p.seeds.position[d] += 0.5 * (p.domain.upper[d] - p.domain.lower[d]) / p.domain.cells[d];
  p.coupling.drag_on = c.drag_on;
  p.coupling.buoyancy_volume = c.buoyancy;
  if (c.drag_on == "sub-sphere") {
    p.coupling.exchange_kernel = "cell";
    p.coupling.void_fraction_kernel = "sampled";
    p.coupling.solid_volume = "sub-spheres";
    p.coupling.undisturbed_velocity = "none";
    // One velocity per cell, as in the paper's finite volumes.
    p.air.subscales = "dynamic";
    p.effects["Drag"].set_choice("Law", "As printed");
  }
  if (c.buoyancy == "none") p.effects["Pressure gradient"].set_strength(0);
}

SettlingResult run_settling_case(const SettlingCase& setting, SimulationParameters& p, MPI_Comm comm) {
  Simulation simulation(p, comm);
  SettlingResult r;
  r.setting = setting;
  const long n_steps = std::lround(std::ceil(p.run.end_time / p.run.air_step - 1e-9));
  const double dt = p.run.end_time / n_steps;
  const Vec3 down = p.dem.gravity / norm(p.dem.gravity);
  r.time = {0};
  r.speed = {dot(p.seeds.velocity, down)};
  InterruptGuard signals(comm);
  const auto begin = std::chrono::steady_clock::now();
  for (long step = 0; step < n_steps; ++step) {
    simulation.advance(dt);
    const MassBalance& mass = simulation.fluid()->mass_balance();
    r.largest_mass_error = std::max({r.largest_mass_error, mass.largest, mass.total});
    r.time.push_back(simulation.time());
    r.speed.push_back(dot(simulation.dem().seed_state(0).velocity, down));
    signals.check();
  }
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  r.total_momentum_error = simulation.coupled()->momentum().total_error();
  fill_table_times(r);
  return r;
}

int run_settling_study(const RunOptions& options) {
  StudyInput input;
  Parameters parameters;
  input.declare(parameters);
  parameters.read(options.prm, options.overrides);
  input.base.check(parameters);
  if (input.base.air_model != "navier-stokes")
    parameters.reject("Air/Model", "the study couples seeds and air", "set it to navier-stokes");
  const MPI_Comm comm = MPI_COMM_WORLD;
  const int rank = dealii::Utilities::MPI::this_mpi_process(comm);
  const std::vector<SettlingCase> cases = all_cases(input.study);

  const InterruptGuard signals(comm);  // also while the cases are built
  // All cases are built once before the first runs, so that bad input is found now.
  for (const SettlingCase& c : cases) {
    SimulationParameters p = input.base;
    apply(c, p);
    const Simulation check(p, comm);
    if (options.dry_run && rank == 0) std::cout << c.name() << "\n" << check.describe() << std::endl;
  }
  if (options.dry_run) return exit_done;
  const std::filesystem::path folder = options.output, runs = folder / "runs";
  prepare_output_folder(folder);
  prepare_output_folder(runs);
  if (rank == 0) {
    std::ostringstream used;
    parameters.write(used);
    write_file_atomically(folder / "used.prm", used.str());
  }

  const auto result_of = [&](const SettlingCase& c, const std::filesystem::path& file,
                             SimulationParameters& p) {
    if (options.resume && std::filesystem::exists(file)) return load_result(c, file);
    const SettlingResult r = run_settling_case(c, p, comm);
    if (rank == 0) save_result(r, file);
    return r;
  };
  Progress progress("runs", static_cast<double>(cases.size()), 0, rank);
  std::vector<SettlingResult> results;
  for (const SettlingCase& c : cases) {
    SimulationParameters p = input.base;
    apply(c, p);
    results.push_back(result_of(c, runs / (c.name() + ".csv"), p));
    progress.update(static_cast<double>(results.size()), c.name());
  }
  double single_sphere_seconds = 0;
  if (input.study.cost) {
    SimulationParameters p = input.base;
    make_single_sphere(p);
    single_sphere_seconds =
        result_of({1, "radius", "sub-sphere", "seed", "edge"}, runs / "single_sphere.csv", p).seconds;
  }
  progress.finish();

  if (rank == 0) write_settling_study(results, single_sphere_seconds, input.base, options);
  Summary summary;
  summary.text("experiment", input.name);
  double wall_time = single_sphere_seconds, mass = 0, momentum = 0;
  for (const SettlingResult& r : results) {
    summary.observe(r.setting.name(), r.speed.back(), "m/s");
    wall_time += r.seconds;
    mass = std::max(mass, r.largest_mass_error);
    momentum = std::max(momentum, r.total_momentum_error);
  }
  summary.conserve("air mass, every pressure test function, worst step of all runs", mass, 1e-8);
  summary.conserve("momentum of seeds, air and walls, worst run", momentum, 1e-8);
  summary.performance.wall_time_s = wall_time;
  summary.performance.peak_memory_MiB = peak_memory_MiB(comm);
  if (rank == 0) summary.write(folder / "summary.json");
  summary.require_conservation();
  return exit_done;
}

void describe_settling_study(std::ostream& out, const std::string& section) {
  StudyInput input;
  Parameters parameters;
  input.declare(parameters);
  parameters.describe(out, section);
}

}  // namespace seedflow
