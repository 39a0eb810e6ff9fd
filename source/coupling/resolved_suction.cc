#include "seedflow/coupling/resolved_suction.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>

#include "seedflow/base/binary.h"
#include "seedflow/coupling/coupled_step.h"

namespace seedflow {

ResolvedSuctionParameters::ResolvedSuctionParameters() {
  flow.formulation = "B";
  flow.eddy_viscosity = 1;
  flow.convecting_velocity = "averaged";
  flow.momentum_preconditioner = "ilu";  // Courant numbers in the holes are far above 1
  flow.pressure_tolerance = flow.momentum_tolerance = 1e-7;
}

void ResolvedSuctionParameters::declare(Parameters& p) {
  mesh.declare(p);
  const auto section = p.section("Air", "");
  p.choice(
      "Rotor", rotor, {"sliding", "frozen"},
      "Computed air. sliding: the mesh of seed chamber and holes turns with the disc. frozen: it stands, "
      "the flow is computed relative to the disc (multiple reference frames), and the mesh is moved on "
      "in steps.");
  p.number("Frozen angle", frozen_angle, "rad", Range::non_negative(),
           "Rotor frozen: turn of the disc after which the mesh is moved on; 0: from hole to hole.");
  p.number("Ramp", ramp, "s", Range::positive(),
           "The vacuum grows from nothing during this time, in which the air in fan and suction line also "
           "follows a "
           "change of the flow.");
  p.number("Eddy viscosity", flow.eddy_viscosity, "1", Range::between(0, 2),
           "Strength of the eddy viscosity of the unresolved turbulence by the WALE model; 0: none.");
  p.choice("Convecting velocity", flow.convecting_velocity, {"extrapolated", "averaged"},
           "averaged: mean of the last two steps, smooth in steps of a millisecond. extrapolated: of second "
           "order, for "
           "steps that resolve the flow in a hole (below 0.05 ms).");
  p.number("Solid resistance", resistance, "kg/(m3 s)", Range::positive(),
           "Binds the air inside a seed near a hole to the seed's motion. Above 1e6 a seed is tight; larger "
           "values cost iterations.");
  p.number("Solid margin", margin, "1", Range::between(0, 2),
           "By so many cells a seed near a hole is larger, so that gaps finer than the mesh are shut.");
  p.number("Solid reach", reach, "m", Range::non_negative(),
           "Distance from a hole's mouth within which seeds are solid to the air; beyond, they feel drag. 0: "
           "two diameters of a hole.");
  flow.declare_solver(p);
}

namespace {

FluidParameters air_parameters(const ResolvedSuctionParameters& r, const SuctionParameters& s) {
  FluidParameters p = r.flow;
  p.density = s.density;
  p.viscosity = s.viscosity;
  p.boundary_conditions =
      "ambient: pressure outlet, 0; disc: rotor wall; hole: rotor wall; housing: wall; suction: pressure "
      "outlet, "
      "0; *: wall";
  return p;
}

/// \param drop of the vacuum chamber below ambient [Pa]; must outlive the conditions
BoundaryConditions<3> air_conditions(const FluidParameters& p, const Domain<3>& domain, const double& drop) {
  BoundaryConditions<3> conditions = parse_boundary_conditions(p.boundary_conditions, domain);
  conditions.at("suction").pressure = [&drop](const dealii::Point<3>&, double) { return -drop; };
  return conditions;
}

/// What the air of the device asks of the coupling.
CouplingParameters device_coupling(CouplingParameters c) {
  c.exchange_kernel = "cell";
  c.void_fraction_kernel = "none";
  c.undisturbed_velocity = "none";
  c.outside = "still air";
  return c;
}

double cpu_seconds() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

struct ResolvedSuction::Scene {
  double drop = 0;  ///< of the vacuum chamber below ambient, at the end of the present step [Pa]
  Domain<3> domain;
  Fluid<3> fluid;
  PointLocation<3> location;
  SolidSeeds solid;
  CoupledStep coupled;

  Scene(const ResolvedSuctionParameters& p, const SuctionParameters& suction, const DeviceGeometry& device,
        const CouplingParameters& coupling, Dem& dem, EffectSet& effects, const Vec3& gravity, double speed,
        MPI_Comm comm)
      : domain(device_domain(device, p.mesh, comm)),
        fluid(air_parameters(p, suction), domain, air_conditions(air_parameters(p, suction), domain, drop)),
        solid(p.resistance, p.margin, p.reach > 0 ? p.reach : 2 * device.hole_diameter, location,
              fluid.layout(), comm),
        coupled(device_coupling(coupling), 1, fluid, location, dem, effects,
                {suction.density, suction.viscosity, false}, gravity, comm) {
    location.build(domain);
    coupled.use(solid);
    using Mode = RotorMotion::Mode;
    fluid.set_rotor_motion({p.rotor == "sliding" ? Mode::sliding : Mode::frozen, speed});
    fluid.set_initial(
        0, [](const dealii::Point<3>&) { return dealii::Tensor<1, 3>(); },
        [](const dealii::Point<3>&) { return 0.0; });
  }
};

ResolvedSuction::ResolvedSuction(const ResolvedSuctionParameters& r, const SuctionParameters& s,
                                 const DeviceGeometry& g, const CouplingParameters& c, int disc_wall,
                                 EffectSet& all_effects, const Vec3& gravity, MPI_Comm communicator)
    : parameters(r),
      suction(s),
      device(g),
      coupling(c),
      disc(disc_wall),
      effects(all_effects),
      gravity(gravity),
      comm(communicator) {}

ResolvedSuction::~ResolvedSuction() = default;

void ResolvedSuction::begin(Dem& dem) {
  const double speed = dem.walls()[disc].motion.angle.at(dem.time()).rate;
  scene = std::make_unique<Scene>(parameters, suction, device, coupling, dem, effects, gravity, speed, comm);
  if (saved.empty()) return;
  std::istringstream in(saved);
  scene->fluid.load(in);
  scene->coupled.load(in);
  scene->location.turn_to(scene->domain.angle());
  saved.clear();
}

double ResolvedSuction::chamber_drop(double time) const {
  SuctionParameters now = suction;
  now.vacuum *= std::min(1.0, time / parameters.ramp);
  return suction_balance(now, disc_area + leak_area(suction, device)).drop;
}

void ResolvedSuction::step(Dem& dem, double dt) {
  Scene& s = *scene;
  const auto turned = dem.walls()[disc].motion.angle;
  const double angle = turned.at(dem.time() + dt).value;
  double mesh_angle = angle;
  if (parameters.rotor == "frozen") {
    const double jump = parameters.frozen_angle > 0 ? parameters.frozen_angle : device.pitch_angle();
    mesh_angle = jump * std::floor(angle / jump + 1e-9);
  }
  s.fluid.turn_to(mesh_angle);
  s.location.turn_to(angle);
  s.solid.set_lag(angle - mesh_angle);
  std::vector<Vec3> mouths;
  for (int k = 0; k < device.n_holes(); ++k)
    if (device.exposure(device.hole_angle(k, angle)) > 0) mouths.push_back(device.hole_centre(k, angle));
  s.solid.set_places(mouths);
  s.drop = chamber_drop(s.fluid.time() + dt);
  s.coupled.advance(dt);

  const Bodies& bodies = s.coupled.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b)
    seed_load[bodies[b].seed].drag += s.coupled.force_on_bodies()[b];
  for (int seed = 0; seed < dem.n_seeds(); ++seed) seed_load[seed].pressure = s.solid.force()[seed];

  const MassBalance& mass = s.fluid.mass_balance();
  const double out = mass.outflow.at("suction"), in = -mass.outflow.at("ambient");
  const auto sliding = s.fluid.interface_flow();
  const double speed = std::sqrt(2 * s.drop / suction.density);
  if (speed > 0)
    disc_area += (1 - std::exp(-dt / parameters.ramp)) * (std::max(0.0, out) / speed - disc_area);
  const double leak = leak_area(suction, device) * speed;
  balance = {s.drop, out + leak};
  tally.volume += balance.flow * dt;
  tally.energy += (leak * s.drop - mass.power.at("suction")) * dt;
  tally.mass_error = std::max({tally.mass_error, mass.largest, mass.total});
  tally.volume_error = std::max(tally.volume_error, std::abs(out - in) / mass.flow);
  tally.interface_error = std::max(tally.interface_error, std::abs(sliding[1] - sliding[0]) / mass.flow);
  tally.courant = std::max(tally.courant, s.fluid.courant_number(dt));
  tally.most_outside = std::max(tally.most_outside, double(s.coupled.n_outside()));
  tally.pressure_iterations += s.fluid.statistics().pressure_iterations;
  tally.momentum_iterations += s.fluid.statistics().momentum_iterations;
  tally.steps += 1;
}

Vec3 ResolvedSuction::advance(Dem& dem, double duration) {
  const double began = cpu_seconds();
  if (!scene) begin(dem);
  const auto of_air = [&] {
    const auto& sum = scene->coupled.momentum().sum;
    return sum.from_air + sum.still_air + sum.buoyancy;
  };
  const Vec3 before = of_air();
  const double in_air = scene->coupled.air_seconds(), in_seeds = scene->coupled.seed_seconds();
  const long n = std::max(1L, std::lround(std::ceil(duration / suction.air_step - 1e-9)));
  mean_load.assign(dem.n_seeds(), SeedLoad());
  for (long i = 0; i < n; ++i) {
    seed_load.assign(dem.n_seeds(), SeedLoad());
    step(dem, duration / static_cast<double>(n));
    for (std::size_t s = 0; s < mean_load.size(); ++s) {
      mean_load[s].pressure += seed_load[s].pressure / static_cast<double>(n);
      mean_load[s].drag += seed_load[s].drag / static_cast<double>(n);
    }
  }
  tally.seconds_in_air += scene->coupled.air_seconds() - in_air;
  tally.seconds_in_seeds += scene->coupled.seed_seconds() - in_seeds;
  tally.seconds += cpu_seconds() - began;
  return of_air() - before;
}

double ResolvedSuction::n_cells() const {
  return scene ? double(scene->domain.triangulation().n_global_active_cells()) : 0;
}
MomentumLedger ResolvedSuction::momentum() const {
  return scene ? scene->coupled.momentum() : MomentumLedger();
}
FluidStatistics ResolvedSuction::statistics() const {
  return scene ? scene->fluid.statistics() : FluidStatistics();
}
std::string ResolvedSuction::write(const std::string& directory, const std::string& name,
                                   unsigned int counter) const {
  return scene ? scene->fluid.write(directory, name, counter) : "";
}

std::vector<ResolvedSuction::AxisPoint> ResolvedSuction::along_hole(int hole) const {
  std::vector<AxisPoint> line;
  if (!scene) return line;
  const Vec3 mouth = device.hole_centre(hole, scene->domain.angle());
  const double d = device.hole_diameter;
  const double from = -std::min(3 * d, 0.9 * device.chamber_depth),
               to = device.thickness + std::min(4 * d, 0.9 * device.vacuum_depth);
  std::vector<dealii::Point<3>> points;
  for (int i = 0; i <= 120; ++i)
    points.emplace_back(mouth.x + 1e-3 * d, mouth.y + 1e-3 * d, from + (to - from) * i / 120);
  const auto samples = scene->fluid.sample(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (samples[i].inside) line.push_back({points[i][2], samples[i].pressure, samples[i].velocity[2]});
  return line;
}

void ResolvedSuction::save(std::ostream& out) const {
  write_binary(out, tally);
  write_binary(out, disc_area);
  std::ostringstream state;
  if (scene) {
    scene->fluid.save(state);
    scene->coupled.save(state);
  }
  const std::string text = scene ? state.str() : saved;
  write_binary(out, std::vector<char>(text.begin(), text.end()));
}

void ResolvedSuction::load(std::istream& in) {
  read_binary(in, tally);
  read_binary(in, disc_area);
  std::vector<char> text;
  read_binary(in, text);
  saved.assign(text.begin(), text.end());
  scene.reset();
}

}  // namespace seedflow
