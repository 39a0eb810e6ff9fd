#pragma once

#include <type_traits>

#include "seedflow/base/vector.h"
#include "seedflow/seeds/lane_vector.h"
#include "seedflow/seeds/material.h"

namespace seedflow {

enum class Rolling { none, constant_torque, epsd };
enum class Cohesion { none, jkr, capillary };

/// Contact between two materials: Hertz-Mindlin without slip, the source paper's Table 1 in its standard
/// form,
///   1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j,  1/G* = (2 - nu_i)/G_i + (2 - nu_j)/G_j,
///   a = sqrt(R* delta),  F_n = 4/3 E* a delta,  k_n = 4/3 E* a,  k_t = 8 G* a,
///   c_n = beta sqrt(5 m* k_n),  c_t = beta sqrt(10/3 m* k_t),  beta = -ln e/sqrt(ln^2 e + pi^2)
/// (Tsuji et al. 1992; Di Renzo & Di Maio 2004; EDEM's documentation for c_t).
struct ContactLaw {
  double young = 0;             ///< E* [Pa]
  double shear = 0;             ///< G* [Pa]
  double beta = 0;              ///< damping [1], >= 0
  double static_friction = 0;   ///< mu [1]
  double rolling_friction = 0;  ///< mu_r [1]
  Rolling rolling = Rolling::constant_torque;
  Cohesion cohesion = Cohesion::none;
  double normal_damping = 0;      ///< c_n / sqrt(m* a) [(N/m2)^(1/2)]
  double tangential_damping = 0;  ///< c_t / sqrt(m* a) [(N/m2)^(1/2)]

  ContactLaw() = default;
  ContactLaw(const Material& a, const Material& b, const ContactProperties& properties);

  /// Gap up to which a contact that once touched goes on acting [m]; 0 without cohesion. Lists must hold
  /// pairs up to this gap.
  double reach(double reduced_radius) const;
};

/// What the law is told of one contact (Real = double) or of lane_width contacts (Lanes). The normal points
/// from the second body to the first.
template <class Real>
struct ContactKinematics {
  VectorOf<Real> normal;
  Real overlap{};             ///< delta [m]; negative: a gap
  Real reduced_radius{};      ///< R* [m] > 0
  Real reduced_mass{};        ///< m* [kg] > 0
  VectorOf<Real> velocity;    ///< of the first body's surface relative to the second's at the contact [m/s]
  Real share = Real{} + 1.0;  ///< factor on all the contact does, see contact_share()
  // For rolling friction only.
  VectorOf<Real> spin;     ///< of the first body relative to the second [rad/s]
  Real rolling_radius{};   ///< R_r [m]
  Real inertia{};          ///< reduced, about the centres: limits what one step may stop [kg m2]
  Real contact_inertia{};  ///< reduced, of each body about the contact, I + m r^2 (EPSD) [kg m2]
};

/// What a contact remembers from step to step; all zero while apart.
template <class Real>
struct ContactMemory {
  VectorOf<Real> spring;   ///< tangential displacement since the contact began [m]
  VectorOf<Real> rolling;  ///< rolling angle since the contact began (EPSD) [rad]
  Real attached{};         ///< 1 while a cohesive contact holds, else 0
};

/// What a contact does to the first body; the second receives the opposite force (at the same point) and
/// torque.
template <class Real>
struct ContactAction {
  VectorOf<Real> force;   ///< [N]
  VectorOf<Real> torque;  ///< of rolling friction [N m]
  Real repulsion{};       ///< repulsive normal part, >= 0 [N]; Coulomb's limit is mu times this
};

/// Torque of constant size mu_r N R_r against the relative rotation, at most what stops it within the step.
template <class Real>
SEEDFLOW_INLINE VectorOf<Real> constant_rolling_torque(const ContactLaw& law,
                                                       const ContactKinematics<Real>& c, Real repulsion,
                                                       double inverse_step) {
  const Real speed = norm(c.spin);
  const Real size =
      lane_min(law.rolling_friction * repulsion * c.rolling_radius, inverse_step * c.inertia * speed);
  return (-size / lane_max(speed, Real{} + 1e-100)) * c.spin;
}

/// The law, without branches, once for one contact and for lanes. `step` [s]: time since the memory was last
/// brought up to date, 0 to only evaluate. A contact with a gap that is not attached gives exactly zero and
/// has its memory cleared, so unused lanes may hold any finite numbers with overlap <= 0.
///
/// The tangential spring is turned into the present tangent plane and, when the contact slides, shortened so
/// that the spring alone carries mu times the repulsion. Damping acts only while sticking. The normal force
/// may be attractive at the end of a rebound (that makes restitution out equal restitution in); Coulomb's
/// limit then is zero.
template <Rolling rolling, Cohesion cohesion, class Real>
SEEDFLOW_INLINE ContactAction<Real> contact_action(const ContactLaw& law, const ContactKinematics<Real>& c,
                                                   double step, ContactMemory<Real>& memory) {
  using Vector = VectorOf<Real>;
  constexpr double tiny = 1e-100;
  const Real zero{}, one = zero + 1.0;
  const auto touching = c.overlap > zero;
  const Real overlap = lane_max(c.overlap, zero);

  const Real contact_radius = lane_sqrt(c.reduced_radius * overlap);
  const Real elastic = 4.0 / 3 * law.young * contact_radius * overlap;
  const Real damping = c.share * lane_sqrt(c.reduced_mass * contact_radius);
  const Real normal_speed = dot(c.velocity, c.normal);
  const Vector slip = c.velocity - normal_speed * c.normal;
  const Real normal_force = c.share * elastic - law.normal_damping * damping * normal_speed;
  ContactAction<Real> result;
  result.repulsion = lane_max(normal_force, zero);

  const Real length = norm(memory.spring);
  Vector spring = memory.spring - dot(memory.spring, c.normal) * c.normal;
  spring = (length / lane_max(norm(spring), zero + tiny)) * spring + step * slip;

  const Real limit = law.static_friction * result.repulsion;
  const Real stiffness = 8 * law.shear * c.share * contact_radius;
  const Real trial = stiffness * norm(spring);
  const auto slides = trial > limit;
  spring = select(slides, limit / lane_max(trial, zero + tiny), one) * spring;
  Vector tangential = -stiffness * spring - select(slides, zero, law.tangential_damping * damping) * slip;
  const Real size = norm(tangential);
  tangential = select(size > limit, limit / lane_max(size, zero + tiny), one) * tangential;
  memory.spring = select(touching, one, zero) * spring;
  result.force = normal_force * c.normal + tangential;
  if constexpr (rolling == Rolling::constant_torque)
    result.torque = constant_rolling_torque(law, c, result.repulsion, step > 0 ? 1 / step : 1e200);
  return result;
}

/// Calls f(rolling, cohesion) with the law's models as compile-time constants (std::integral_constant), so
/// that a kernel is chosen once per law and models that are off cost nothing.
template <class F>
void with_models(const ContactLaw& law, const F& f) {
  const auto with_cohesion = [&](auto rolling) {
    switch (law.cohesion) {
      case Cohesion::none:
        return f(rolling, std::integral_constant<Cohesion, Cohesion::none>());
      case Cohesion::jkr:
        return f(rolling, std::integral_constant<Cohesion, Cohesion::jkr>());
      case Cohesion::capillary:
        return f(rolling, std::integral_constant<Cohesion, Cohesion::capillary>());
    }
  };
  switch (law.rolling) {
    case Rolling::none:
      return with_cohesion(std::integral_constant<Rolling, Rolling::none>());
    case Rolling::constant_torque:
      return with_cohesion(std::integral_constant<Rolling, Rolling::constant_torque>());
    case Rolling::epsd:
      return with_cohesion(std::integral_constant<Rolling, Rolling::epsd>());
  }
}

/// Share of each of n simultaneous sub-sphere contacts between the same two seeds (or a seed and a wall) when
/// contacts are normalised, 1/n: n contacts of the same overlap then are as stiff and as damped together as
/// one. Without normalisation the share is 1.
inline double contact_share(int n) {
  return 1.0 / n;
}

// For callers that hold one contact at a time and no memory but the tangential spring.
struct ContactState {
  Vec3 normal;
  double overlap = 0, reduced_radius = 0, reduced_mass = 0;
  Vec3 velocity;
};
struct ContactForce {
  Vec3 force;
  double repulsion = 0;
};
ContactForce contact_force(const ContactLaw& law, const ContactState& state, double step, Vec3& spring);

}  // namespace seedflow
