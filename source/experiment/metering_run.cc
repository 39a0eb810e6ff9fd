// Experiment "metering" as a user gets it: run, summary, files.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>

#include "seedflow/experiment/granular_report.h"
#include "seedflow/experiment/metering_map.h"
#include "seedflow/experiment/metering_report.h"

namespace seedflow {

namespace {

namespace fs = std::filesystem;

void write_track(const std::vector<SeedSample>& track, const fs::path& file) {
  Series s{{{"time", "s"},
            {"x", "m"},
            {"y", "m"},
            {"z", "m"},
            {"velocity", "m/s"},
            {"drag", "N"},
            {"pressure force", "N"},
            {"contact force", "N"},
            {"hole"}},
           std::vector<std::vector<double>>(9)};
  for (const SeedSample& p : track) {
    const double row[] = {p.time, p.x, p.y, p.z, p.speed, p.drag, p.pressure, p.contact, 1.0 * p.hole};
    for (int c = 0; c < 9; ++c) s.values[c].push_back(row[c]);
  }
  write_series(file, s);
}

void observe_indices(const std::string& where, const SeedingIndices& i, Summary& summary) {
  summary.observe(where + "_n", i.n, "1");
  const auto count = [&](const Share& s) { return std::round(s.value * i.n); };
  summary.observe(where + "_good_n", count(i.quality), "1");
  summary.observe(where + "_multiple_n", count(i.multiple), "1");
  summary.observe(where + "_miss_n", count(i.miss), "1");
  if (i.n == 0) return;
  const auto share = [&](const std::string& name, const Share& s) {
    summary.observe(where + "_" + name, 100 * s.value, "%");
    summary.observe(where + "_" + name + "_low", 100 * s.low, "%");
    summary.observe(where + "_" + name + "_high", 100 * s.high, "%");
  };
  share("quality", i.quality);
  share("multiple", i.multiple);
  share("miss", i.miss);
}

/// Mean force of the vacuum on seeds that are carried alone behind the pool [N].
double mean_holding_force(const Metering& m, const SeedingRecord& record) {
  double sum = 0;
  int n = 0;
  for (const Passage& p : record.passages()) {
    if (p.cleaned != 1 || p.seeds.size() != 1) continue;
    for (const SeedSample& s : record.track(static_cast<int>(p.seeds[0])))
      if (s.hole == p.hole && std::atan2(s.y, s.x) > m.stations().carried) sum += s.pressure, ++n;
  }
  return n > 0 ? sum / n : 0;
}

/// What computing the air adds, for --dry-run: rate and memory as measured in the sector and in the whole
/// device.
std::string air_cost(const Metering& metering) {
  const double cells = double(device_domain(metering.device, metering.resolved.mesh, MPI_COMM_WORLD)
                                  .triangulation()
                                  .n_global_active_cells()),
               steps = metering.granular.end_time / metering.suction.air_step;
  int cores = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &cores);
  std::ostringstream text;
  text << "Air:        " << std::llround(cells) << " cells, " << std::llround(steps) << " steps of "
       << metering.suction.air_step << " s: about " << std::ceil(cells * steps / 3.5e4 / cores / 60)
       << " min and " << std::ceil(200 + 0.017 * cells) << " MiB more\n";
  return text.str();
}

}  // namespace

/// Pressure and velocity along the axis of a hole.
struct HoleLine {
  std::string file;
  Series values;
};

/// Of a hole with a seed and of an open one under the vacuum, both behind the pool if there are such.
/// Collective.
std::vector<HoleLine> lines_through_holes(const Metering& m, const Metering::Gathered& gathered,
                                          double time) {
  std::vector<HoleLine> lines;
  if (!gathered.resolved) return lines;
  for (const bool covered : {false, true}) {
    int hole = -1;
    double best = -1;
    for (int k = 0; k < m.device.n_holes(); ++k) {
      const double angle = m.device.hole_angle(k, m.turned_at(time));
      if (m.device.exposure(angle) < 1 || (gathered.record.carried_now()[k] > 0) != covered) continue;
      // Farthest from the bottom, where other seeds stand around the hole.
      const double away = std::abs(std::remainder(angle + 0.5 * M_PI, 2 * M_PI));
      if (away > best) best = away, hole = k;
    }
    if (hole < 0) continue;
    HoleLine line{
        covered ? "hole_with_seed.csv" : "open_hole.csv",
        {{{"z", "m"}, {"pressure", "Pa"}, {"velocity", "m/s"}}, std::vector<std::vector<double>>(3)}};
    for (const auto& p : gathered.resolved->along_hole(hole)) {
      line.values.values[0].push_back(p.z);
      line.values.values[1].push_back(p.pressure);
      line.values.values[2].push_back(p.velocity);
    }
    lines.push_back(line);
  }
  return lines;
}

/// Limits: solver tolerances for the air, round-off for what is bookkeeping.
void add_computed_air(const ResolvedSuction& air, Summary& summary) {
  const ResolvedSuction::Tally& t = air.totals();
  const MomentumLedger ledger = air.momentum();
  summary.conserve("air mass, every pressure test function, worst step", t.mass_error, 1e-6);
  summary.conserve("air through ambient against suction, worst step", t.volume_error, 1e-5);
  summary.conserve("air out of the rotor against into the stator, worst step", t.interface_error, 1e-8);
  // With a frozen rotor the air's books hold rho omega x u of the turning frame beside what the seeds give.
  const double frozen = air.is_frozen() ? std::numeric_limits<double>::infinity() : 1;
  summary.conserve("momentum exchange seeds - air", ledger.exchange_error(), 1e-9 * frozen);
  summary.conserve("momentum of seeds, air and walls", ledger.total_error(), 1e-6 * frozen);
  summary.observe("air_cells", air.n_cells(), "1");
  summary.observe("air_steps", t.steps, "1");
  summary.observe("largest_courant_number", t.courant, "1");
  summary.observe("pressure_iterations_per_step", t.pressure_iterations / std::max(1.0, t.steps), "1");
  summary.observe("momentum_iterations_per_step", t.momentum_iterations / std::max(1.0, t.steps), "1");
  summary.observe("most_bodies_outside_the_air_mesh", t.most_outside, "1");
  const Vec3 still = ledger.sum.still_air;
  summary.observe("impulse_of_still_air_outside", norm(still), "N s");
  const FluidStatistics s = air.statistics();
  const double own = std::max(t.seconds, 1e-9);
  summary.observe("part_of_time_air", 100 * t.seconds_in_air / own, "%");
  summary.observe("part_of_time_seeds", 100 * t.seconds_in_seeds / own, "%");
  summary.observe("part_of_time_coupling", 100 * (1 - (t.seconds_in_air + t.seconds_in_seeds) / own), "%");
  const double of_air = s.momentum_assembly + s.momentum_solve + s.pressure_assembly + s.pressure_setup +
                        s.pressure_solve + s.update + s.turning;
  summary.observe("part_of_air_step_turning", 100 * s.turning / std::max(of_air, 1e-9), "%");
  summary.performance.cell_steps_per_second_per_core =
      air.n_cells() * t.steps / std::max(t.seconds_in_air, 1e-9);
}

std::vector<int> counts(const SeedingRecord& record, int Passage::*station) {
  std::vector<int> result;
  for (const Passage& p : record.passages())
    if (p.*station >= 0) result.push_back(p.*station);
  return result;
}

NamedSeeds named_seeds(const SeedingRecord& record) {
  NamedSeeds named;
  for (const bool past_the_blade : {true, false})  // a short run has holes before the blade only
    for (const Passage& p : record.passages()) {
      if (p.seeds.empty() || (past_the_blade && p.cleaned < 0)) continue;
      long stays = -1;  // the first of them that the blade leaves
      for (const long label : p.seeds)
        if (stays < 0 && std::count(p.kept.begin(), p.kept.end(), label)) stays = label;
      if (named.a < 0 && p.carried == 1 && (stays >= 0 || !past_the_blade)) named.a = p.seeds[0];
      if (named.b < 0 && p.carried > 1) named.b = stays >= 0 ? stays : p.seeds[0];
    }
  return named;
}

void add_seeding(const Metering& m, const Metering::Gathered& gathered, double time, Summary& summary) {
  const SeedingRecord& record = gathered.record;
  observe_indices("before_blade", indices_of_counts(counts(record, &Passage::carried)), summary);
  observe_indices("behind_blade", indices_of_counts(counts(record, &Passage::cleaned)), summary);
  observe_indices("unloading", indices_of_counts(counts(record, &Passage::unloaded)), summary);
  const SeedingIndices ground =
      indices_of_spacings(spacings(record.landing_times(), m.forward_speed), m.target_spacing());
  observe_indices("ground", ground, summary);
  if (ground.n > 0) summary.observe("ground_precision", 100 * ground.precision, "%");
  summary.observe("target_spacing", m.target_spacing(), "m");
  summary.observe("holes_per_second", m.holes_per_second(), "1/s");
  summary.observe("seeds_laid", static_cast<double>(record.landing_times().size()), "1");
  const double n = static_cast<double>(std::max(1L, gathered.intervals));
  summary.observe("vacuum", gathered.suction_sum / n, "Pa");
  summary.observe("air_flow", gathered.air_drawn() / time, "m3/s");
  summary.observe("air_power", gathered.work() / time, "W");
  summary.observe("holding_force", mean_holding_force(m, record), "N");
  const CoveredHole seat(m.device.hole_radius(), m.device.chamfer, 0.5 * m.granular.model.diameter);
  summary.observe("pressure_times_hole_area", gathered.suction_sum / n * m.device.hole_area(), "N");
  summary.observe("pressure_times_seat_area",
                  gathered.suction_sum / n * M_PI * seat.seat_radius * seat.seat_radius, "N");
  // Round-off of a sum over the holes.
  if (gathered.sinks)
    summary.conserve("air of holes and leak against the fan's", gathered.sinks->largest_flow_error(), 1e-10);
  if (gathered.resolved) add_computed_air(*gathered.resolved, summary);
}

void write_seeding_files(const Metering::Gathered& gathered, const fs::path& folder) {
  const SeedingRecord& record = gathered.record;
  std::ostringstream holes;
  holes << "hole,begun [s],before the blade,behind the blade,at unloading\n";
  for (const Passage& p : record.passages())
    holes << p.hole << "," << p.begun << "," << p.carried << "," << p.cleaned << "," << p.unloaded << "\n";
  write_file_atomically(folder / "holes.csv", holes.str());
  write_series(folder / "landings.csv", {{{"time", "s"}}, {record.landing_times()}});
  const NamedSeeds seeds = named_seeds(record);
  if (seeds.a >= 0) write_track(record.track(static_cast<int>(seeds.a)), folder / "seed_A.csv");
  if (seeds.b >= 0) write_track(record.track(static_cast<int>(seeds.b)), folder / "seed_B.csv");
}

MeteringInput::MeteringInput(const RunOptions& options) {
  experiment.granular.materials = MaterialTable::named_in(options.prm, options.overrides);
}

void MeteringInput::declare(Parameters& p) {
  declare_experiment_name(p, name);
  experiment.declare(p);
  map.declare(p);
}

int run_metering(const RunOptions& options) {
  MeteringInput input(options);
  Parameters parameters;
  input.declare(parameters);
  parameters.read(options.prm, options.overrides);
  Metering& metering = input.experiment;
  metering.check(parameters);
  Metering::Gathered gathered(metering, metering.effects);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const GranularScene scene = metering.scene(
      gathered, rank == 0 && !options.dry_run ? fs::path(options.output) : fs::path(), options.output);
  GranularJob job(parameters, options, metering.granular, scene);
  if (options.dry_run) {
    const std::string air = metering.air_model == "resolved" ? air_cost(metering) : "";
    const int status = job.say_what_it_will_be();
    if (rank == 0) std::cout << air << std::flush;
    return status;
  }
  Summary summary;
  summary.text("experiment", "metering");
  summary.text("air", metering.air_model);
  job.run.carry_out(parameters, options, summary);
  add_seeding(metering, gathered, job.run.time(), summary);
  const std::vector<HoleLine> lines = lines_through_holes(metering, gathered, job.run.time());
  return job.finish(summary, [&] {
    write_seeding_files(gathered, options.output);
    for (const HoleLine& line : lines) write_series(fs::path(options.output) / line.file, line.values);
    write_metering_report(metering, gathered, job.run, summary, options);
    const SeedingIndices behind = indices_of_counts(counts(gathered.record, &Passage::cleaned));
    std::cout << "behind the blade: " << behind.n << " holes";
    if (behind.n > 0)
      std::cout << ", one seed " << in_words(behind.quality) << ", more " << in_words(behind.multiple)
                << ", none " << in_words(behind.miss);
    std::cout << std::endl;
  });
}

void describe_metering(std::ostream& out, const std::string& section) {
  MeteringInput input;
  Parameters parameters;
  input.declare(parameters);
  parameters.describe(out, section);
}

}  // namespace seedflow
