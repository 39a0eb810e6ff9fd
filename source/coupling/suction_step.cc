#include "seedflow/coupling/suction_step.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/binary.h"
#include "seedflow/coupling/aperture_flow.h"

namespace seedflow {

namespace {

constexpr double fade_from = 3, fade_to = 4;  // distances at which a hole's flow fades out [pitch lengths]
constexpr double reach_in_radii = 8;          // seeds farther than this leave a hole open: chi < 1e-3

/// Into the frame of a hole: z from the disc towards the seeds, who are at negative z in the lab frame.
Vec3 seen_from_mouth(const Vec3& x, const Vec3& mouth) {
  return {x.x - mouth.x, x.y - mouth.y, mouth.z - x.z};
}
Vec3 turned_back(const Vec3& v) {
  return {v.x, v.y, -v.z};
}

}  // namespace

SuctionStep::SuctionStep(const SuctionParameters& p, const DeviceGeometry& g, const CouplingParameters& c,
                         int disc_wall, double seed_radius, EffectSet& all_effects, const Vec3& gravity)
    : parameters(p),
      device(g),
      coupling(c),
      disc(disc_wall),
      law(g.hole_radius(), g.chamfer, seed_radius),
      effects(all_effects),
      body_loads(all_effects, {p.density, p.viscosity, true}, gravity),
      hole(g.n_holes()),
      mouth(g.n_holes()) {
  law.hole_coefficient = p.hole_coefficient;
  law.gap_coefficient = p.gap_coefficient;
  law.roughness = p.seat_roughness;
}

void SuctionStep::look(const Dem& dem) {
  const Wall& wall = dem.walls()[disc];
  const Placement place = placement(wall, dem.time());
  const double turned = wall.motion.angle.at(dem.time()).value;
  const int n_seeds = dem.n_seeds();
  std::vector<Vec3> centre(n_seeds);
  for (int s = 0; s < n_seeds; ++s) centre[s] = dem.seed_state(s).centre;
  seed_load.assign(n_seeds, SeedLoad());
  std::vector<double> open_area(hole.size());
  std::vector<std::pair<int, Vec3>> area;  // seed, chi x its vector area
  std::vector<CoveredHole::Ball> balls;
  std::vector<int> who;
  const double leaking = leak_area(parameters, device);
  double sum = leaking;
  for (std::size_t k = 0; k < hole.size(); ++k) {
    HoleState& h = hole[k];
    h.angle = device.hole_angle(static_cast<int>(k), turned);
    h.exposure = device.exposure(h.angle);
    mouth[k] = place.to_lab(device.hole_centre(static_cast<int>(k), 0));
    balls.clear(), who.clear();
    if (parameters.blocking && h.exposure > 0)
      for (int s = 0; s < n_seeds; ++s) {
        const double radius = 0.5 * dem.seed_template(s).equivalent_diameter;
        const double reach = radius + reach_in_radii * law.seat_radius;
        if (norm_square(centre[s] - mouth[k]) < reach * reach)
          balls.push_back({seen_from_mouth(centre[s], mouth[k]), radius}), who.push_back(s);
      }
    const CoveredHole::Outcome outcome = law.evaluate(balls, h.exposure);
    h.cover = outcome.cover;
    open_area[k] = outcome.flow_area;
    sum += outcome.flow_area;
    for (std::size_t i = 0; i < who.size(); ++i)
      area.emplace_back(who[i], outcome.cover * turned_back(outcome.area[i]));
  }
  balance = suction_balance(parameters, sum);
  const double speed = std::sqrt(2 * balance.drop / parameters.density);
  double through = leak = leaking * speed;
  for (std::size_t k = 0; k < hole.size(); ++k) through += hole[k].flow = open_area[k] * speed;
  if (balance.flow > 0) flow_error = std::max(flow_error, std::abs(through / balance.flow - 1));
  const double strength = effects["Pressure gradient"].settings().strength;
  for (const auto& [s, a] : area) seed_load[s].pressure += strength * balance.drop * a;
}

Vec3 SuctionStep::velocity_at(const Vec3& x) const {
  const double pitch = device.pitch_radius * device.pitch_angle();
  const double limit = std::sqrt(2 * balance.drop / parameters.density);
  Vec3 sum;
  for (std::size_t k = 0; k < hole.size(); ++k) {
    if (hole[k].flow <= 0) continue;
    const Vec3 from = seen_from_mouth(x, mouth[k]);
    const double square = norm_square(from);
    if (square >= fade_to * fade_to * pitch * pitch) continue;
    const double distance = std::sqrt(square) / pitch;
    const double t = std::clamp((fade_to - distance) / (fade_to - fade_from), 0.0, 1.0);
    sum +=
        t * t * (3 - 2 * t) * turned_back(aperture_velocity(from, device.hole_radius(), hole[k].flow, limit));
  }
  return sum;
}

Vec3 SuctionStep::step(Dem& dem, double dt) {
  if (!bodies || bodies->n_spheres() != static_cast<std::size_t>(dem.n_spheres()))
    bodies.emplace(dem, coupling);
  bodies->update(dem);
  look(dem);
  const std::size_t n = bodies->size();
  AirAtBodies seen{std::vector<Vec3>(n), std::vector<Vec3>(n), std::vector<Vec3>(n), std::vector<Vec3>(n),
                   std::vector<double>(n, 1.0)};
  for (std::size_t b = 0; b < n; ++b) seen.velocity[b] = velocity_at(bodies->position[b]);
  body_loads.evaluate(*bodies, seen, dem, dem.time(), dt);

  SphereLoads loads;
  loads.force.resize(dem.n_spheres());
  Vec3 impulse;
  for (std::size_t b = 0; b < n; ++b) {
    const BodyForce& f = body_loads.force[b];
    const Body& body = (*bodies)[b];
    const Vec3 drag = f.drag_coefficient * (seen.velocity[b] - bodies->velocity[b]) + f.force;
    seed_load[body.seed].drag += drag;
    for (int s = body.first; s < body.last; ++s) loads.force[s] = bodies->share(s) * drag;
  }
  for (int seed = 0; seed < dem.n_seeds(); ++seed) {
    const double mass = dem.seed_template(seed).mass;
    for (int s = dem.first_sphere(seed); s < dem.first_sphere(seed + 1); ++s)
      loads.force[s] += dem.masses()[s] / mass * seed_load[seed].pressure;
    impulse += dt * (seed_load[seed].pressure + seed_load[seed].drag);
  }
  dem.set_loads(loads);
  dem.advance(dt);
  volume += balance.flow * dt;
  energy += balance.flow * balance.drop * dt;
  return impulse;
}

Vec3 SuctionStep::advance(Dem& dem, double duration) {
  const long n = std::max(1L, std::lround(std::ceil(duration / parameters.air_step - 1e-9)));
  Vec3 impulse;
  mean_load.assign(dem.n_seeds(), SeedLoad());
  for (long i = 0; i < n; ++i) {
    impulse += step(dem, duration / static_cast<double>(n));
    for (std::size_t s = 0; s < mean_load.size(); ++s) {
      mean_load[s].pressure += seed_load[s].pressure / static_cast<double>(n);
      mean_load[s].drag += seed_load[s].drag / static_cast<double>(n);
    }
  }
  return impulse;
}

void SuctionStep::save(std::ostream& out) const {
  write_binary(out, volume);
  write_binary(out, energy);
  write_binary(out, flow_error);
  body_loads.save(out);
}

void SuctionStep::load(std::istream& in) {
  read_binary(in, volume);
  read_binary(in, energy);
  read_binary(in, flow_error);
  body_loads.load(in);
}

}  // namespace seedflow
