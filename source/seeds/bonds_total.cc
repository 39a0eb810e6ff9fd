// Bonds in total form: the forces are the derivatives of the energy in bonds.h.

#include <algorithm>
#include <cmath>

#include "seedflow/seeds/bonds.h"

namespace seedflow {
namespace {

// Calls the next block into the second-level cache, a few lines with every bond, so that the arithmetic hides
// it.
class CacheLines {
 public:
  CacheLines(const NextBlock& next, int n_spheres, int n_bonds)
      : present(reinterpret_cast<const char*>(next.spheres)),
        end(present),
        other(reinterpret_cast<const char*>(next.forces)) {
    if (next.spheres) end += n_spheres * sizeof(SphereLanes);
    if (next.forces) other_size = n_spheres * sizeof(ForceLanes);
    per_bond = static_cast<int>((end - present + other_size) / 64 / std::max(1, n_bonds)) + 1;
  }
  SEEDFLOW_INLINE void call_some() {
    for (int line = 0; line < per_bond && present < end; ++line, present += 64)
      __builtin_prefetch(present, 1, 2);
    if (present >= end && other_size > 0) present = other, end = other + other_size, other_size = 0;
  }

 private:
  const char *present, *end, *other;
  std::size_t other_size = 0;
  int per_bond;
};

}  // namespace

template <bool breaking, bool damping>
void Bonds::add_total(const SphereLanes* spheres, ForceLanes* forces, int b, double step,
                      const NextBlock& next) {
  Lanes lost = {};
  const int n = n_bonds();
  Lanes* whole = breaking ? &intact[static_cast<std::size_t>(b) * n] : nullptr;
  CacheLines ahead(next, n_spheres, n);
  for (int k = 0; k < n;) {
    const int i = constants[k].first;
    const SphereLanes& si = spheres[i];
    const LaneVec3 xi = si.position;
    const LaneQuaternion qi = si.orientation;
    LaneVec3 force_i = forces[i].force, torque_i = forces[i].torque;
    for (; k < n && constants[k].first == i; ++k) {
      const Constants& c = constants[k];
      const SphereLanes& sj = spheres[c.second];
      ForceLanes& fj = forces[c.second];
      ahead.call_some();
      const LaneQuaternion qj = sj.orientation;
      const LaneVec3 half{broadcast(c.half[0]), broadcast(c.half[1]), broadcast(c.half[2])};
      const LaneVec3 both = 2.0 * half;
      const LaneVec3 ai = rotate_half(qi, half, both), aj = rotate_half(qj, half, both);
      const LaneVec3 e = ai + aj;
      const LaneVec3 g = sj.position - xi - e;
      const Lanes ge = dot(g, e);
      const Lanes stretch = c.stretch * ge;
      // dU/dx_j and dU/de.
      LaneVec3 pull = c.shear * g + stretch * e;
      LaneVec3 lever = stretch * (g - e) - c.shear * g;
      // Relative rotation q_j q_i^-1 = (w, v) and the moment it gives to i.
      const Lanes w = qj.w * qi.w + dot(qj.v, qi.v);
      const LaneVec3 v = qi.w * qj.v - qj.w * qi.v + cross(qi.v, qj.v);
      const Lanes twist = c.twist_extra * dot(v, ai);
      LaneVec3 moment = (2.0 * w) * (c.bend * v + twist * ai) + (2.0 * twist) * cross(v, ai);
      if constexpr (damping) {
        const LaneVec3 d = 0.5 * (sj.position - xi);
        const LaneVec3 rate = sj.velocity - si.velocity - cross(si.angular_velocity + sj.angular_velocity, d);
        const LaneVec3 turn = sj.angular_velocity - si.angular_velocity;
        LaneVec3 drag = c.damping[0] * rate, spin_drag = c.damping[1] * turn;
        if constexpr (breaking) drag = whole[k] * drag, spin_drag = whole[k] * spin_drag;
        force_i += drag;
        fj.force -= drag;
        const LaneVec3 arm = cross(d, drag);
        torque_i += arm + spin_drag;
        fj.torque += arm - spin_drag;
        lost += step * (dot(drag, rate) + dot(spin_drag, turn));
      }
      if constexpr (breaking) {
        // Eq. 2 in its standard form at the present state; a bond that reaches its strength carries nothing
        // more.
        const Lanes inverse = 1.0 / lane_sqrt(dot(e, e));
        const LaneVec3 along = inverse * e;
        const Lanes tension = dot(pull, along);
        const LaneVec3 across = pull - tension * along;
        const Lanes torsion = dot(moment, along);
        const LaneVec3 bending = moment - torsion * along;
        const Lanes sigma = tension / c.area + lane_sqrt(dot(bending, bending)) * (c.radius / c.inertia);
        const Lanes tau = lane_sqrt(dot(across, across)) / c.area +
                          select(torsion < 0.0, -torsion, torsion) * (c.radius / (2 * c.inertia));
        const LaneMask breaks = (sigma > parameters.normal_strength) | (tau > parameters.shear_strength);
        const Lanes left = select(breaks, Lanes{}, whole[k]);
        const Lanes energy = 0.5 * (c.shear * dot(g, g) + stretch * ge) + 2.0 * (c.bend * dot(v, v)) +
                             2.0 * twist * dot(v, ai);
        lost += (whole[k] - left) * energy;
        whole[k] = left;
        pull = left * pull, lever = left * lever, moment = left * moment;
      }
      force_i += pull;
      fj.force -= pull;
      torque_i += moment - cross(ai, lever);
      fj.torque -= moment + cross(aj, lever);
    }
    forces[i].force = force_i;
    forces[i].torque = torque_i;
  }
  if constexpr (breaking || damping) dissipated[b] += lane_sum(lost);
}

void Bonds::add_forces(const SphereLanes* spheres, ForceLanes* forces, int b, double step,
                       const NextBlock& next) {
  const bool breaking = !intact.empty(), damping = parameters.damping_ratio > 0;
  if (!history.empty())
    add_incremental(spheres, forces, b, step);
  else if (breaking)
    damping ? add_total<true, true>(spheres, forces, b, step, next)
            : add_total<true, false>(spheres, forces, b, step, next);
  else
    damping ? add_total<false, true>(spheres, forces, b, step, next)
            : add_total<false, false>(spheres, forces, b, step, next);
}

Lanes Bonds::energy(const SphereLanes* spheres, int b) const {
  Lanes sum = {};
  const int n = n_bonds();
  for (int k = 0; k < n; ++k) {
    const Constants& c = constants[k];
    const Lanes left = intact.empty() ? broadcast(1.0) : intact[static_cast<std::size_t>(b) * n + k];
    if (!history.empty()) {
      const History& h = history[static_cast<std::size_t>(b) * n + k];
      sum += (0.5 * left) * (h.normal * h.normal / c.normal + dot(h.shear, h.shear) / c.shear +
                             dot(h.bend, h.bend) / c.bend + h.twist * h.twist / c.twist);
      continue;
    }
    const SphereLanes &si = spheres[c.first], &sj = spheres[c.second];
    const LaneVec3 half{broadcast(c.half[0]), broadcast(c.half[1]), broadcast(c.half[2])};
    const LaneVec3 ai = rotate(si.orientation, half);
    const LaneVec3 e = ai + rotate(sj.orientation, half);
    const LaneVec3 g = sj.position - si.position - e;
    const Lanes ge = dot(g, e);
    const LaneVec3 v = si.orientation.w * sj.orientation.v - sj.orientation.w * si.orientation.v +
                       cross(si.orientation.v, sj.orientation.v);
    const Lanes va = dot(v, ai);
    sum += left * (0.5 * (c.shear * dot(g, g) + c.stretch * ge * ge) + 2.0 * c.bend * dot(v, v) +
                   2.0 * c.twist_extra * va * va);
  }
  return sum;
}

}  // namespace seedflow
