#pragma once

#include "seedflow/seeds/contact_state.h"

namespace seedflow {

enum class Cohesion { none, jkr, capillary };

/// Numbers of cohesion for one pair of materials.
struct CohesionNumbers {
  // JKR
  double adhesion = 0;  ///< w: work of adhesion of the two surfaces [J/m2]
  double root = 0;      ///< sqrt(2 pi w/E*) [m^(1/2)]
  // Capillary bridge
  double tension = 0;            ///< 2 pi gamma cos(theta) [N/m]
  double inverse_root = 0;       ///< V^(-1/2) [m^(-3/2)]
  double rupture = 0;            ///< (1 + theta/2) V^(1/3) [m]
  double rupture_curvature = 0;  ///< 0.1 (1 + theta/2) V^(2/3) [m2]

  static CohesionNumbers jkr(double work_of_adhesion, double young);
  /// surface tension [N/m], contact angle [rad], liquid volume of one bridge [m3].
  static CohesionNumbers capillary(double surface_tension, double contact_angle, double volume);
};

/// Elastic and cohesive normal force of one contact. Multiplied by the contact's share later.
template <class Real>
struct NormalForce {
  Real contact_radius;  ///< a [m], 0 while nothing but a liquid bridge connects the bodies
  Real repulsion;       ///< >= 0 [N]
  Real attraction;      ///< >= 0 [N]
  Real attached;        ///< 1: the contact acts
};

/// Hertz: a = sqrt(R* delta), F = 4/3 E* a delta.
template <class Real>
SEEDFLOW_INLINE NormalForce<Real> hertz_force(double young, const ContactKinematics<Real>& c) {
  const Real zero{}, overlap = lane_max(c.overlap, zero);
  const Real a = root(c.reduced_radius * overlap);
  return {a, 4.0 / 3 * young * a * overlap, zero, select(c.overlap > zero, zero + 1.0, zero)};
}

/// Johnson, Kendall & Roberts (1971), Proc. R. Soc. A 324, 301-313, doi:10.1098/rspa.1971.0141:
///   delta = a^2/R* - sqrt(2 pi w a/E*),  F = 4/3 E* a^3/R* - sqrt(8 pi w E* a^3).
/// It begins when the surfaces meet (delta = 0, F = -4/3 pi w R*), pulls at most 3/2 pi w R* and breaks when
/// the gap exceeds 3/4 (pi^2 w^2 R*/(2 E*^2) ...)^(1/3), see jkr_neck(), where F = -5/6 pi w R*.
///
/// With x = sqrt(a/a_m), a_m = (R* sqrt(2 pi w/E*)/4)^(2/3) at the breaking gap, the first equation is
/// x^4/4 - x = delta/(unit of length), solved for its stable branch x >= 1 by Newton's iteration from above,
/// and the second F = pi w R* (x^6/6 - x^3).
template <class Real>
SEEDFLOW_INLINE NormalForce<Real> jkr_force(const CohesionNumbers& n, const ContactKinematics<Real>& c,
                                            Real attached) {
  const Real zero{}, one = zero + 1.0;
  const Real root = lane_cbrt(0.25 * n.root * c.reduced_radius), unit = n.root * root;
  const Real scaled = c.overlap / unit, above = lane_max(scaled + 0.75, zero);
  // Two upper bounds, good near the breaking point and far from it.
  Real x = lane_min(1.0 + lane_sqrt(2.0 / 3 * above), lane_sqrt(lane_sqrt(4.0 * above)) + 1.5875);
  for (int k = 0; k < 6; ++k) {
    const Real x3 = x * x * x;
    x = lane_max(x - (0.25 * x3 * x - x - (above - 0.75)) / lane_max(x3 - 1.0, zero + 1e-12), one);
  }
  const Real x3 = x * x * x, force = M_PI * n.adhesion * c.reduced_radius * x3;
  const Real holds = select(c.overlap > zero, one, select(scaled > -0.75 + zero, attached, zero));
  return {holds * root * root * x * x, holds * force * x3 / 6.0, holds * force, holds};
}

/// Hertz and a liquid bridge between spheres of equal effective radius R = 2 R*, which forms when they touch
/// and ruptures at S = (1 + theta/2) (V^(1/3) + 0.1 V^(2/3)/R):
///   F = 2 pi R gamma cos(theta)/(1 + 1.05 s + 2.5 s^2),  s = S sqrt(R/V),  S the gap (0 while touching)
/// (Willett, Adams, Johnson & Seville 2000, Langmuir 16, 9396-9405, doi:10.1021/la000657y, Eqs. 12 and 15;
/// there S is half the gap). The liquid of a bridge is constant.
template <class Real>
SEEDFLOW_INLINE NormalForce<Real> capillary_force(const CohesionNumbers& n, double young,
                                                  const ContactKinematics<Real>& c, Real attached) {
  const Real zero{}, one = zero + 1.0;
  const Real radius = 2.0 * c.reduced_radius, gap = lane_max(-c.overlap, zero);
  const Real s = gap * n.inverse_root * lane_sqrt(radius);
  NormalForce<Real> f = hertz_force(young, c);
  f.attached =
      select(c.overlap > zero, one, select(gap < n.rupture + n.rupture_curvature / radius, attached, zero));
  f.attraction = f.attached * n.tension * radius / (1.0 + s * (1.05 + 2.5 * s));
  return f;
}

/// Gap at which a JKR contact breaks, 3/4 sqrt(2 pi w/E*) (R* sqrt(2 pi w/E*)/4)^(1/3) [m].
double jkr_neck(const CohesionNumbers& numbers, double reduced_radius);
/// Gap at which a liquid bridge ruptures [m].
double bridge_rupture(const CohesionNumbers& numbers, double reduced_radius);

}  // namespace seedflow
