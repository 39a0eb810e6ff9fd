#include "seedflow/experiment/curve_fit.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

/// The residuals as Eigen wants them.
struct Residuals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const Curve& curve;
  const std::vector<double>&x, &y;
  int n_parameters;

  int inputs() const { return n_parameters; }
  int values() const { return static_cast<int>(x.size()); }
  int operator()(const Eigen::VectorXd& p, Eigen::VectorXd& residual) const {
    const std::vector<double> parameters(p.data(), p.data() + p.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      residual[static_cast<Eigen::Index>(i)] = curve(x[i], parameters) - y[i];
    return 0;
  }
};

}  // namespace

CurveFit fit_curve(const Curve& curve, std::vector<double> start, const std::vector<double>& x,
                   const std::vector<double>& y) {
  if (x.size() != y.size() || x.size() < start.size())
    throw RunError("A curve with " + std::to_string(start.size()) + " parameters cannot be fitted to " +
                   std::to_string(x.size()) + " points.");
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
      throw RunError("A curve cannot be fitted: point " + std::to_string(i) + " is not finite.");

  using Function = Eigen::NumericalDiff<Residuals>;
  Function function(Residuals{curve, x, y, static_cast<int>(start.size())});
  Eigen::LevenbergMarquardt<Function> solver(function);
  Eigen::VectorXd p = Eigen::Map<Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
  const auto status = solver.minimize(p);
  if (status <= 0 || status == Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation)
    throw RunError("The fit of a curve to " + std::to_string(x.size()) +
                   " points did not converge (Levenberg-Marquardt status " +
                   std::to_string(static_cast<int>(status)) + ").");

  CurveFit fit;
  fit.parameters.assign(p.data(), p.data() + p.size());
  fit.evaluations = static_cast<int>(solver.nfev);
  Eigen::VectorXd residual(x.size());
  function(p, residual);
  fit.rms = residual.norm() / std::sqrt(static_cast<double>(x.size()));
  fit.standard_error.assign(start.size(), std::numeric_limits<double>::quiet_NaN());
  if (x.size() > start.size()) {
    Eigen::MatrixXd jacobian(x.size(), p.size());
    function.df(p, jacobian);
    const Eigen::MatrixXd covariance = (jacobian.transpose() * jacobian).inverse() * residual.squaredNorm() /
                                       static_cast<double>(x.size() - start.size());
    for (Eigen::Index i = 0; i < p.size(); ++i) fit.standard_error[i] = std::sqrt(covariance(i, i));
  }
  return fit;
}

CurveFit fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  return fit_curve([](double at, const std::vector<double>& p) { return p[0] + p[1] * at; }, {0, 0}, x, y);
}

CurveFit fit_cubic(const std::vector<double>& x, const std::vector<double>& y) {
  return fit_curve(
      [](double at, const std::vector<double>& p) { return p[0] + at * (p[1] + at * (p[2] + at * p[3])); },
      {0, 0, 0, 0}, x, y);
}

}  // namespace seedflow
