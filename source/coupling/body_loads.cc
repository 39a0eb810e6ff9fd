#include "seedflow/coupling/body_loads.h"

#include <algorithm>
#include <sstream>

#include "seedflow/base/binary.h"
#include "seedflow/effects/regularised_disturbance.h"

namespace seedflow {

namespace {

/// Distance from x to the nearest wall and that wall's normal there.
void nearest_wall(const std::vector<Wall>& walls, const Vec3& x, double time, FlowAtBody& flow) {
  std::vector<WallPoint> points;
  for (const Wall& wall : walls) contacts_near(wall, x, flow.wall_distance, time, points);
  for (const WallPoint& p : points)
    if (p.distance < flow.wall_distance) flow.wall_distance = p.distance, flow.wall_normal = p.normal;
}

}  // namespace

double BodyLoads::pressure_gradient_strength() const {
  return air.pressure_shared ? effects["Pressure gradient"].settings().strength : 0.0;
}

double BodyLoads::slip_amplification(double own_share, double drag, double slip_speed) const {
  const double width = effective_width(sigma, sigma);
  const double mobility = steady_self_mobility(width * slip_speed * air.density / air.viscosity).along;
  const double remainder = 1.0 + own_share / 3.0 - drag * mobility / (air.viscosity * width);
  if (remainder < 0.2)
    throw RunError(
        "The self-induced velocity cannot be removed: the Gaussian kernel is so narrow that the fluid in it "
        "follows the "
        "body.\nRemedy: a larger 'Coupling/Kernel width' (one body diameter or more).");
  return 1.0 / remainder;
}

Vec3 BodyLoads::induced_velocity(std::size_t b, const Vec3& velocity, double time) {
  TransientSelfVelocity self(record[b]);
  if (time > last_time) path[b] += (time - last_time) * (0.5 * (velocity + last_velocity[b]) - last_air[b]);
  if (record[b].empty() || time > last_time) self.append(time, given[b], path[b]);
  return self.velocity(effective_width(sigma, sigma), {air.density, air.viscosity});
}

void BodyLoads::evaluate(const Bodies& bodies, const AirAtBodies& seen, const Dem& dem, double time,
                         double dt) {
  const std::size_t n = bodies.size();
  const bool first = last_velocity.size() != n;
  if (first) {
    last_velocity = bodies.velocity;
    last_drag.assign(n, 0.0);
    last_slip.assign(n, 0.0);
    last_time = time;
    given.assign(n, Vec3());
    path.assign(n, Vec3());
    last_air.assign(n, Vec3());
    record.assign(n, {});
  }
  force.assign(n, BodyForce());
  hydrostatic.assign(n, Vec3());
  const double hydrostatic_strength = effects["Pressure gradient"].settings().strength;
  // The search costs more than all else where there are many seeds and walls of triangles.
  const auto on = [&](const char* name) { return effects[name].settings().strength > 0; };
  const bool walls_matter = on("Plane wall drag") || on("Wall lift") || on("Inferred law");

  for (std::size_t b = 0; b < n; ++b) {
    const Body& body = bodies[b];
    FlowAtBody flow;
    flow.body = static_cast<std::int64_t>(b);
    flow.time = time;
    flow.time_step = dt;
    flow.diameter = body.diameter;
    flow.volume = body.buoyant_volume;
    flow.mass = body.mass;
    flow.sphericity = body.sphericity;
    flow.position = bodies.position[b];
    flow.velocity = bodies.velocity[b];
    flow.angular_velocity = bodies.angular_velocity[b];
    flow.acceleration =
        time > last_time ? (bodies.velocity[b] - last_velocity[b]) / (time - last_time) : Vec3();
    flow.flow_vorticity = seen.vorticity[b];
    flow.flow_acceleration = seen.acceleration[b];
    if (air.pressure_shared) flow.pressure_gradient = seen.pressure_gradient[b];
    flow.void_fraction = seen.void_fraction[b];
    flow.density = air.density;
    flow.viscosity = air.viscosity;
    flow.gravity = gravity;
    flow.tube_diameter = tube;
    if (walls_matter) nearest_wall(dem.walls(), flow.position, time, flow);

    double amplification = 1.0;  // undisturbed over averaged slip
    Vec3 induced;
    flow.flow_velocity = seen.velocity[b];
    if (sigma > 0) {
      const double own_share =
          displaces ? self_solid_fraction(body.solid_volume, effective_width(sigma, sigma)) : 0.0;
      if (transient) {
        induced = induced_velocity(b, flow.velocity, time);
        amplification = 1.0 / (1.0 + own_share / 3.0);
      } else {
        amplification = slip_amplification(own_share, last_drag[b], last_slip[b]);
      }
      flow.flow_velocity = flow.velocity + amplification * (seen.velocity[b] - induced - flow.velocity);
      flow.void_fraction = std::min(1.0, flow.void_fraction + own_share);
    }

    effects.add(flow, force[b]);
    last_drag[b] = force[b].drag_coefficient;
    last_slip[b] = norm(flow.flow_velocity - flow.velocity);
    last_air[b] = flow.flow_velocity;
    force[b].drag_coefficient *= amplification;
    if (!air.pressure_shared) force[b].drag_coefficient /= seen.void_fraction[b];
    force[b].force -= force[b].drag_coefficient * induced;
    hydrostatic[b] = -hydrostatic_strength * body.buoyant_volume * air.density * gravity;
  }
  last_velocity = bodies.velocity;
  last_time = time;
}

void BodyLoads::save(std::ostream& out) const {
  write_binary(out, last_drag);
  write_binary(out, last_slip);
  write_binary(out, last_velocity);
  write_binary(out, last_time);
  for (const auto* v : {&given, &path, &last_air}) write_binary(out, *v);
  write_binary(out, static_cast<std::uint64_t>(record.size()));
  for (const auto& r : record) write_binary(out, r);
}
void BodyLoads::load(std::istream& in) {
  read_binary(in, last_drag);
  read_binary(in, last_slip);
  read_binary(in, last_velocity);
  read_binary(in, last_time);
  for (auto* v : {&given, &path, &last_air}) read_binary(in, *v);
  std::uint64_t n = 0;
  read_binary(in, n);
  record.resize(n);
  for (auto& r : record) read_binary(in, r);
}

}  // namespace seedflow
