#pragma once

#include <type_traits>

#include "seedflow/seeds/cohesion.h"
#include "seedflow/seeds/contact_state.h"
#include "seedflow/seeds/material.h"
#include "seedflow/seeds/partial_slip.h"
#include "seedflow/seeds/rolling_friction.h"

namespace seedflow {

/// Contact between two materials: Hertz-Mindlin without slip, the source paper's Table 1 in its standard
/// form,
///   1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j,  1/G* = (2 - nu_i)/G_i + (2 - nu_j)/G_j,
///   a = sqrt(R* delta),  F_n = 4/3 E* a delta,  k_n = 4/3 E* a,  k_t = 8 G* a,
///   c_n = beta sqrt(5 m* k_n),  c_t = beta sqrt(10/3 m* k_t),  beta = -ln e/sqrt(ln^2 e + pi^2)
/// (Tsuji et al. 1992; Di Renzo & Di Maio 2004; EDEM's documentation for c_t). Viscoelastic restitution has
/// c_n = 3/2 A k_n instead (restitution.h). Cohesion changes a and F_n (cohesion.h).
struct ContactLaw {
  double young = 0;            ///< E* [Pa]
  double shear = 0;            ///< G* [Pa]
  double beta = 0;             ///< damping [1], >= 0
  double static_friction = 0;  ///< mu [1]
  double partial_slip = 0;     ///< strength in [0, 1] of the rim's slip (partial_slip.h)
  Rolling rolling = Rolling::none;
  RollingNumbers rolling_numbers;
  Cohesion cohesion = Cohesion::none;
  CohesionNumbers cohesion_numbers;
  double normal_damping = 0;      ///< c_n / sqrt(m* a) [(N/m2)^(1/2)]
  double viscous_damping = 0;     ///< c_n / a of viscoelastic restitution, 2 A E* [Pa s]
  double tangential_damping = 0;  ///< c_t / sqrt(m* a) [(N/m2)^(1/2)]

  ContactLaw() = default;
  /// Throws InputError naming both materials if the properties are not consistent.
  ContactLaw(const Material& a, const Material& b, const ContactProperties& properties);

  /// Gap up to which a contact that once touched goes on acting [m]; 0 without cohesion. Lists must hold
  /// pairs up to this gap.
  double reach(double reduced_radius) const;
  /// Contacts remember more than their tangential spring.
  bool remembers_more() const {
    return rolling == Rolling::epsd || cohesion != Cohesion::none || partial_slip > 0;
  }
};

/// Elastic and cohesive normal force by the law's model.
template <Cohesion cohesion, class Real>
SEEDFLOW_INLINE NormalForce<Real> normal_force_of(const ContactLaw& law, const ContactKinematics<Real>& c,
                                                  Real attached) {
  if constexpr (cohesion == Cohesion::jkr)
    return jkr_force(law.cohesion_numbers, c, attached);
  else if constexpr (cohesion == Cohesion::capillary)
    return capillary_force(law.cohesion_numbers, law.young, c, attached);
  else
    return hertz_force(law.young, c);
}

/// The law, without branches, once for one contact and for lanes. `partial`: it may be one with partial slip.
/// A contact with a gap that is not attached gives exactly zero and has its memory cleared, so unused lanes
/// may hold any finite numbers with overlap <= 0 and attached = 0.
///
/// The tangential spring is turned into the present tangent plane and, when the contact slides, shortened so
/// that the spring alone carries Coulomb's limit. Damping acts only while sticking. Without cohesion the
/// normal force may be attractive at the end of a rebound: that makes restitution out equal restitution in.
///
/// Coulomb's limit, and the load of rolling friction, is the elastic repulsion, without damping and cohesion.
/// Its impulse over a collision is exactly that of the whole normal force, m* (1 + e) v_n, because the
/// impulse of the damping is an integral over the overlap alone, which returns to zero: so a collision that
/// slides throughout transfers mu m* (1 + e) v_n. The repulsive part with damping would give 3 % more at e =
/// 0.526.
template <Rolling rolling, Cohesion cohesion, bool partial = true, class Real>
SEEDFLOW_INLINE ContactAction<Real> contact_action(const ContactLaw& law, const ContactKinematics<Real>& c,
                                                   const ContactTimes& times, ContactMemory<Real>& memory) {
  using Vector = VectorOf<Real>;
  const Real zero{};
  const NormalForce<Real> f = normal_force_of<cohesion>(law, c, memory.attached);
  if constexpr (cohesion != Cohesion::none) memory.attached = f.attached;

  const Real damping = c.share * root(c.reduced_mass * f.contact_radius);
  const Real normal_speed = dot(c.velocity, c.normal);
  const Vector slip = c.velocity - normal_speed * c.normal;
  ContactAction<Real> result;
  result.repulsion = c.share * f.repulsion;
  const Real pushing =
      result.repulsion -
      (law.normal_damping * damping + law.viscous_damping * c.share * f.contact_radius) * normal_speed;

  const Real limit = law.static_friction * result.repulsion;
  const Real stiffness = 8 * law.shear * c.share * f.contact_radius;
  const Real touches = select(f.contact_radius > zero, zero + 1.0, zero);
  Vector spring = memory.spring;
  if (partial && cohesion == Cohesion::none && law.partial_slip > 0) {
    partial_slip<Real>(law.partial_slip, c, slip, normal_speed, limit / lane_max(stiffness, zero + 1e-100),
                       times.passed, spring, memory.attached);
    memory.attached *= touches;
  } else {
    spring = turned_into_plane<Real>(spring, c.normal) + times.passed * slip;
  }
  const Real trial_square = stiffness * stiffness * dot(spring, spring), limit_square = limit * limit;
  spring = cut(trial_square, limit, limit_square) * spring;
  Vector tangential = -stiffness * spring -
                      select(trial_square > limit_square, zero, law.tangential_damping * damping) * slip;
  tangential = cut<Real>(dot(tangential, tangential), limit, limit_square) * tangential;
  memory.spring = touches * spring;
  if constexpr (cohesion == Cohesion::none)
    result.force = pushing * c.normal + tangential;
  else
    result.force = (pushing - c.share * f.attraction) * c.normal + tangential;

  if constexpr (rolling == Rolling::constant_torque)
    result.torque = constant_rolling_torque(law.rolling_numbers, c, result.repulsion,
                                            times.step > 0 ? 1 / times.step : 1e200);
  if constexpr (rolling == Rolling::epsd) {
    const Real k = 4.0 / 3 * law.young * c.share * f.contact_radius;
    result.torque = touches * epsd_rolling_torque(law.rolling_numbers, c, result.repulsion, k, times.passed,
                                                  memory.rolling);
    memory.rolling = touches * memory.rolling;
  }
  return result;
}

/// What a contact of these models remembers beyond its tangential spring.
template <Rolling rolling, Cohesion cohesion, bool partial>
inline constexpr bool remembers_more = rolling == Rolling::epsd || cohesion != Cohesion::none || partial;

/// Calls f(rolling, cohesion, partial slip) with the law's models as compile-time constants
/// (std::integral_constant), so that a kernel is chosen once per law and models that are off cost nothing.
template <class F>
void with_models(const ContactLaw& law, const F& f) {
  const auto with_cohesion = [&](auto rolling) {
    switch (law.cohesion) {
      case Cohesion::none: {
        const std::integral_constant<Cohesion, Cohesion::none> none;
        return law.partial_slip > 0 ? f(rolling, none, std::true_type())
                                    : f(rolling, none, std::false_type());
      }
      case Cohesion::jkr:
        return f(rolling, std::integral_constant<Cohesion, Cohesion::jkr>(), std::false_type());
      case Cohesion::capillary:
        return f(rolling, std::integral_constant<Cohesion, Cohesion::capillary>(), std::false_type());
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

}  // namespace seedflow
