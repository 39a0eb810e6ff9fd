#pragma once

#include "seedflow/seeds/contact_law.h"
#include "seedflow/seeds/contact_sphere.h"

namespace seedflow {

/// lane_width contact spheres, one per lane.
struct LaneSphere {
  LaneVec3 position, velocity, spin, lever;
  Lanes radius, mass, inertia;

  SEEDFLOW_INLINE LaneSphere(const CacheLine* const (&motion)[lane_width],
                             const CacheLine* const (&turning)[lane_width]) {
    Lanes c[8];
    load_columns(motion, c);
    position = {c[0], c[1], c[2]}, radius = c[3], velocity = {c[4], c[5], c[6]}, mass = c[7];
    load_columns(turning, c);
    spin = {c[0], c[1], c[2]}, inertia = c[3], lever = {c[4], c[5], c[6]};
  }
};

/// What lane_width contacts remember.
struct LaneMemory {
  ContactMemory<Lanes> memory;

  SEEDFLOW_INLINE explicit LaneMemory(const CacheLine* const (&line)[lane_width]) {
    Lanes c[8];
    load_columns(line, c);
    memory.spring = {c[0], c[1], c[2]}, memory.rolling = {c[4], c[5], c[6]}, memory.attached = c[7];
  }
  SEEDFLOW_INLINE void to(Lanes normal_force, ContactLine (&line)[lane_width]) const {
    const Lanes c[8] = {memory.spring.x,  memory.spring.y,  memory.spring.z,  normal_force,
                        memory.rolling.x, memory.rolling.y, memory.rolling.z, memory.attached};
    to_records(c, line);
  }
};

SEEDFLOW_INLINE void records_of(const LaneVec3& force, const LaneVec3& torque,
                                ContactSum (&record)[lane_width]) {
  const Lanes c[8] = {force.x, force.y, force.z, Lanes{}, torque.x, torque.y, torque.z, Lanes{}};
  to_records(c, record);
}

SEEDFLOW_INLINE void add(ContactSum& sum, const ContactSum& part) {
  for (int c = 0; c < 8; ++c) sum[c] += part[c];
}

/// Force on the first body, torques on both about the centres they turn about.
struct PairAction {
  LaneVec3 force, torque_a, torque_b;
  Lanes normal_force;
};

/// Contact of two spheres. The contact point is the middle of the overlap; the rolling radius 2 R_a R_b /
/// (R_a
/// + R_b) is made of the distances from the centres of rotation to it.
template <Rolling rolling, Cohesion cohesion>
SEEDFLOW_INLINE PairAction act_between(const ContactLaw& law, const LaneSphere& a, const LaneSphere& b,
                                       Lanes share, double step, ContactMemory<Lanes>& memory) {
  const LaneVec3 d = a.position - b.position;
  const Lanes square = dot(d, d);
  const Lanes inverse_distance = inverse_root(lane_max(square, Lanes{} + 1e-200));
  const Lanes distance = square * inverse_distance;
  ContactKinematics<Lanes> c;
  c.normal = inverse_distance * d;
  c.normal.z += select(distance > 0.0, Lanes{}, Lanes{} + 1.0);  // same centre: any direction will do
  c.overlap = a.radius + b.radius - distance;
  // Two reduced quantities for one reciprocal.
  const Lanes radii = a.radius + b.radius, masses = a.mass + b.mass, both = inverse(radii * masses);
  c.reduced_radius = a.radius * b.radius * (both * masses);
  c.reduced_mass = a.mass * b.mass * (both * radii);
  c.share = share;
  const LaneVec3 arm_a = (0.5 * c.overlap - a.radius) * c.normal,
                 arm_b = (b.radius - 0.5 * c.overlap) * c.normal;
  c.velocity = a.velocity + cross(a.spin, arm_a) - b.velocity - cross(b.spin, arm_b);
  c.spin = a.spin - b.spin;
  const LaneVec3 lever_a = a.lever + arm_a, lever_b = b.lever + arm_b;
  if constexpr (rolling != Rolling::none) {
    const Lanes square_a = dot(lever_a, lever_a), square_b = dot(lever_b, lever_b);
    const Lanes ra = root(square_a), rb = root(square_b);
    const Lanes levers = ra + rb, inertias = a.inertia + b.inertia, inverse_both = inverse(levers * inertias);
    c.rolling_radius = 2.0 * ra * rb * (inverse_both * inertias);
    c.inertia = a.inertia * b.inertia * (inverse_both * levers);
    if constexpr (rolling == Rolling::epsd) {
      const Lanes ia = a.inertia + a.mass * square_a, ib = b.inertia + b.mass * square_b;
      c.contact_inertia = ia * ib * inverse(ia + ib);
    }
  }
  const ContactAction<Lanes> action = contact_action<rolling, cohesion>(law, c, step, memory);
  PairAction result;
  result.force = action.force;
  result.torque_a = cross(lever_a, action.force) + action.torque;
  result.torque_b = -cross(lever_b, action.force) - action.torque;
  result.normal_force = dot(action.force, c.normal);
  return result;
}

/// Contact of a sphere with a wall at `distance` from its centre, whose surface moves with `wall_velocity`.
template <Rolling rolling, Cohesion cohesion>
SEEDFLOW_INLINE PairAction act_on_wall(const ContactLaw& law, const LaneSphere& a, const LaneVec3& normal,
                                       Lanes distance, const LaneVec3& wall_velocity, Lanes share,
                                       double step, ContactMemory<Lanes>& memory) {
  ContactKinematics<Lanes> c;
  c.normal = normal;
  c.overlap = a.radius - distance;
  c.reduced_radius = a.radius;
  c.reduced_mass = a.mass;
  c.share = share;
  const LaneVec3 arm = -distance * normal;
  c.velocity = a.velocity + cross(a.spin, arm) - wall_velocity;
  c.spin = a.spin;
  const LaneVec3 lever = a.lever + arm;
  if constexpr (rolling != Rolling::none) {
    const Lanes square = dot(lever, lever);
    c.rolling_radius = root(square);
    c.inertia = a.inertia;
    c.contact_inertia = a.inertia + a.mass * square;
  }
  const ContactAction<Lanes> action = contact_action<rolling, cohesion>(law, c, step, memory);
  PairAction result;
  result.force = action.force;
  result.torque_a = cross(lever, action.force) + action.torque;
  result.normal_force = dot(action.force, c.normal);
  return result;
}

}  // namespace seedflow
