#include "seedflow/effects/single_body.h"

#include <cmath>
#include <string>

namespace seedflow {
namespace {

void require_positive(double value, const char* what) {
  if (!(value > 0 && std::isfinite(value)))
    throw InputError(std::string("Single body: ") + what + " is " + std::to_string(value) +
                     "; it must be positive and finite.");
}

bool finite(const Vec3& v) {
  return std::isfinite(norm_square(v));
}

/// Solution after dt of m dv/dt = k (u - v) + f from v, and the distance covered.
struct Relaxation {
  Vec3 velocity, displacement;
  Relaxation(const Vec3& v, double m, double k, const Vec3& u, const Vec3& f, double dt) {
    const double x = k * dt / m;
    // phi1 = (1 - e^-x)/x, phi2 = (1 - phi1)/x, by series where the closed form cancels
    const double phi1 = x > 1e-4 ? -std::expm1(-x) / x : 1 - x / 2 + x * x / 6;
    const double phi2 = x > 1e-2 ? (1 - phi1) / x : 0.5 - x / 6 + x * x / 24 - x * x * x / 120;
    const Vec3 rate = (k * (u - v) + f) / m;
    velocity = v + (phi1 * dt) * rate;
    displacement = dt * v + (phi2 * dt * dt) * rate;
  }
};

}  // namespace

SingleBody::SingleBody(const SingleBodyProperties& p, const PrescribedFlow& flow, EffectSet& effects,
                       const SingleBodyState& start)
    : properties(p), flow(flow), effects(effects), now(start) {
  require_positive(p.diameter, "the diameter");
  require_positive(p.density, "the density");
  require_positive(p.sphericity, "the sphericity");
  require_positive(flow.density, "the density of the fluid");
  require_positive(flow.viscosity, "the viscosity of the fluid");
  body_mass = M_PI / 6 * std::pow(p.diameter, 3) * p.density;
  inertia = 0.1 * body_mass * p.diameter * p.diameter;
}

FlowAtBody SingleBody::flow_at(const SingleBodyState& s, double time, double step) const {
  FlowAtBody f;
  f.time = now.time;
  f.time_step = step;
  f.diameter = properties.diameter;
  f.volume = M_PI / 6 * std::pow(properties.diameter, 3);
  f.mass = body_mass;
  f.sphericity = properties.sphericity;
  f.position = s.position;
  f.velocity = s.velocity;
  f.angular_velocity = s.angular_velocity;
  f.acceleration = now.acceleration;
  f.density = flow.density;
  f.viscosity = flow.viscosity;
  f.gravity = flow.gravity;
  f.void_fraction = flow.void_fraction;
  f.tube_diameter = flow.tube_diameter;
  for (const auto& wall : flow.walls) {
    const double distance = dot(s.position - wall.point, wall.normal);
    if (distance < f.wall_distance) f.wall_distance = distance, f.wall_normal = wall.normal;
  }
  if (!flow.velocity) return f;

  f.flow_velocity = flow.velocity(s.position, time);
  // One step for slope and curvature: the slope of a wave of length d is then right to 7e-4, and round-off,
  // divided by the square of the step, is still 1e-12 of u/d^2.
  const double h = 1e-2 * properties.diameter, tau = 1e-2 * step;
  Vec3 gradient[3];  // gradient[j] = du/dx_j
  for (int j = 0; j < 3; ++j) {
    Vec3 ahead = s.position, behind = s.position;
    ahead[j] += h, behind[j] -= h;
    const Vec3 u_ahead = flow.velocity(ahead, time), u_behind = flow.velocity(behind, time);
    gradient[j] = (u_ahead - u_behind) / (2 * h);
    f.flow_laplacian += (u_ahead + u_behind - 2 * f.flow_velocity) / (h * h);
  }
  f.flow_vorticity = {gradient[1].z - gradient[2].y, gradient[2].x - gradient[0].z,
                      gradient[0].y - gradient[1].x};
  f.flow_acceleration =
      (flow.velocity(s.position, time + tau) - flow.velocity(s.position, time - tau)) / (2 * tau);
  for (int j = 0; j < 3; ++j) f.flow_acceleration += f.flow_velocity[j] * gradient[j];
  f.pressure_gradient = -flow.density * f.flow_acceleration;
  return f;
}

void SingleBody::step(double dt) {
  require_positive(dt, "the time step");
  const Vec3 weight = body_mass * flow.gravity;
  // From the start of the step over `span`, with the effects as they are at the state `at` and the time
  // `when`.
  const auto advance = [&](const SingleBodyState& at, double when, double span) {
    const FlowAtBody seen = flow_at(at, when, dt);
    BodyForce force;
    effects.add(seen, force);
    const Relaxation linear(now.velocity, body_mass + force.added_mass, force.drag_coefficient,
                            seen.flow_velocity, weight + force.force, span);
    SingleBodyState next = now;
    next.time = now.time + span;
    next.velocity = linear.velocity;
    next.position = now.position + linear.displacement;
    next.acceleration = (linear.velocity - now.velocity) / span;
    // The part of the torque along the relative spin relaxes it exactly.
    const Vec3 fluid_spin = 0.5 * seen.flow_vorticity, relative = fluid_spin - at.angular_velocity;
    const double square = norm_square(relative);
    const double rate = square > 0 ? std::max(0.0, dot(force.torque, relative) / square) : 0.0;
    next.angular_velocity =
        Relaxation(now.angular_velocity, inertia, rate, fluid_spin, force.torque - rate * relative, span)
            .velocity;
    return next;
  };
  const SingleBodyState middle = advance(now, now.time, 0.5 * dt);
  SingleBodyState next = advance(middle, now.time + 0.5 * dt, dt);
  if (!finite(next.velocity) || !finite(next.position) || !finite(next.angular_velocity))
    throw RunError("Single body: the motion is no longer finite at t = " + std::to_string(next.time) +
                   " s. Remedy: a smaller time step.");
  now = next;
}

std::vector<SingleBodyState> SingleBody::run(const std::vector<double>& times, double dt) {
  require_positive(dt, "the time step");
  std::vector<SingleBodyState> series;
  for (const double target : times) {
    const double start = now.time, left = target - start;
    if (left < 0) throw InputError("Single body: the output times must rise from the start time on.");
    const auto n = static_cast<long>(std::ceil(left / dt * (1 - 1e-12)));
    for (long i = 0; i < n; ++i) step(start + (i + 1) * (left / n) - now.time);
    if (n > 0) now.time = target;
    series.push_back(now);
  }
  return series;
}

}  // namespace seedflow
