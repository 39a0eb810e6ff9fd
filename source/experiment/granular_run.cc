#include "seedflow/experiment/granular_run.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "seedflow/base/binary.h"
#include "seedflow/base/together.h"
#include "seedflow/experiment/granular_recorder.h"
#include "seedflow/seeds/feeder.h"
#include "seedflow/seeds/resting_tilt.h"

namespace seedflow {

namespace {

constexpr double shortest_filling = 0.1;      // [s], seeds are at rest in the air at first
constexpr double shortest_resettling = 0.05;  // [s], of a filling from the cache

/// Rounded to a tenth.
double degrees(double radians) {
  return std::round(1800 / M_PI * radians) / 10;
}

}  // namespace

GranularRun::GranularRun(const GranularParameters& p, const GranularScene& the_scene, MPI_Comm communicator)
    : parameters(p), scene(the_scene), comm(communicator), seeds(p.dem, communicator) {
  MPI_Comm_rank(comm, &rank);
  parameters.materials.apply(seeds);
  for (const Wall& wall : scene.walls) seeds.add_wall(wall);
  seeds.set_domain(scene.low, scene.high);
  add_seeds();
  seeds.check();
  if (parameters.air_drag.settings().strength > 0) air.emplace(parameters.air_drag, parameters.dem.gravity);
}

void GranularRun::add_seeds() {
  std::vector<FeederParameters::Kind> kinds;
  double bounding_radius = 0, mass = 0;
  const int material = parameters.materials.number(parameters.seed_material);
  for (const SeedTemplate& model : parameters.templates()) {
    kinds.emplace_back(seeds.add_template(model, material, parameters.rigid), model);
    bounding_radius = std::max(bounding_radius, model.bounding_radius);
    mass += model.mass;
  }
  const double n = std::max(1.0, parameters.mass / mass * static_cast<double>(kinds.size()));
  double share = 0;
  for (std::size_t i = 0; i < scene.rooms.size(); ++i) {
    const FillingRoom& room = scene.rooms[i];
    FeederParameters feeding;
    feeding.name = room.name;
    feeding.places = LatticePlaces{room.low, room.high, 2.2 * bounding_radius, 0.8};
    feeding.kinds = kinds;
    feeding.number = static_cast<int>(std::lround((share + room.share) * n) - std::lround(share * n));
    feeding.first_group = room.group;
    feeding.random_number =
        static_cast<int>(scene.rooms.size()) * parameters.random_number + static_cast<int>(i);
    share += room.share;
    Feeder(feeding).feed(seeds);
  }
  n_at_start = seeds.n_seeds();
}

double GranularRun::time() const {
  return start_time < 0 ? seeds.time() - parameters.longest_filling : seeds.time() - start_time;
}

bool GranularRun::at_rest() const {
  const double shortest = settling_since > 0 ? shortest_resettling : shortest_filling;
  return seeds.time() - settling_since >= shortest - 1e-9 &&
         kinetic_energy_per_seed(seeds) < parameters.rest_energy;
}

void GranularRun::advance() {
  const auto walls_gave = [this] {
    Vec3 sum;
    for (const Vec3& impulse : seeds.wall_impulses()) sum += impulse;
    return sum;
  };
  double mass = 0;
  for (const double m : seeds.masses()) mass += m;
  const Vec3 momentum = seeds.momentum(), given = walls_gave();
  const double dt = parameters.series_interval;
  Vec3 from_outside;
  if (start_time >= 0 && scene.advance)
    from_outside = scene.advance(seeds, dt);
  else if (start_time >= 0 && air)
    from_outside = air->advance(seeds, dt);
  else
    seeds.advance(dt);
  momentum_error += (seeds.momentum() - momentum) - (walls_gave() - given) - from_outside -
                    mass * dt * parameters.dem.gravity;
  weight_impulse += mass * dt * norm(parameters.dem.gravity);
}

void GranularRun::begin(double start) {
  start_time = start;
  if (scene.begin) scene.begin(seeds, start);
}

void GranularRun::save(CheckpointWriter& checkpoint) const {
  std::ostream& state = checkpoint.stream("granular");
  std::vector<long> labels;
  for (int s = 0; s < seeds.n_seeds(); ++s) labels.push_back(seeds.seed_label(s));
  write_binary(state, labels);
  write_binary(state, start_time);
  write_binary(state, settling_since);
  write_binary(state, intervals);
  write_binary(state, momentum_error);
  write_binary(state, weight_impulse);
  if (scene.save) scene.save(state);
  if (air && start_time >= 0) air->save(checkpoint.stream("air"));
  seeds.save(checkpoint.stream("seeds"));
}

void GranularRun::load(CheckpointReader& checkpoint) {
  std::istream& state = checkpoint.stream("granular");
  std::vector<long> labels;
  read_binary(state, labels);
  read_binary(state, start_time);
  read_binary(state, settling_since);
  read_binary(state, intervals);
  read_binary(state, momentum_error);
  read_binary(state, weight_impulse);
  if (scene.load) scene.load(state);
  std::vector<int> gone;  // seeds that had left when the state was saved
  for (int s = 0; s < seeds.n_seeds(); ++s)
    if (!std::binary_search(labels.begin(), labels.end(), seeds.seed_label(s))) gone.push_back(s);
  seeds.remove_seeds(gone);
  seeds.load(checkpoint.stream("seeds"));
  if (air && start_time >= 0) air->load(checkpoint.stream("air"));
  if (start_time >= 0) begin(start_time);
}

bool GranularRun::use_cached_filling(const Parameters& p) {
  if (parameters.cache.empty() || !checkpoint_exists(parameters.cache)) return false;
  CheckpointReader cached(parameters.cache, comm);
  std::vector<std::string> may_change = scene.not_of_filling;
  may_change.insert(may_change.end(), {"Experiment", "Run/", "Filling/Cache", "Study/", "Effects/Air drag/"});
  cached.require_same_parameters(as_text(p), may_change);
  cached.read([&] { load(cached); });
  return true;
}

void GranularRun::fill(const Parameters& p, SupervisedRun& run) {
  const bool cached = settling_since == 0 && seeds.time() == 0 && use_cached_filling(p);
  LongWork filling;
  filling.label = "filling";
  filling.end = parameters.longest_filling;
  filling.checkpoint_interval = parameters.checkpoint_interval;
  filling.time = [this] { return seeds.time(); };
  filling.finished = [this] { return at_rest(); };
  filling.note = [this] {
    std::ostringstream note;
    note.precision(2);
    note << kinetic_energy_per_seed(seeds) << " J per seed";
    return note.str();
  };
  filling.advance = [this] {
    if (seeds.time() - settling_since > parameters.longest_filling) {
      std::ostringstream text;
      text << "The filling did not come to rest within " << parameters.longest_filling
           << " s: kinetic energy " << kinetic_energy_per_seed(seeds)
           << " J per seed.\nRemedy: a longer Filling/Longest time, a larger Filling/Rest energy, or rolling "
              "friction (EPSD comes to rest).";
      throw RunError(text.str());
    }
    advance();
  };
  if (!cached && settling_since == 0) {
    run.carry_out(filling);
    settling_since = seeds.time();
    if (!parameters.cache.empty()) {
      CheckpointWriter cache(parameters.cache, seeds.time(), as_text(p), comm);
      save(cache);
      cache.commit();
    }
  }
  // With a cache every run, the one that made it too, settles once more from the cached state: an inclination
  // or a gravity may have changed.
  if (!parameters.cache.empty()) run.carry_out(filling);
  begin(seeds.time());
}

void GranularRun::carry_out(const Parameters& p, const RunOptions& options, Summary& summary) {
  SupervisedRun run(p, options, comm, [this](CheckpointWriter& c) { save(c); });
  if (options.resume) {
    std::vector<std::string> may_change = scene.only_measuring;
    may_change.insert(may_change.end(),
                      {"Run/End time", "Run/Checkpoint interval", "Filling/Cache", "Study/"});
    run.resume([this](CheckpointReader& c) { load(c); }, may_change);
  }
  std::optional<double> resumed;
  if (start_time >= 0) resumed = time();
  if (!resumed) fill(p, run);

  GranularRecorder recorder(parameters, scene, seeds, options.output, comm, resumed);
  const auto record = [&] { recorder.record(seeds, time()); };
  if (!resumed) record();
  const long n_intervals =
      std::max(1L, std::lround(std::ceil(parameters.end_time / parameters.series_interval - 1e-9)));
  LongWork work;
  work.end = parameters.end_time;
  work.checkpoint_interval = parameters.checkpoint_interval;
  work.time = [this] { return time(); };
  work.finished = [&] {
    return intervals >= n_intervals || (intervals > 0 && scene.finished && scene.finished(seeds, time()));
  };
  work.advance = [&] {
    advance();
    ++intervals;
    if (scene.after_interval) scene.after_interval(seeds, time());
    record();
  };
  run.carry_out(work);
  add_balances(run.wall_time(), summary);
}

void GranularRun::add_balances(double wall_time, Summary& summary) const {
  if (const std::string notice = parameters.materials.notice(); !notice.empty())
    summary.text("notice", notice);
  // Round-off of forces a thousand times the weight over 1e6 steps; runs of full size show 1e-12.
  summary.conserve(
      air ? "momentum of the seeds, gravity, walls and air" : "momentum of the seeds, gravity and walls",
      norm(momentum_error) / std::max(weight_impulse, 1e-300), 1e-9);
  summary.observe("time", time(), "s");
  summary.observe("filling_time", start_time, "s");
  summary.observe("seeds", n_at_start, "1");
  if (air) {
    summary.observe("air_drag_over_weight", air->share_of_weight(), "1");
    summary.observe("air_drag_impulse", norm(air->impulse()), "N s");
  }
  if (const auto tilt = seeds.n_seeds() > 0 ? resting_tilt(seeds.seed_template(0)) : std::nullopt)
    summary.observe("resting_tilt", 180 / M_PI * tilt->mean, "deg");
  summary.observe("kinetic_energy_per_seed", seeds.n_seeds() > 0 ? kinetic_energy_per_seed(seeds) : 0, "J");
  int cores = 1;
  MPI_Comm_size(comm, &cores);
  summary.performance.wall_time_s = wall_time;
  summary.performance.peak_memory_MiB = peak_memory_MiB(comm);
  summary.performance.sub_sphere_steps_per_second_per_core =
      static_cast<double>(seeds.n_substeps()) * seeds.n_spheres() / std::max(wall_time, 1e-9) / cores;
}

void GranularRun::require_action() const {
  if (air && !air->acted())
    throw RunError(
        "The effect \"Air drag\" is switched on but added nothing during the whole run: no seed "
        "moved.\nRemedy: "
        "set its Strength to 0, or check what should set the seeds in motion.");
}

std::string GranularRun::describe() const {
  std::ostringstream text;
  const double time = parameters.end_time + 0.4 /* typical filling */;
  const double steps = time / parameters.dem.time_step;
  text << "Seeds:      " << seeds.n_seeds() << " x " << seeds.seed_template(0).n_spheres()
       << " sub-spheres = " << seeds.n_spheres() << ", "
       << (parameters.rigid || seeds.seed_template(0).n_spheres() == 1
               ? "rigid"
               : "bonded by " + std::to_string(seeds.seed_template(0).bond.size()) + " bonds each")
       << "\n";
  if (const auto tilt = resting_tilt(seeds.seed_template(0)))
    text << "Rolling:    such a seed stands still on slopes of " << degrees(tilt->mean)
         << " degrees on average (" << degrees(tilt->smallest) << " to " << degrees(tilt->largest)
         << "), whatever the coefficient of rolling friction\n";
  text << "Walls:      ";
  for (std::size_t w = 0; w < scene.walls.size(); ++w) text << (w > 0 ? ", " : "") << scene.walls[w].name;
  text << "\nSteps:      about " << std::llround(steps) << " of at most " << parameters.dem.time_step
       << " s for " << time << " s; limits:\n";
  for (const TimeStepLimit& limit : seeds.time_step_limits())
    text << "            " << limit.step() << " s, " << limit.cause
         << " (used: " << 100 * parameters.dem.time_step / limit.step() << " %)\n";
  int cores = 1;
  MPI_Comm_size(comm, &cores);
  // Sub-sphere steps per second and core of settled heaps, as benchmarked; a sphere that is a seed by itself
  // has contacts all over.
  const double rate = seeds.seed_template(0).n_spheres() == 1 ? 6e6 : parameters.rigid ? 3e7 : 2e7;
  const double seconds = steps * seeds.n_spheres() / rate / cores;
  text << "Memory:     about " << 100 + seeds.bytes() / 1048576 << " MiB\nWall time:  about ";
  if (seconds < 120)
    text << std::ceil(seconds) << " s";
  else
    text << std::ceil(seconds / 60) << " min";
  text << " on " << cores << (cores > 1 ? " cores\n" : " core\n");
  return text.str();
}

}  // namespace seedflow
