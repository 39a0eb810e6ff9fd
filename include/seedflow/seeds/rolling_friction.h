#pragma once

#include "seedflow/seeds/contact_state.h"

namespace seedflow {

enum class Rolling { none, constant_torque, epsd };

/// Numbers of rolling friction for one pair of materials.
struct RollingNumbers {
  double coefficient = 0;        ///< mu_r [1]
  double damping_ratio = 0.3;    ///< eta of EPSD [1]
  double mobilised_damping = 0;  ///< f of EPSD: part of the dashpot that stays at full mobilisation [1]
};

/// Torque of constant size mu_r N R_r against the relative rotation (all of it, twisting included), at most
/// what stops it within the step (model A of Ai et al. 2011, Powder Technol. 206, 269-282,
/// doi:10.1016/j.powtec.2010.09.030). What other forces turn the body by within one step h is not resisted:
/// on a slope a sphere at rest creeps at 5/2 g sin(slope) h. EPSD does not creep. `inverse_step` [1/s]: any
/// huge number asks for the full torque.
template <class Real>
SEEDFLOW_INLINE VectorOf<Real> constant_rolling_torque(const RollingNumbers& n,
                                                       const ContactKinematics<Real>& c, Real repulsion,
                                                       double inverse_step) {
  const Real inverse_spin = inverse_root(lane_max(dot(c.spin, c.spin), Real{} + 1e-200));
  return -lane_min(n.coefficient * repulsion * c.rolling_radius * inverse_spin, inverse_step * c.inertia) *
         c.spin;
}

/// Elastic-plastic spring and dashpot (model C of Ai et al. 2011; spring of Iwashita & Oda 1998):
///   M = -k_r theta - C_r theta',  k_r = 2.25 k_n mu_r^2 R_r^2,  C_r = 2 eta sqrt(I_r k_r),
/// theta the rolling angle in the tangent plane, I_r the reduced moment of inertia about the contact. The
/// spring carries at most mu_r N R_r; then it slips and only the part f of the dashpot is left. Twisting is
/// not resisted. `stiffness`: k_n [N/m].
template <class Real>
SEEDFLOW_INLINE VectorOf<Real> epsd_rolling_torque(const RollingNumbers& n, const ContactKinematics<Real>& c,
                                                   Real repulsion, Real stiffness, double step,
                                                   VectorOf<Real>& angle) {
  const VectorOf<Real> rate = c.spin - dot(c.spin, c.normal) * c.normal;
  angle = turned_into_plane<Real>(angle, c.normal) + step * rate;
  const Real lever = n.coefficient * c.rolling_radius, spring = 2.25 * stiffness * lever * lever;
  const Real limit = repulsion * lever, limit_square = limit * limit;
  const Real torque_square = spring * spring * dot(angle, angle);
  angle = cut(torque_square, limit, limit_square) * angle;
  const Real dashpot = 2 * n.damping_ratio * lane_sqrt(c.share * c.contact_inertia * spring);
  const Real active = select(torque_square > limit_square, Real{} + n.mobilised_damping, Real{} + 1.0);
  return -spring * angle - active * dashpot * rate;
}

}  // namespace seedflow
