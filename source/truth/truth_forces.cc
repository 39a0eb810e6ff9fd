#include "truth_forces.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/truth/truth_laws.h"

namespace seedflow {

const std::vector<std::string>& truth_effects() {
  static const std::vector<std::string> names = {
      "Drag",       "Nonspherical drag", "Hindered settling", "Tube wall drag", "Plane wall drag",
      "Added mass", "Pressure gradient", "History force",     "Saffman lift",   "Magnus lift",
      "Wall lift",  "Rotational drag",   "Faxen force"};
  return names;
}

double TruthSeed::amplitude(const std::string& effect) const {
  const auto found = amplitudes.find(effect);
  return found == amplitudes.end() ? 0 : found->second;
}

double TruthSeed::volume() const {
  return M_PI / 6 * diameter * diameter * diameter;
}

double TruthSeed::mass() const {
  return density * volume();
}

double truth_moving_mass(const TruthSeed& s) {
  return s.mass() + 0.5 * s.amplitude("Added mass") * s.fluid_density * s.volume();
}

namespace {

struct NearestWall {
  double distance = 1e300;
  Vec3 normal;
};

NearestWall nearest_wall(const TruthSeed& s, const Vec3& x) {
  NearestWall nearest;
  for (const TruthWall& wall : s.walls) {
    const double distance = dot(x - wall.point, wall.normal);
    if (distance < nearest.distance) nearest = {distance, wall.normal};
  }
  return nearest;
}

/// 1 + a (g - 1)
double scaled(double amplitude, double factor) {
  return 1 + amplitude * (factor - 1);
}

}  // namespace

TruthForces truth_forces(const TruthSeed& s, const TruthState& state, double time) {
  const double d = s.diameter, a = 0.5 * d, rho = s.fluid_density, mu = s.viscosity, nu = mu / rho;
  const Vec3 u = s.flow.velocity(state.position, time), w = u - state.velocity;
  const Vec3 material = s.flow.rate_along(state.position, time, u);
  const Vec3 curl = s.flow.vorticity(state.position);
  const double speed = norm(w), re = d * speed / nu, turning = norm(curl);
  const NearestWall wall = nearest_wall(s, state.position);
  const bool walled = norm_square(wall.normal) > 0;
  TruthForces sum;

  double k = s.amplitude("Drag") * s.drag_level * 3 * M_PI * mu * d * truth_drag(re);
  if (s.unknown.drag_amplitude != 0 && re > 0)
    k *= 1 + s.unknown.drag_amplitude * std::pow(re / s.unknown.drag_reference, s.unknown.drag_exponent);
  if (const double amplitude = s.amplitude("Nonspherical drag"))
    k *= scaled(amplitude, truth_shape_factor(re, s.sphericity));
  if (const double amplitude = s.amplitude("Hindered settling"))
    k *= scaled(amplitude, truth_crowd_factor(re, s.void_fraction));
  if (const double amplitude = s.amplitude("Tube wall drag"); amplitude != 0 && s.tube_diameter > 0)
    k *= scaled(amplitude, truth_tube_factor(d / s.tube_diameter));
  sum.force += k * w;
  if (const double amplitude = s.amplitude("Plane wall drag"); amplitude != 0 && walled) {
    const double gap = std::max(wall.distance / a - 1, 1e-3);
    const Vec3 across = dot(w, wall.normal) * wall.normal;
    sum.force += (amplitude * k) * ((truth_approach_factor(gap) - 1) * across +
                                    (truth_along_factor(1 / (1 + gap)) - 1) * (w - across));
  }
  sum.force += (s.amplitude("Faxen force") * k * d * d / 24) * s.flow.laplacian();
  sum.force += (s.amplitude("Pressure gradient") * rho * s.volume()) * (material - s.gravity);
  sum.force += (0.5 * s.amplitude("Added mass") * rho * s.volume()) * material;

  if (turning > 0 && speed > 0) {
    const Vec3 across = cross(w, curl);  // |w| |curl u| where the shear is in the plane of the slip
    const double e = std::sqrt(nu * turning) / speed;
    sum.force +=
        (s.amplitude("Saffman lift") * 6.46 * a * a * std::sqrt(rho * mu / turning) * truth_shear_lift(e)) *
        across;
    if (s.unknown.shear_amplitude != 0)
      sum.force += (s.unknown.shear_amplitude * 3 * M_PI * mu * d *
                    std::pow(d * d * turning / nu, s.unknown.shear_exponent) / turning) *
                   across;
  }
  const Vec3 relative = 0.5 * curl - state.spin;
  if (const double rate = norm(relative); rate > 0) {
    if (speed > 0)
      sum.force +=
          (s.amplitude("Magnus lift") * M_PI * a * a * a * rho * truth_spin_lift(re, rate * d / speed)) *
          cross(relative, w);
    sum.torque += (s.amplitude("Rotational drag") * 8 * M_PI * mu * a * a * a) * relative;
  }
  if (const double amplitude = s.amplitude("Wall lift"); amplitude != 0 && walled) {
    const Vec3 along = w - dot(w, wall.normal) * wall.normal;
    const double x = std::min(a / wall.distance, 1.0);
    sum.force += (amplitude * rho * a * a * norm_square(along) * truth_wall_lift(x)) * wall.normal;
  }
  sum.force += s.mass() * s.unknown.uniform;
  sum.force.x -= s.mass() * s.unknown.trap * state.position.x;
  return sum;
}

}  // namespace seedflow
