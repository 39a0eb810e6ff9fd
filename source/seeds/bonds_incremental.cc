// Bonds in the incremental form of the source paper's Eq. 1 (Potyondy & Cundall 2004).

#include "seedflow/seeds/bonds.h"

namespace seedflow {
namespace {

// The vector a that was across the unit vector `before`, carried along as this turns into `now` and then by
// `spin` about it; made perpendicular to `now` again, its length kept apart from that projection.
SEEDFLOW_INLINE LaneVec3 carried(const LaneVec3& a, const LaneVec3& before, const LaneVec3& now, Lanes spin) {
  const LaneVec3 tilt = cross(before, now);
  LaneVec3 r = a + cross(tilt, a);
  r += spin * cross(now, r);
  r -= dot(r, now) * now;
  return r;
}

}  // namespace

void Bonds::add_incremental(const SphereLanes* spheres, ForceLanes* forces, int b, double step) {
  Lanes lost = {};
  const int n = n_bonds();
  History* const own = &history[static_cast<std::size_t>(b) * n];
  Lanes* const whole = intact.empty() ? nullptr : &intact[static_cast<std::size_t>(b) * n];
  for (int k = 0; k < n; ++k) {
    const Constants& c = constants[k];
    const SphereLanes &si = spheres[c.first], &sj = spheres[c.second];
    ForceLanes &fi = forces[c.first], &fj = forces[c.second];
    History& h = own[k];
    const LaneVec3 d = sj.position - si.position;
    const LaneVec3 normal = (1.0 / lane_sqrt(dot(d, d))) * d;
    const LaneVec3 arm = 0.5 * d;
    const LaneVec3 rate = sj.velocity - si.velocity - cross(si.angular_velocity + sj.angular_velocity, arm);
    const LaneVec3 turn = sj.angular_velocity - si.angular_velocity;
    const Lanes spin = (0.5 * step) * dot(si.angular_velocity + sj.angular_velocity, normal);
    if (dot(h.direction, h.direction)[0] == 0.0) h.direction = normal;
    h.shear = carried(h.shear, h.direction, normal, spin);
    h.bend = carried(h.bend, h.direction, normal, spin);
    h.direction = normal;
    const Lanes stretching = dot(rate, normal), twisting = dot(turn, normal);
    h.normal += (step * c.normal) * stretching;
    h.twist -= (step * c.twist) * twisting;
    h.shear -= (step * c.shear) * (rate - stretching * normal);
    h.bend -= (step * c.bend) * (turn - twisting * normal);
    if (whole) {
      const Lanes sigma = h.normal / c.area + lane_sqrt(dot(h.bend, h.bend)) * (c.radius / c.inertia);
      const Lanes tau = lane_sqrt(dot(h.shear, h.shear)) / c.area +
                        select(h.twist < 0.0, -h.twist, h.twist) * (c.radius / (2 * c.inertia));
      const LaneMask breaks = (sigma > parameters.normal_strength) | (tau > parameters.shear_strength);
      const Lanes left = select(breaks, Lanes{}, whole[k]);
      lost += (whole[k] - left) * 0.5 *
              (h.normal * h.normal / c.normal + dot(h.shear, h.shear) / c.shear +
               dot(h.bend, h.bend) / c.bend + h.twist * h.twist / c.twist);
      whole[k] = left;
      h.normal *= left, h.twist *= left, h.shear = left * h.shear, h.bend = left * h.bend;
    }
    LaneVec3 force = h.shear - h.normal * normal;
    LaneVec3 moment = h.bend + h.twist * normal;
    if (parameters.damping_ratio > 0) {
      const Lanes carry = whole ? whole[k] : broadcast(1.0);
      const LaneVec3 drag = (carry * c.damping[0]) * rate, spin_drag = (carry * c.damping[1]) * turn;
      force -= drag;
      moment -= spin_drag;
      lost += step * (dot(drag, rate) + dot(spin_drag, turn));
    }
    fj.force += force;
    fi.force -= force;
    const LaneVec3 lever = cross(arm, force);
    fj.torque += moment - lever;
    fi.torque -= moment + lever;
  }
  dissipated[b] += lane_sum(lost);
}

}  // namespace seedflow
