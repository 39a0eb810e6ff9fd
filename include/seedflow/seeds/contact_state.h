#pragma once

#include "seedflow/seeds/lane_root.h"
#include "seedflow/seeds/lane_vector.h"

namespace seedflow {

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
  Real attached{};         ///< 1 while a cohesive contact holds, else 0; partial slip: its turning point
};

/// The times of one call of the law [s].
struct ContactTimes {
  ContactTimes(double substep) : passed(substep), step(substep) {}
  ContactTimes(double since, double substep) : passed(since), step(substep) {}
  double passed;  ///< since the memory was last brought up to date: 0 to only evaluate
  double step;    ///< for which the force will act: limits what rolling friction may stop; 0: no limit
};

/// What a contact does to the first body; the second receives the opposite force (at the same point) and
/// torque.
template <class Real>
struct ContactAction {
  VectorOf<Real> force;   ///< [N]
  VectorOf<Real> torque;  ///< of rolling friction [N m]
  Real repulsion{};       ///< elastic, >= 0 [N]; Coulomb's limit is mu times this
};

/// A vector kept in the tangent plane of a contact that turns: its part along the normal is removed and its
/// length restored.
template <class Real>
SEEDFLOW_INLINE VectorOf<Real> turned_into_plane(const VectorOf<Real>& a, const VectorOf<Real>& normal) {
  const VectorOf<Real> projected = a - dot(a, normal) * normal;
  // |a| / |projected| with one root.
  const Real square = dot(a, a);
  return (square * inverse_root(lane_max(square * dot(projected, projected), Real{} + 1e-200))) * projected;
}

/// Factor that cuts a vector to the length `limit` if the square of its length is above limit_square.
template <class Real>
SEEDFLOW_INLINE Real cut(Real square, Real limit, Real limit_square) {
  return select(square > limit_square, limit * inverse_root(lane_max(square, Real{} + 1e-200)), Real{} + 1.0);
}

}  // namespace seedflow
