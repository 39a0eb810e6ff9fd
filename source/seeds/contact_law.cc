#include "seedflow/seeds/contact_law.h"

#include <cmath>

namespace seedflow {

ContactLaw::ContactLaw(const Material& a, const Material& b, const ContactProperties& properties) {
  const auto young_of = [](const Material& m) { return 2 * m.shear_modulus * (1 + m.poisson_ratio); };
  young = 1 / ((1 - a.poisson_ratio * a.poisson_ratio) / young_of(a) +
               (1 - b.poisson_ratio * b.poisson_ratio) / young_of(b));
  shear = 1 / ((2 - a.poisson_ratio) / a.shear_modulus + (2 - b.poisson_ratio) / b.shear_modulus);
  const double log_e = std::log(properties.restitution);
  beta = -log_e / std::sqrt(log_e * log_e + M_PI * M_PI);
  static_friction = properties.static_friction;
  rolling_friction = properties.rolling_friction;
  // k_n = 4/3 E* a and k_t = 8 G* a make both damping coefficients multiples of sqrt(m* a).
  normal_damping = beta * std::sqrt(20.0 / 3 * young);
  tangential_damping = beta * std::sqrt(80.0 / 3 * shear);
}

double ContactLaw::reach(double) const {
  return 0;
}

ContactForce contact_force(const ContactLaw& law, const ContactState& state, double step, Vec3& spring) {
  ContactKinematics<double> c;
  c.normal = state.normal;
  c.overlap = state.overlap;
  c.reduced_radius = state.reduced_radius;
  c.reduced_mass = state.reduced_mass;
  c.velocity = state.velocity;
  ContactMemory<double> memory;
  memory.spring = spring;
  const auto action = contact_action<Rolling::none, Cohesion::none>(law, c, step, memory);
  spring = memory.spring;
  return {action.force, action.repulsion};
}

}  // namespace seedflow
