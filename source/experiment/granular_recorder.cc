#include "seedflow/experiment/granular_recorder.h"

#include <cmath>

#include "seedflow/base/together.h"

namespace seedflow {

GranularRecorder::GranularRecorder(const GranularParameters& p, const GranularScene& the_scene,
                                   const std::filesystem::path& output, MPI_Comm communicator,
                                   std::optional<double> resume_time)
    : parameters(p), scene(the_scene), folder(output), comm(communicator) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  writes = rank == 0;
  if (resume_time && parameters.field_interval > 0)
    next_field = static_cast<long>(std::floor(*resume_time / parameters.field_interval + 1e-6)) + 1;
  together(comm, [&] {
    if (!writes) return;
    std::vector<Column> columns = {
        {"time", "s"}, {"seeds"}, {"kinetic energy", "J"}, {"potential energy", "J"}, {"bond energy", "J"}};
    columns.insert(columns.end(), scene.columns.begin(), scene.columns.end());
    const auto csv = folder / "series.csv", seeds = folder / "seeds.pvd";
    if (resume_time) {
      series.emplace(csv, columns, *resume_time + 1e-9);
      if (parameters.field_interval > 0) pvd.emplace(seeds, *resume_time + 1e-9);
    } else {
      series.emplace(csv, columns);
      if (parameters.field_interval > 0) pvd.emplace(seeds);
    }
  });
}

void GranularRecorder::record(const Dem& dem, double time) {
  together(comm, [&] {
    if (!writes) return;
    write_row(dem, time);
    if (!pvd) return;
    const long now = static_cast<long>(std::floor(time / parameters.field_interval + 1e-6));
    if (now < next_field) return;
    next_field = now;
    write_seeds(dem, time);
    ++next_field;
  });
}

void GranularRecorder::write_row(const Dem& dem, double time) {
  const DemEnergies energy = dem.energies();
  std::vector<double> row = {time, 1.0 * dem.n_seeds(), energy.kinetic, energy.potential, energy.bonds};
  const std::vector<double> seen = scene.observe(dem, time);
  row.insert(row.end(), seen.begin(), seen.end());
  series->row(row);
}

void GranularRecorder::write_seeds(const Dem& dem, double time) {
  std::vector<Vec3> position, velocity, spin;
  std::vector<double> radius;
  std::vector<std::int64_t> label, group;
  if (parameters.sub_spheres_in_files) {
    dem.positions(position);
    dem.velocities(velocity);
    dem.angular_velocities(spin);
    radius = dem.radii();
    for (int s = 0; s < dem.n_seeds(); ++s)
      for (int i = dem.first_sphere(s); i < dem.first_sphere(s + 1); ++i) {
        label.push_back(dem.seed_label(s));
        group.push_back(dem.seed_group(s));
      }
  } else {
    for (int s = 0; s < dem.n_seeds(); ++s) {
      const SeedState state = dem.seed_state(s);
      position.push_back(state.centre);
      velocity.push_back(state.velocity);
      spin.push_back(state.spin);
      radius.push_back(0.5 * dem.seed_template(s).equivalent_diameter);
      label.push_back(dem.seed_label(s));
      group.push_back(dem.seed_group(s));
    }
  }
  char name[32];
  std::snprintf(name, sizeof name, "seeds_%05ld.vtu", next_field);
  PointCloud(position)
      .add("radius", radius)
      .add("velocity", velocity)
      .add("angular velocity", spin)
      .add("seed", label)
      .add("group", group)
      .write(folder / name);
  pvd->add(time, name);
}

}  // namespace seedflow
