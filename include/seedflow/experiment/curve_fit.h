#pragma once

#include <functional>
#include <vector>

namespace seedflow {

/// A curve y = f(x; p) fitted to points by non-linear least squares.
struct CurveFit {
  std::vector<double> parameters;
  std::vector<double> standard_error;  ///< of each parameter, from the residuals; NaN if not determined
  double rms = 0;                      ///< of the residuals, in the unit of y
  int evaluations = 0;                 ///< of the whole curve
};

/// y at x for given parameters.
using Curve = std::function<double(double x, const std::vector<double>& parameters)>;

/// Levenberg-Marquardt (Eigen's port of MINPACK's lmder with forward differences; More 1978,
/// doi:10.1007/BFb0067700) from the given start. Errors: RunError if there are fewer points than parameters,
/// a number is not finite, or the iteration does not converge.
CurveFit fit_curve(const Curve& curve, std::vector<double> start, const std::vector<double>& x,
                   const std::vector<double>& y);

/// y = p0 + p1 x.
CurveFit fit_line(const std::vector<double>& x, const std::vector<double>& y);

/// y = p0 + p1 x + p2 x^2 + p3 x^3, the simplest curve with the S shape of a bed's surface. x should be of
/// order one.
CurveFit fit_cubic(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace seedflow
