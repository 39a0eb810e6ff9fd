#include "seedflow/experiment/simulation.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace seedflow {

namespace {

dealii::Point<3> as_point(const Vec3& x) {
  return {x.x, x.y, x.z};
}

}  // namespace

Simulation::Simulation(SimulationParameters& p, MPI_Comm comm) : parameters(p), comm(comm), seeds(p.dem) {
  add_seeds();
  const AirProperties properties{p.air.density, p.air.viscosity, p.air.formulation == "A"};
  if (p.air_model == "prescribed") {
    prescribed.emplace(p.prescribed, p.air.density, p.air.viscosity);
    one_way.emplace(p.coupling, *prescribed, seeds, p.effects, properties, p.dem.gravity);
  } else {
    domain.emplace(p.domain, comm);
    domain->require_cells_for_all_ranks();
    air.emplace(p.air, *domain);
    std::array<unsigned int, 3> cells;
    for (int d = 0; d < 3; ++d) cells[d] = static_cast<unsigned int>(p.domain.cells[d]);
    location.build(domain->triangulation(), as_point(p.domain.lower), as_point(p.domain.upper), cells);
    two_way.emplace(p.coupling, p.kernel_width(), *air, location, seeds, p.effects, properties, p.dem.gravity,
                    comm);
    air->set_initial(
        0.0, [](const dealii::Point<3>&) { return dealii::Tensor<1, 3>(); },
        [](const dealii::Point<3>&) { return 0.0; },
        p.coupling.two_way ? two_way->void_fraction() : std::vector<double>());
  }
  const Vec3 size = p.domain.upper - p.domain.lower;
  BodyLoads& loads = two_way ? two_way->loads() : one_way->loads();
  loads.confine(std::min({size.x, size.y, size.z}));
}

void Simulation::add_seeds() {
  const SeedsParameters& s = parameters.seeds;
  const int seed_material = seeds.add_material(s.material),
            wall_material = seeds.add_material(s.wall_material);
  seeds.set_contact(seed_material, wall_material, s.wall_contact);
  const int model = seeds.add_template(make_seed_template(s.model), seed_material, s.rigid);
  seeds.add_box(parameters.domain.lower, parameters.domain.upper, wall_material);
  seeds.add_seed(model, s.position, rotation(s.orientation), s.velocity);
  seeds.check();
}

void Simulation::advance(double dt) {
  if (two_way)
    two_way->advance(dt);
  else
    one_way->advance(dt);
}

Vec3 Simulation::force_on_seed(int seed) const {
  Vec3 sum;
  for (std::size_t b = 0; b < bodies().size(); ++b)
    if (bodies()[b].seed == seed) sum += force_on_bodies()[b];
  return sum;
}

std::size_t Simulation::n_cells() const {
  return domain ? domain->triangulation().n_global_active_cells() : 0;
}

std::string Simulation::describe() const {
  std::ostringstream text;
  const SeedTemplate& model = seeds.seed_template(0);
  text << "Seeds:      " << seeds.n_seeds() << " x " << model.n_spheres() << " sub-spheres, "
       << model.bond.size() << " bonds, mass " << model.mass << " kg, "
       << (seeds.is_rigid(0) ? "rigid" : "bonded") << "\n";
  if (domain)
    text << "Air:        " << n_cells() << " cells, smallest edge " << domain->min_cell_size() << " m, "
         << parameters.air.backend << "\n";
  else
    text << "Air:        prescribed\n";
  const RunParameters& run = parameters.run;
  text << "Air steps:  " << std::lround(run.end_time / run.air_step) << " of " << run.air_step << " s\n"
       << "Seed steps: " << std::lround(run.end_time / parameters.dem.time_step) << " of at most "
       << parameters.dem.time_step << " s; limits:\n";
  for (const TimeStepLimit& limit : seeds.time_step_limits())
    text << "            " << limit.step() << " s, " << limit.cause
         << " (used: " << 100 * parameters.dem.time_step / limit.step() << " %)\n";
  // 3e-6 s per cell and step, 3e-8 s per sub-sphere and step (lanes of eight seeds), about as benchmarked.
  const double lanes = 8.0 * ((seeds.n_seeds() + 7) / 8) * model.n_spheres();
  text << "Memory:     about " << (200 + 3e-3 * n_cells()) << " MiB\nWall time:  about "
       << 4e-6 * n_cells() * run.end_time / run.air_step +
              2.5e-8 * lanes * run.end_time / parameters.dem.time_step
       << " s on one core\n";
  return text.str();
}

void Simulation::save(std::ostream& seeds_out, std::ostream& air_out, std::ostream& coupling_out) const {
  seeds.save(seeds_out);
  parameters.effects.save(coupling_out);
  if (air) air->save(air_out);
  if (two_way) two_way->save(coupling_out);
  if (one_way) one_way->save(coupling_out);
}

void Simulation::load(std::istream& seeds_in, std::istream& air_in, std::istream& coupling_in) {
  seeds.load(seeds_in);
  parameters.effects.load(coupling_in);
  if (air) air->load(air_in);
  if (two_way) two_way->load(coupling_in);
  if (one_way) one_way->load(coupling_in);
}

}  // namespace seedflow
