#include "seedflow/coupling/coupled_step.h"

#include <algorithm>
#include <ctime>
#include <sstream>

#include "seedflow/base/binary.h"
#include "seedflow/coupling/kernels.h"

namespace seedflow {

namespace {

Vec3 as_vec3(const dealii::Tensor<1, 3>& t) {
  return {t[0], t[1], t[2]};
}

Vec3 total(const std::vector<Vec3>& values) {
  Vec3 sum;
  for (const Vec3& v : values) sum += v;
  return sum;
}

/// Adds the CPU time of a scope.
class CpuSeconds {
 public:
  explicit CpuSeconds(double& sum) : sum(sum), begin(std::clock()) {}
  ~CpuSeconds() { sum += double(std::clock() - begin) / CLOCKS_PER_SEC; }

 private:
  double& sum;
  std::clock_t begin;
};

}  // namespace

CoupledStep::CoupledStep(const CouplingParameters& p, double kernel_width, Fluid<3>& fluid,
                         const PointLocation<3>& location, Dem& dem, EffectSet& effects,
                         const AirProperties& air, const Vec3& gravity, MPI_Comm comm)
    : parameters(p),
      sigma(kernel_width),
      fluid(fluid),
      location(location),
      dem(dem),
      air(air),
      gravity(gravity),
      comm(comm),
      all_bodies(dem, p),
      solid(p, kernel_width, location, fluid.layout(), comm),
      weights(fluid.layout(), comm),
      body_loads(effects, air, gravity),
      remainder(all_bodies.size()),
      body_force(all_bodies.size()) {
  if (p.undisturbed_velocity != "none")
    body_loads.remove_self_disturbance(sigma, p.void_fraction_kernel == "gaussian" && p.two_way,
                                       p.undisturbed_velocity == "transient");
}

std::vector<double> CoupledStep::void_fraction() {
  if (!parameters.two_way) return std::vector<double>(fluid.layout().size(), 1.0);
  std::vector<double> eps;
  solid.compute(all_bodies, all_bodies.position, all_bodies.sphere_position(), dem.time(), eps);
  return eps;
}

void CoupledStep::advance(double dt) {
  place(dt);
  look();
  body_loads.evaluate(all_bodies, seen, dem, dem.time(), dt);
  if (solid_seeds)
    for (std::size_t b = 0; b < all_bodies.size(); ++b)
      if (solid_seeds->covers(all_bodies.position[b])) {
        body_loads.force[b] = BodyForce();
        body_loads.force[b].force = body_loads.hydrostatic[b];
      }
  deposit(dt);
  {
    const CpuSeconds timer(in_air);
    fluid.advance(dt, exchange);
  }
  if (solid_seeds) solid_seeds->collect(fluid.velocity());
  push_seeds(dt);
  book(dt);
}

void CoupledStep::place(double dt) {
  all_bodies.update(dem);
  weights.clear();
  for (const Vec3& x : all_bodies.position) {
    if (parameters.exchange_kernel == "gaussian")
      add_gaussian_kernel(weights, location, fluid.layout(), x, sigma);
    else
      add_cell_kernel(weights, location, fluid.layout(), x);
    weights.next();
  }
  outside = weights.normalize();
  if (!outside.empty() && parameters.outside == "stop") {
    std::ostringstream text;
    const Vec3& x = all_bodies.position[outside.front()];
    text << "Seed " << all_bodies[outside.front()].seed << " has left the air's mesh at t = " << dem.time()
         << " s, position (" << x.x << ", " << x.y << ", " << x.z
         << ") m.\nRemedy: close the domain with walls for the seeds, or set Coupling/Outside the mesh = "
            "still "
            "air.";
    throw RunError(text.str());
  }
  exchange.clear(fluid.layout().size());
  solid.compute(all_bodies, all_bodies.position, all_bodies.sphere_position(), dem.time(),
                exchange.void_fraction);
  if (!parameters.two_way) exchange.void_fraction.assign(fluid.layout().size(), 1.0);
  volume_error = std::max(volume_error, solid.volume_error());
  if (solid_seeds) {
    solid_seeds->mark(dem, dt);
    if (parameters.two_way) solid_seeds->deposit(exchange);
  }
}

void CoupledStep::look() {
  seen.velocity = weights.average(fluid.velocity());
  seen.vorticity = weights.average(fluid.vorticity());
  seen.acceleration = weights.average(fluid.acceleration());
  seen.pressure_gradient = weights.average(fluid.pressure_gradient());
  seen.void_fraction = weights.average(exchange.void_fraction);
  for (const long b : outside) seen.void_fraction[b] = 1;
}

void CoupledStep::deposit(double dt) {
  const std::size_t n = all_bodies.size();
  std::vector<double> seed_drag(dem.n_seeds(), 0.0), seed_mass(dem.n_seeds(), 0.0);
  for (std::size_t b = 0; b < n; ++b) {
    seed_drag[all_bodies[b].seed] += body_loads.force[b].drag_coefficient;
    seed_mass[all_bodies[b].seed] += all_bodies[b].mass + body_loads.force[b].added_mass;
  }
  // In model A the air's equation already holds the seeds' share of the pressure gradient, (1 - eps) grad p;
  // it is taken out of the explicit force here, at its present value, so that it is not counted twice.
  const std::vector<Vec3> gradient = solid.average(all_bodies, fluid.pressure_gradient());
  air_drag.assign(n, 0.0);
  explicit_on_air.assign(n, Vec3());
  std::vector<Vec3> drag_source(n);
  for (std::size_t b = 0; b < n; ++b) {
    const BodyForce& f = body_loads.force[b];
    const double K = seed_drag[all_bodies[b].seed], M = seed_mass[all_bodies[b].seed];
    air_drag[b] = f.drag_coefficient * M / (M + K * dt);
    drag_source[b] = air_drag[b] * all_bodies.velocity[b];
    explicit_on_air[b] = body_loads.hydrostatic[b] - f.force + remainder[b] / dt;
    if (air.pressure_shared) explicit_on_air[b] -= all_bodies[b].solid_volume * gradient[b];
  }
  if (!parameters.two_way) return;
  weights.deposit(air_drag, exchange.drag_coefficient);
  weights.deposit(drag_source, exchange.drag_source);
  weights.deposit(explicit_on_air, exchange.force);
}

void CoupledStep::push_seeds(double dt) {
  const std::vector<Vec3> gradient_before = seen.pressure_gradient;
  look();
  const double buoyant = body_loads.pressure_gradient_strength();
  for (std::size_t b = 0; b < all_bodies.size(); ++b)
    body_loads.force[b].force -=
        buoyant * all_bodies[b].buoyant_volume * (seen.pressure_gradient[b] - gradient_before[b]);
  wall_impulse = total(dem.wall_impulses());
  seeds_momentum = dem.momentum();
  SphereLoads loads = all_bodies.share_loads(body_loads.force, seen.velocity);
  if (solid_seeds)
    for (int seed = 0; seed < dem.n_seeds(); ++seed) {
      const Vec3 acceleration = solid_seeds->force()[seed] / dem.seed_template(seed).mass;
      for (int s = dem.first_sphere(seed); s < dem.first_sphere(seed + 1); ++s)
        loads.force[s] += dem.masses()[s] * acceleration;
    }
  dem.set_loads(loads);
  const CpuSeconds timer(in_seeds);
  dem.advance(dt);
}

void CoupledStep::book(double dt) {
  std::vector<Vec3> on_spheres;
  dem.fluid_impulses(on_spheres);
  const std::vector<Vec3> drag_impulse = all_bodies.sum(on_spheres);
  const std::vector<Vec3> gradient = solid.average(all_bodies, fluid.pressure_gradient());

  Vec3 to_seeds, buoyancy, on_the_way, still_air;
  double mass = 0;
  auto next_outside = outside.begin();
  std::vector<Vec3> force_on_air(all_bodies.size());
  for (std::size_t b = 0; b < all_bodies.size(); ++b) {
    const BodyForce& f = body_loads.force[b];
    const Vec3 received = drag_impulse[b] + dt * (f.force - body_loads.hydrostatic[b]);
    body_force[b] = drag_impulse[b] / dt + f.force;
    buoyancy += dt * body_loads.hydrostatic[b];
    mass += all_bodies[b].mass;
    ledger.add_scale(norm(received) + norm(dt * body_loads.hydrostatic[b]));
    if (next_outside != outside.end() && *next_outside == static_cast<long>(b)) {
      ++next_outside;
      // What the air has not yet had from a body that has just left the mesh is reckoned to the still air.
      still_air += received - remainder[b];
      to_seeds += remainder[b];
      remainder[b] = Vec3();
      continue;
    }
    to_seeds += received;
    if (!parameters.two_way) continue;
    Vec3 given = dt * (air_drag[b] * (all_bodies.velocity[b] - seen.velocity[b]) + explicit_on_air[b]);
    if (air.pressure_shared) given += dt * all_bodies[b].solid_volume * gradient[b];
    remainder[b] = -(received + given - remainder[b]);
    on_the_way += remainder[b];
    force_on_air[b] = given / dt;
  }
  body_loads.remember(force_on_air);

  auto& sum = ledger.sum;
  sum.seeds_change += dem.momentum() - seeds_momentum;
  sum.gravity += dt * mass * gravity;
  sum.buoyancy += buoyancy;
  sum.walls += total(dem.wall_impulses()) - wall_impulse;
  if (solid_seeds)
    for (const Vec3& force : solid_seeds->force()) {
      to_seeds += dt * force;
      ledger.add_scale(norm(dt * force));
    }
  sum.from_air += to_seeds;
  sum.still_air += still_air;
  if (!parameters.two_way) return;

  const MomentumBalance<3>& balance = fluid.momentum_balance();
  sum.air_change += dt * as_vec3(balance.change);
  for (const auto& [side, force] : balance.reaction) sum.sides += dt * as_vec3(force);
  for (const auto& [side, force] : balance.pressure_force) sum.sides += dt * as_vec3(force);
  sum.from_seeds += dt * as_vec3(balance.exchange);
  if (air.pressure_shared) sum.from_seeds += dt * as_vec3(balance.pressure_share);
  sum.on_the_way = on_the_way;
}

void CoupledStep::save(std::ostream& out) const {
  ledger.save(out);
  body_loads.save(out);
  write_binary(out, remainder);
  write_binary(out, volume_error);
}
void CoupledStep::load(std::istream& in) {
  ledger.load(in);
  body_loads.load(in);
  read_binary(in, remainder);
  read_binary(in, volume_error);
  all_bodies.update(dem);
}

}  // namespace seedflow
