#pragma once

#include "seedflow/seeds/contact_law.h"
#include "seedflow/seeds/contact_memory_pool.h"
#include "seedflow/seeds/contact_sphere.h"
#include "seedflow/seeds/lane_pair.h"

namespace seedflow {

// Real: Lanes or LanePair. `levers`: bodies turn about other points than the centres of their sub-spheres.

/// Sub-spheres, one per lane, and their bodies.
template <class Real, bool levers>
struct LaneSphere {
  VectorOf<Real> position, velocity, spin;  ///< velocity of the body's centre
  VectorOf<Real> lever;                     ///< from the body's centre to the sub-sphere's
  Real radius, mass, inertia;

  /// Records of the sub-spheres, their bodies' motion and (with levers) centres.
  template <class Spheres, class Motions, class Centres>
  SEEDFLOW_INLINE LaneSphere(const Spheres& sphere, const Motions& motion, const Centres& centre) {
    Real s[4], m[8];
    load_columns(sphere, s);
    position = {s[0], s[1], s[2]}, radius = s[3];
    load_columns(motion, m);
    velocity = {m[0], m[1], m[2]}, mass = m[3], spin = {m[4], m[5], m[6]}, inertia = m[7];
    if constexpr (levers) {
      Real c[4];
      load_columns(centre, c);
      lever = position - VectorOf<Real>{c[0], c[1], c[2]};
    }
  }
};

/// What the contacts in the lanes remember; second halves where `whole`.
template <class Real, bool whole>
struct LaneMemory {
  ContactMemory<Real> memory;

  template <class First, class Second>
  SEEDFLOW_INLINE LaneMemory(const First& first, const Second& second) {
    Real c[4];
    load_columns(first, c);
    memory.spring = {c[0], c[1], c[2]};
    if constexpr (whole) {
      load_columns(second, c);
      memory.rolling = {c[0], c[1], c[2]}, memory.attached = c[3];
    }
  }
  SEEDFLOW_INLINE void first_half(const Real& normal_force, HalfLine* first) const {
    store_records(first, memory.spring.x, memory.spring.y, memory.spring.z, normal_force);
  }
  SEEDFLOW_INLINE void second_half(HalfLine* second) const {
    store_records(second, memory.rolling.x, memory.rolling.y, memory.rolling.z, memory.attached);
  }
};

template <class Real>
SEEDFLOW_INLINE void records_of(const VectorLanes<Real>& force, const VectorLanes<Real>& torque,
                                ContactSum* record) {
  store_records(record, force.x, force.y, force.z, Real{}, torque.x, torque.y, torque.z, Real{});
}

SEEDFLOW_INLINE void add(ContactSum& sum, const ContactSum& part) {
  for (int c = 0; c < 8; ++c) sum[c] += part[c];
}

/// Force on the first body, torques on both about the centres they turn about.
template <class Real>
struct PairAction {
  VectorOf<Real> force, torque_a, torque_b;
  Real normal_force;
};

/// Contact of two spheres. The contact point is the middle of the overlap; the rolling radius 2 R_a R_b /
/// (R_a + R_b) is made of the distances from the centres of rotation to it.
template <Rolling rolling, Cohesion cohesion, bool partial = true, class Real, bool levers>
SEEDFLOW_INLINE PairAction<Real> act_between(const ContactLaw& law, const LaneSphere<Real, levers>& a,
                                             const LaneSphere<Real, levers>& b, const Real& share,
                                             const ContactTimes& times, ContactMemory<Real>& memory) {
  using Vector = VectorOf<Real>;
  const Vector d = a.position - b.position;
  const Real square = dot(d, d);
  const Real inverse_distance = inverse_root(lane_max(square, Real{} + 1e-200));
  const Real distance = square * inverse_distance;
  ContactKinematics<Real> c;
  c.normal = inverse_distance * d;
  c.normal.z += select(distance > 0.0, Real{}, Real{} + 1.0);  // same centre: any direction will do
  c.overlap = a.radius + b.radius - distance;
  // Two reduced quantities for one reciprocal.
  const Real radii = a.radius + b.radius, masses = a.mass + b.mass, both = inverse(radii * masses);
  c.reduced_radius = a.radius * b.radius * (both * masses);
  c.reduced_mass = a.mass * b.mass * (both * radii);
  c.share = share;
  const Real to_a = a.radius - 0.5 * c.overlap, to_b = b.radius - 0.5 * c.overlap;
  Vector lever_a, lever_b;
  Real square_a, square_b, ra, rb;
  if constexpr (levers) {
    lever_a = a.lever - to_a * c.normal, lever_b = b.lever + to_b * c.normal;
    c.velocity = a.velocity + cross(a.spin, lever_a) - b.velocity - cross(b.spin, lever_b);
    if constexpr (rolling != Rolling::none) {
      square_a = dot(lever_a, lever_a), square_b = dot(lever_b, lever_b);
      ra = root(square_a), rb = root(square_b);
    }
  } else {
    // Both levers lie along the normal.
    c.velocity = a.velocity - b.velocity - cross(to_a * a.spin + to_b * b.spin, c.normal);
    square_a = to_a * to_a, square_b = to_b * to_b;
    ra = lane_max(to_a, -to_a), rb = lane_max(to_b, -to_b);
  }
  c.spin = a.spin - b.spin;
  if constexpr (rolling != Rolling::none) {
    const Real sum = ra + rb, inertias = a.inertia + b.inertia, inverse_both = inverse(sum * inertias);
    c.rolling_radius = 2.0 * ra * rb * (inverse_both * inertias);
    c.inertia = a.inertia * b.inertia * (inverse_both * sum);
    if constexpr (rolling == Rolling::epsd) {
      const Real ia = a.inertia + a.mass * square_a, ib = b.inertia + b.mass * square_b;
      c.contact_inertia = ia * ib * inverse(ia + ib);
    }
  }
  const ContactAction<Real> action = contact_action<rolling, cohesion, partial>(law, c, times, memory);
  PairAction<Real> result;
  result.force = action.force;
  if constexpr (levers) {
    result.torque_a = cross(lever_a, action.force) + action.torque;
    result.torque_b = -cross(lever_b, action.force) - action.torque;
  } else {
    const Vector turn = cross(action.force, c.normal);
    result.torque_a = to_a * turn + action.torque;
    result.torque_b = to_b * turn - action.torque;
  }
  result.normal_force = dot(action.force, c.normal);
  return result;
}

/// Contact of a sphere with a wall at `distance` from its centre, whose surface moves with `wall_velocity`.
template <Rolling rolling, Cohesion cohesion, bool partial = true, class Real, bool levers>
SEEDFLOW_INLINE PairAction<Real> act_on_wall(const ContactLaw& law, const LaneSphere<Real, levers>& a,
                                             const VectorLanes<Real>& normal, const Real& distance,
                                             const VectorLanes<Real>& wall_velocity, const Real& share,
                                             const ContactTimes& times, ContactMemory<Real>& memory) {
  ContactKinematics<Real> c;
  c.normal = normal;
  c.overlap = a.radius - distance;
  c.reduced_radius = a.radius;
  c.reduced_mass = a.mass;
  c.share = share;
  VectorOf<Real> lever = -distance * normal;
  if constexpr (levers) lever = a.lever + lever;
  c.velocity = a.velocity + cross(a.spin, lever) - wall_velocity;
  c.spin = a.spin;
  if constexpr (rolling != Rolling::none) {
    const Real square = dot(lever, lever);
    c.rolling_radius = root(square);
    c.inertia = a.inertia;
    c.contact_inertia = a.inertia + a.mass * square;
  }
  const ContactAction<Real> action = contact_action<rolling, cohesion, partial>(law, c, times, memory);
  PairAction<Real> result;
  result.force = action.force;
  result.torque_a = cross(lever, action.force) + action.torque;
  result.normal_force = dot(action.force, c.normal);
  return result;
}

}  // namespace seedflow
