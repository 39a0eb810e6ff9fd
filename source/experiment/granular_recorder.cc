#include "seedflow/experiment/granular_recorder.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/together.h"
#include "seedflow/seeds/contact_census.h"
#include "seedflow/seeds/wall_polygons.h"

namespace seedflow {

namespace {

namespace fs = std::filesystem;

bool moves(const Wall& wall) {
  return wall.motion.displacement.kind != TimeLaw::Kind::rest ||
         wall.motion.angle.kind != TimeLaw::Kind::rest;
}

std::string numbered(const char* name, long number, const char* ending) {
  char text[48];
  std::snprintf(text, sizeof text, "%s_%05ld%s", name, number, ending);
  return text;
}

}  // namespace

GranularRecorder::GranularRecorder(const GranularParameters& p, const GranularScene& the_scene,
                                   const Dem& dem, const std::filesystem::path& output, MPI_Comm communicator,
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
        {"time", "s"},        {"seeds"},           {"kinetic energy", "J"}, {"potential energy", "J"},
        {"bond energy", "J"}, {"largest overlap"}, {"neighbours per seed"}, {"contacts per pair"}};
    columns.insert(columns.end(), scene.columns.begin(), scene.columns.end());
    const bool resumed = resume_time.has_value();
    const double after = resume_time.value_or(0) + 1e-9;
    const auto continued = [&](auto& file, const fs::path& path, const auto&... more) {
      if (resumed)
        file.emplace(path, more..., after);
      else
        file.emplace(path, more...);
    };
    continued(series, folder / "series.csv", columns);
    if (parameters.field_interval == 0) return;
    continued(pvd, folder / "seeds.pvd");
    write_walls(dem, false, "walls.vtp");
    if (std::any_of(dem.walls().begin(), dem.walls().end(), moves))
      continued(moving_walls, folder / "moving_walls.pvd");
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
    if (moving_walls) {
      const std::string name = numbered("moving_walls", next_field, ".vtp");
      write_walls(dem, true, name);
      moving_walls->add(time, name);
    }
    ++next_field;
  });
}

void GranularRecorder::write_row(const Dem& dem, double time) {
  const DemEnergies energy = dem.energies();
  const ContactCensus contacts = contact_census(dem);
  std::vector<double> row = {time,
                             1.0 * dem.n_seeds(),
                             energy.kinetic,
                             energy.potential,
                             energy.bonds,
                             contacts.largest_overlap,
                             contacts.neighbours_per_seed,
                             contacts.contacts_per_pair};
  const std::vector<double> seen = scene.observe(dem, time);
  row.insert(row.end(), seen.begin(), seen.end());
  series->row(row);
}

void GranularRecorder::write_seeds(const Dem& dem, double time) {
  std::vector<Vec3> position, velocity, spin;
  std::vector<double> radius;
  std::vector<std::int64_t> label, group, neighbours;
  const std::vector<int> touching = dem.coordination_numbers();
  if (parameters.sub_spheres_in_files) {
    dem.positions(position);
    dem.velocities(velocity);
    dem.angular_velocities(spin);
    radius = dem.radii();
    for (int s = 0; s < dem.n_seeds(); ++s)
      for (int i = dem.first_sphere(s); i < dem.first_sphere(s + 1); ++i) {
        label.push_back(dem.seed_label(s));
        group.push_back(dem.seed_group(s));
        neighbours.push_back(touching[s]);
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
      neighbours.push_back(touching[s]);
    }
  }
  const std::string name = numbered("seeds", next_field, ".vtu");
  PointCloud(position)
      .add("radius", radius)
      .add("velocity", velocity)
      .add("angular velocity", spin)
      .add("seed", label)
      .add("group", group)
      .add("neighbours", neighbours)
      .write(folder / name);
  pvd->add(time, name);
}

void GranularRecorder::write_walls(const Dem& dem, bool moving, const std::string& name) const {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> polygons;
  std::vector<std::int64_t> wall, material;
  for (std::size_t w = 0; w < dem.walls().size(); ++w) {
    if (moves(dem.walls()[w]) != moving) continue;
    const PolygonSurface seen = wall_polygons(dem.walls()[w], dem.time(), scene.low, scene.high);
    const int first = static_cast<int>(vertices.size());
    vertices.insert(vertices.end(), seen.vertex.begin(), seen.vertex.end());
    for (std::vector<int> polygon : seen.polygon) {
      for (int& corner : polygon) corner += first;
      polygons.push_back(polygon);
      wall.push_back(static_cast<std::int64_t>(w));
      material.push_back(dem.walls()[w].material);
    }
  }
  Polygons(vertices, polygons).add("wall", wall).add("material", material).write(folder / name);
}

}  // namespace seedflow
