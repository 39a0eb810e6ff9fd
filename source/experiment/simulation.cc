#include "seedflow/experiment/simulation.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/binary.h"

namespace seedflow {

namespace {

dealii::Point<3> as_point(const Vec3& x) {
  return {x.x, x.y, x.z};
}

double narrowest(const DomainParameters& box) {
  const Vec3 size = box.upper - box.lower;
  return std::min({size.x, size.y, size.z});
}

/// Integral of rho eps u over the domain [N s]. Collective.
Vec3 momentum_of(const Fluid<3>& air, double density, const std::vector<double>& eps, MPI_Comm comm) {
  const std::vector<dealii::Tensor<1, 3>> velocity = air.velocity();
  dealii::Tensor<1, 3> sum;
  for (std::size_t q = 0; q < eps.size(); ++q) sum += density * eps[q] * air.layout().JxW[q] * velocity[q];
  sum = dealii::Utilities::MPI::sum(sum, comm);
  return {sum[0], sum[1], sum[2]};
}

}  // namespace

Simulation::Simulation(SimulationParameters& p, MPI_Comm comm) : parameters(p), comm(comm), seeds(p.dem) {
  add_seeds();
  if (p.air_model == "prescribed") {
    const AirProperties properties{p.air.density, p.air.viscosity, p.air.formulation == "A"};
    prescribed.emplace(p.prescribed, p.air.density, p.air.viscosity);
    one_way.emplace(p.coupling, *prescribed, seeds, p.effects, properties, p.dem.gravity);
    one_way->loads().confine(narrowest(p.domain));
    return;
  }
  domain.emplace(p.domain, comm);
  domain->require_cells_for_all_ranks();
  build_air();
  start_air();
  // A mesh that follows the seeds starts around them; every pass refines by one level.
  for (int level = 0; adaptive() && level < p.refinement.max_level; ++level) {
    adapt();
    start_air();
  }
  adaptation_change = 0;
}

void Simulation::build_air() {
  SimulationParameters& p = parameters;
  const AirProperties properties{p.air.density, p.air.viscosity, p.air.formulation == "A"};
  air.emplace(p.air, *domain);
  build_location();
  two_way.emplace(p.coupling, p.kernel_width(), *air, location, seeds, p.effects, properties, p.dem.gravity,
                  comm);
  two_way->loads().confine(narrowest(p.domain));
}

void Simulation::build_location() {
  if (!parameters.domain.mesh_file.empty()) {
    location.build(*domain);
    return;
  }
  std::array<unsigned int, 3> cells;
  for (int d = 0; d < 3; ++d) cells[d] = static_cast<unsigned int>(parameters.domain.cells[d]);
  location.build(domain->triangulation(), as_point(parameters.domain.lower),
                 as_point(parameters.domain.upper), cells);
}

void Simulation::start_air() {
  air->set_initial(
      0.0, [](const dealii::Point<3>&) { return dealii::Tensor<1, 3>(); },
      [](const dealii::Point<3>&) { return 0.0; }, two_way->void_fraction());
}

void Simulation::adapt() {
  std::vector<dealii::Point<3>> centres;
  for (int s = 0; s < seeds.n_seeds(); ++s) centres.push_back(as_point(seeds.seed_state(s).centre));
  const std::vector<double> eps = two_way->void_fraction();
  if (!flag_cells(parameters.refinement, *domain, air->layout(), eps, air->velocity_jump(), centres)) return;
  const Vec3 before = momentum_of(*air, parameters.air.density, eps, comm);
  std::vector<double> eps_after;
  air->refine([&](const QuadratureLayout<3>&) {
    build_location();
    eps_after = two_way->void_fraction();
    return eps_after;
  });
  const Vec3 after = momentum_of(*air, parameters.air.density, eps_after, comm);
  if (norm(before) > 0) adaptation_change = std::max(adaptation_change, norm(after - before) / norm(before));
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
  ++n_steps;
  if (adaptive() && n_steps % parameters.refinement.interval == 0) adapt();
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

void Simulation::save(std::ostream& seeds_out, std::ostream& air_out, std::ostream& coupling_out,
                      const std::string& mesh_prefix) const {
  seeds.save(seeds_out);
  parameters.effects.save(coupling_out);
  write_binary(coupling_out, n_steps);
  write_binary(coupling_out, adaptation_change);
  if (adaptive()) domain->save(mesh_prefix);
  if (air) air->save(air_out);
  if (two_way) two_way->save(coupling_out);
  if (one_way) one_way->save(coupling_out);
}

void Simulation::load(std::istream& seeds_in, std::istream& air_in, std::istream& coupling_in,
                      const std::string& mesh_prefix) {
  seeds.load(seeds_in);
  parameters.effects.load(coupling_in);
  read_binary(coupling_in, n_steps);
  read_binary(coupling_in, adaptation_change);
  if (adaptive()) {
    two_way.reset();
    air.reset();
    domain.emplace(parameters.domain, comm);
    domain->load(mesh_prefix);
    build_air();
  }
  if (air) air->load(air_in);
  if (two_way) two_way->load(coupling_in);
  if (one_way) one_way->load(coupling_in);
}

}  // namespace seedflow
