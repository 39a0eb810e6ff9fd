#include "seedflow/seeds/contact_law.h"

#include <cmath>

#include "seedflow/seeds/restitution.h"

namespace seedflow {
namespace {

/// The constant A [s] that gives the restitution in the impact the properties describe.
double dissipative_time(const Material& a, const Material& b, const ContactProperties& p, double young) {
  const double radius = p.restitution_diameter / 2, volume = 4.0 / 3 * M_PI * radius * radius * radius;
  const bool plane = p.restitution_counterpart == "plane";
  // On a plane the sphere is of the first material, the plane of the second.
  const double mass = plane ? volume * a.density : volume * a.density * b.density / (a.density + b.density);
  const double time = impact_time(plane ? radius : radius / 2, mass, young, p.restitution_speed);
  return dissipation_of(p.restitution) * time;
}

}  // namespace

ContactLaw::ContactLaw(const Material& a, const Material& b, const ContactProperties& p) {
  p.check("Contact between '" + a.name + "' and '" + b.name + "': ");
  const auto young_of = [](const Material& m) { return 2 * m.shear_modulus * (1 + m.poisson_ratio); };
  young = 1 / ((1 - a.poisson_ratio * a.poisson_ratio) / young_of(a) +
               (1 - b.poisson_ratio * b.poisson_ratio) / young_of(b));
  shear = 1 / ((2 - a.poisson_ratio) / a.shear_modulus + (2 - b.poisson_ratio) / b.shear_modulus);
  const double log_e = std::log(p.restitution);
  beta = -log_e / std::sqrt(log_e * log_e + M_PI * M_PI);
  static_friction = p.static_friction;
  if (p.tangential_model == "Mindlin with partial slip") partial_slip = p.partial_slip;

  // k_n = 4/3 E* a and k_t = 8 G* a make both damping coefficients multiples of sqrt(m* a).
  tangential_damping = beta * std::sqrt(80.0 / 3 * shear);
  const double viscoelastic = p.restitution_law == "viscoelastic" ? p.speed_dependence : 0;
  normal_damping = (1 - viscoelastic) * beta * std::sqrt(20.0 / 3 * young);
  if (viscoelastic > 0) viscous_damping = viscoelastic * 2 * dissipative_time(a, b, p, young) * young;

  rolling_numbers = {p.rolling_friction, p.rolling_damping, p.mobilised_damping};
  if (p.rolling_friction > 0 && p.rolling_model != "none")
    rolling = p.rolling_model == "EPSD" ? Rolling::epsd : Rolling::constant_torque;

  if (p.cohesion == "JKR") {
    cohesion = Cohesion::jkr;
    cohesion_numbers = CohesionNumbers::jkr(p.surface_energy, young);
  } else if (p.cohesion == "capillary bridge") {
    cohesion = Cohesion::capillary;
    cohesion_numbers = CohesionNumbers::capillary(p.surface_tension, p.contact_angle, p.bridge_volume);
  }
}

double ContactLaw::reach(double reduced_radius) const {
  switch (cohesion) {
    case Cohesion::jkr:
      return jkr_neck(cohesion_numbers, reduced_radius);
    case Cohesion::capillary:
      return bridge_rupture(cohesion_numbers, reduced_radius);
    case Cohesion::none:
      break;
  }
  return 0;
}

}  // namespace seedflow
