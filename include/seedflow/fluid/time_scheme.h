#pragma once

namespace seedflow {

/// BDF2 with variable step: d(f)/dt = (now f^{n+1} + old f^n + older f^{n-1}) / dt, and the extrapolation
/// f^{n+1} = extrapolate_old f^n + extrapolate_older f^{n-1}, both of second order.
/// r = dt / dt_old; r = 0 gives backward Euler with f^{n+1} = f^n extrapolated.
/// Where a pressure difference drives a quasi-steady flow through a contraction, u^{n+1} u* = c^2 with the
/// extrapolated u* amplifies a deviation by 1 + sqrt(2) in every step; with u* = (u^n + u^{n-1})/2, of first
/// order, it shrinks by 1/sqrt(2) (the roots of lambda^2 + 2 lambda - 1 and lambda^2 + lambda/2 + 1/2).
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
  /// The same with the mean of the last two values as f^{n+1}.
  TimeScheme averaged() const { return {dt, now, old, older, 0.5, 0.5}; }
};

}  // namespace seedflow
