#include "seedflow/experiment/recorder.h"

#include <cmath>

#include "seedflow/base/together.h"

namespace seedflow {

namespace {

void write_box(const Vec3& a, const Vec3& b, const std::filesystem::path& file) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z});
  Polygons(corners, {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}})
      .write(file);
}

/// The first multiple of `interval` not before `time`, counted in intervals; a step's round-off does not
/// matter.
long due(double time, double interval) {
  return static_cast<long>(std::floor(time / interval + 1e-6));
}

}  // namespace

std::vector<Column> seed_columns(int n_seeds) {
  std::vector<Column> columns = {{"time", "s"}};
  const struct {
    const char *name, *unit;
  } vectors[] = {
      {"position", "m"}, {"velocity", "m/s"}, {"spin", "rad/s"}, {"air force", "N"}, {"air velocity", "m/s"}};
  for (int s = 0; s < n_seeds; ++s) {
    const std::string of = n_seeds > 1 ? " of seed " + std::to_string(s) : "";
    for (const auto& v : vectors)
      for (const char* axis : {" x", " y", " z"})
        columns.push_back({v.name + std::string(axis) + of, v.unit});
    columns.push_back({"void fraction" + of, "1"});
  }
  return columns;
}

Recorder::Recorder(const Simulation& simulation, const std::filesystem::path& folder,
                   std::optional<double> resume_time)
    : folder(folder),
      comm(simulation.communicator()),
      writes(dealii::Utilities::MPI::this_mpi_process(simulation.communicator()) == 0),
      series_interval(simulation.settings().run.series_interval),
      field_interval(simulation.settings().run.field_interval) {
  if (resume_time) {
    next_row = due(*resume_time, series_interval) + 1;
    if (field_interval > 0) next_field = due(*resume_time, field_interval) + 1;
  }
  together(comm, [&] {
    if (writes) open(simulation, resume_time);
  });
}

void Recorder::open(const Simulation& simulation, std::optional<double> resume_time) {
  const std::vector<Column> columns = seed_columns(simulation.dem().n_seeds());
  const auto csv = folder / "seeds.csv", seeds_file = folder / "seeds.pvd", air_file = folder / "air.pvd";
  if (resume_time)
    series.emplace(csv, columns, *resume_time);
  else
    series.emplace(csv, columns);
  if (field_interval == 0) return;
  if (resume_time) {
    seeds_pvd.emplace(seeds_file, *resume_time);
    if (simulation.n_cells() > 0) air_pvd.emplace(air_file, *resume_time);
  } else {
    seeds_pvd.emplace(seeds_file);
    if (simulation.n_cells() > 0) air_pvd.emplace(air_file);
    write_box(simulation.settings().domain.lower, simulation.settings().domain.upper, folder / "walls.vtp");
  }
}

void Recorder::record(Simulation& simulation) {
  const double time = simulation.time();
  if (const long now = due(time, series_interval); now >= next_row) {
    together(comm, [&] {
      if (writes) write_row(simulation);
    });
    next_row = now + 1;
  }
  if (field_interval == 0) return;
  if (const long now = due(time, field_interval); now >= next_field) {
    write_fields(simulation);
    next_field = now + 1;
  }
}

void Recorder::write_row(const Simulation& simulation) {
  const Dem& dem = simulation.dem();
  const bool started = !simulation.force_on_bodies().empty() && !simulation.air_at_bodies().velocity.empty();
  std::vector<double> row = {simulation.time()};
  const auto append = [&row](const Vec3& v) { row.insert(row.end(), {v.x, v.y, v.z}); };
  for (int s = 0; s < dem.n_seeds(); ++s) {
    const SeedState state = dem.seed_state(s);
    append(state.centre);
    append(state.velocity);
    append(state.spin);
    append(started ? simulation.force_on_seed(s) : Vec3());
    Vec3 air_velocity;
    double eps = 0, mass = 0;
    for (std::size_t b = 0; b < simulation.bodies().size() && started; ++b) {
      const Body& body = simulation.bodies()[b];
      if (body.seed != s) continue;
      air_velocity += body.mass * simulation.air_at_bodies().velocity[b];
      eps += body.mass * simulation.air_at_bodies().void_fraction[b];
      mass += body.mass;
    }
    append(mass > 0 ? air_velocity / mass : Vec3());
    row.push_back(mass > 0 ? eps / mass : 1.0);
  }
  series->row(row);
}

void Recorder::write_fields(Simulation& simulation) {
  const auto count = static_cast<unsigned int>(next_field);
  std::string air_file;
  if (simulation.fluid()) air_file = simulation.fluid()->write(folder.string(), "air", count);
  together(comm, [&] {
    if (!writes) return;
    if (!air_file.empty())
      air_pvd->add(simulation.time(), std::filesystem::path(air_file).filename().string());
    write_seeds(simulation, count);
  });
}

void Recorder::write_seeds(const Simulation& simulation, unsigned int count) {
  std::vector<Vec3> position, velocity, spin;
  simulation.dem().positions(position);
  simulation.dem().velocities(velocity);
  simulation.dem().angular_velocities(spin);
  std::vector<std::int64_t> seed;
  for (int s = 0; s < simulation.dem().n_spheres(); ++s) seed.push_back(simulation.dem().seed_of_sphere(s));
  char name[32];
  std::snprintf(name, sizeof name, "seeds_%05u.vtu", count);
  PointCloud(position)
      .add("radius", simulation.dem().radii())
      .add("velocity", velocity)
      .add("angular velocity", spin)
      .add("seed", seed)
      .write(folder / name);
  seeds_pvd->add(simulation.time(), name);
}

}  // namespace seedflow
