#include "seedflow/seeds/contact_law.h"

#include <algorithm>
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
}

ContactForce contact_force(const ContactLaw& law, const ContactState& c, double step, Vec3& spring) {
  const double root = std::sqrt(c.reduced_radius * c.overlap);
  const double normal_stiffness = 4.0 / 3 * law.young * root, tangential_stiffness = 8 * law.shear * root;
  const double normal_speed = dot(c.velocity, c.normal);
  const Vec3 slip = c.velocity - normal_speed * c.normal;
  const double normal_force = normal_stiffness * c.overlap -
                              law.beta * std::sqrt(5 * c.reduced_mass * normal_stiffness) * normal_speed;
  ContactForce result;
  result.repulsion = std::max(0.0, normal_force);

  const double length = norm(spring);
  spring -= dot(spring, c.normal) * c.normal;
  const double projected = norm(spring);
  if (projected > 0) spring *= length / projected;
  spring += step * slip;

  const double limit = law.static_friction * result.repulsion;
  const auto cut_to_limit = [&](Vec3& a) {
    const double size = norm(a);
    if (size <= limit) return false;
    a *= limit / size;
    return true;
  };
  Vec3 tangential = -tangential_stiffness * spring;
  if (cut_to_limit(tangential)) {
    spring = (-1 / tangential_stiffness) * tangential;
  } else {
    tangential -= law.beta * std::sqrt(10.0 / 3 * c.reduced_mass * tangential_stiffness) * slip;
    cut_to_limit(tangential);
  }
  result.force = normal_force * c.normal + tangential;
  return result;
}

}  // namespace seedflow
