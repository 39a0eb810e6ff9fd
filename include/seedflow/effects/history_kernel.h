#pragma once

#include "seedflow/base/vector.h"
#include "seedflow/effects/thinned_history.h"

namespace seedflow {

/// Kernel of the history force, F = C integral K(t - tau) dw/dtau dtau, w = u - v the slip, C = 3/2 d^2
/// sqrt(pi rho mu):
///
///   K(s) = s^-1/2 (1 + kappa s^(3/(2 c)))^-c        [s^-1/2]
///
/// kappa = 0 is Basset's kernel; with kappa > 0 it falls like s^-2 once the vorticity is swept away, the form
/// of Mei & Adrian (1992) in which c = 2; see history_kernel().
struct HistoryKernel {
  double exponent = 2;  ///< c
  double kappa = 0;     ///< [s^(-3/(2 c))]

  double value(double age) const;
  /// Integral of K from age a to age b >= a [s^1/2].
  double integral(double a, double b) const;
  /// Mean over the coming step, s in [0, step], of the integral of K from a + s to b + s [s^1/2].
  double step_mean(double a, double b, double step) const;
  /// The same for the part of the step itself: mean over s of the integral of K from 0 to s [s^1/2].
  double newest(double step) const;
};

/// K of Mei & Adrian with f_H = 0.75 + c2 Re, Re = d |w|/nu and R = d/2:
///   K = sqrt(pi nu/R^2) ((pi nu s/R^2)^(1/(2c)) + (pi/2 |w|^3 s^2/(R nu f_H^3))^(1/c))^-c
HistoryKernel finite_reynolds_kernel(double diameter, double kinematic_viscosity, double slip_speed,
                                     double exponent, double c2);

/// Mean over the coming step of integral K dw, for a slip recorded as a piecewise linear function (3 values a
/// sample) up to the present, without the change of slip within the step itself. If `impulsive`, the first
/// slip on record counts as a jump from zero.
Vec3 history_integral(const HistoryKernel& kernel, const ThinnedHistory& slip, double step, bool impulsive);

}  // namespace seedflow
