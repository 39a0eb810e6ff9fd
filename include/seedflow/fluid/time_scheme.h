#pragma once

namespace seedflow {

/// BDF2 with variable step: d(f)/dt = (now f^{n+1} + old f^n + older f^{n-1}) / dt, and the extrapolation
/// f^{n+1} = extrapolate_old f^n + extrapolate_older f^{n-1}, both of second order.
/// r = dt / dt_old; r = 0 gives backward Euler with f^{n+1} = f^n extrapolated.
/// Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, III.5.
struct TimeScheme {
  double dt = 0;  ///< [s]
  double now = 1, old = -1, older = 0;
  double extrapolate_old = 1, extrapolate_older = 0;

  static TimeScheme bdf1(double dt) { return {dt}; }
  static TimeScheme bdf2(double dt, double dt_old) {
    const double r = dt / dt_old;
    return {dt, (1 + 2 * r) / (1 + r), -(1 + r), r * r / (1 + r), 1 + r, -r};
  }
};

}  // namespace seedflow
