#pragma once

#include "seedflow/base/vector.h"
#include "seedflow/seeds/material.h"

namespace seedflow {

/// Hertz-Mindlin contact without slip between two materials, the source paper's Table 1 in its standard form:
///   1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j,  1/G* = (2 - nu_i)/G_i + (2 - nu_j)/G_j,
///   F_n = 4/3 E* sqrt(R*) delta^(3/2),  k_n = 4/3 E* sqrt(R* delta),  k_t = 8 G* sqrt(R* delta),
///   c_n = beta sqrt(5 m* k_n),  c_t = beta sqrt(10/3 m* k_t),  beta = -ln e/sqrt(ln^2 e + pi^2)
/// (Tsuji et al. 1992; Di Renzo & Di Maio 2004; EDEM's documentation for c_t).
struct ContactLaw {
  double young = 0;             ///< E* [Pa]
  double shear = 0;             ///< G* [Pa]
  double beta = 0;              ///< damping [1], >= 0
  double static_friction = 0;   ///< mu [1]
  double rolling_friction = 0;  ///< mu_r [1]

  ContactLaw() = default;
  ContactLaw(const Material& a, const Material& b, const ContactProperties& properties);
};

/// One contact as the law sees it. The normal points from the second body to the first.
struct ContactState {
  Vec3 normal;
  double overlap = 0;         ///< delta [m] > 0
  double reduced_radius = 0;  ///< R* [m]
  double reduced_mass = 0;    ///< m* [kg]
  Vec3 velocity;              ///< of the first body's surface relative to the second's, at the contact [m/s]
};

struct ContactForce {
  Vec3 force;            ///< on the first body [N]
  double repulsion = 0;  ///< its repulsive normal part, >= 0 [N]
};

/// Force of one contact after a step [s]; `spring` is the tangential displacement since the contact began
/// [m], turned into the present tangent plane and, when the contact slides, shortened so that the spring
/// alone carries mu times the repulsion. Damping acts only while sticking. The normal force may be attractive
/// at the end of a rebound (that makes restitution out equal restitution in); the Coulomb limit then is zero.
ContactForce contact_force(const ContactLaw& law, const ContactState& state, double step, Vec3& spring);

}  // namespace seedflow
