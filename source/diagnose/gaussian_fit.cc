#include "seedflow/diagnose/gaussian_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace seedflow {

namespace {

double matern(double distance_over_length) {
  const double x = std::sqrt(3.0) * distance_over_length;
  return (1 + x) * std::exp(-x);
}

constexpr double tolerance_length = 0.5;  // of a series: published forms differ by slow functions

}  // namespace

const std::vector<NoiseVariant>& noise_variants() {
  static const std::vector<NoiseVariant> all = [] {
    std::vector<NoiseVariant> list = {{1, 0, 0}};
    for (const double scale : {1.4, 2.0, 2.8, 4.0}) list.push_back({scale, 0, 0});
    for (const double size : {0.6, 1.2, 2.5, 6.0, 15.0, 40.0})
      for (const double length : {0.1, 0.4}) list.push_back({1, size, length});
    list.push_back({0.5, 0.9, 0.1});  // the stated scatter, mostly correlated
    list.push_back({1.4, 1.4, 0.1});
    return list;
  }();
  return all;
}

DataNoise::DataNoise(const std::vector<DataPoint>& p) : points(p), scale(p.size(), 1.0) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto s = static_cast<std::size_t>(points[i].series);
    if (members.size() <= s) members.resize(s + 1);
    members[s].push_back(static_cast<Eigen::Index>(i));
  }
  for (auto& series : members) {
    std::stable_sort(series.begin(), series.end(), [&](Eigen::Index a, Eigen::Index b) {
      return points[a].coordinate < points[b].coordinate;
    });
    std::vector<double> sigma;
    for (const Eigen::Index i : series) sigma.push_back(points[i].sigma);
    std::nth_element(sigma.begin(), sigma.begin() + sigma.size() / 2, sigma.end());
    typical.push_back(sigma[sigma.size() / 2]);
  }
}

Eigen::MatrixXd DataNoise::block(std::size_t s, const NoiseVariant& variant,
                                 const Eigen::MatrixXd& tolerance) const {
  const std::vector<Eigen::Index>& at = members[s];
  const auto n = static_cast<Eigen::Index>(at.size());
  Eigen::MatrixXd b(n, n);
  // Smooth covariances depend on the distance in rank alone.
  std::vector<double> smooth(n), slow(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double distance = static_cast<double>(k) / static_cast<double>(n);
    smooth[k] = variant.discrepancy > 0
                    ? std::pow(variant.discrepancy * typical[s], 2) * matern(distance / variant.length)
                    : 0.0;
    slow[k] = matern(distance / tolerance_length);
  }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      const DataPoint &p = points[at[i]], &q = points[at[j]];
      double value = smooth[i - j];
      if (p.correlated_sigma > 0) {
        const double distance = std::abs(p.coordinate - q.coordinate);
        value += p.correlated_sigma * q.correlated_sigma *
                 (distance > 0 ? std::exp(-distance / p.correlation_length) : 1.0);
      }
      for (Eigen::Index t = 0; t < tolerance.cols(); ++t)
        value += tolerance(at[i], t) * tolerance(at[j], t) * slow[i - j];
      if (i == j) value += std::pow(variant.white_scale * p.sigma * scale[at[i]], 2);
      b(i, j) = b(j, i) = value;
    }
  return b;
}

LinearFit fit(const DataNoise& noise, const NoiseVariant& variant, const LinearModel& model,
              const std::vector<bool>& use, const LinearFit* prior) {
  const Eigen::Index q = model.directions.cols();
  Eigen::VectorXd start = Eigen::VectorXd::Zero(q);
  Eigen::MatrixXd root = Eigen::MatrixXd::Identity(q, q);
  if (prior) {
    start = prior->mean;
    root = prior->covariance.llt().matrixL();
  }
  Eigen::MatrixXd precision = Eigen::MatrixXd::Identity(q, q);
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(q);
  struct Part {
    Eigen::LLT<Eigen::MatrixXd> factor;
    Eigen::MatrixXd white;  // whitened directions and, last, residual
  };
  std::vector<Part> parts(noise.series().size());
  LinearFit result;
  double log_determinant = 0, square = 0;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    if (!use[s]) continue;
    const std::vector<Eigen::Index>& at = noise.series()[s];
    const auto n = static_cast<Eigen::Index>(at.size());
    Part& part = parts[s];
    part.factor.compute(noise.block(s, variant, model.tolerance));
    Eigen::MatrixXd rows(n, q);
    part.white.resize(n, q + 1);
    for (Eigen::Index i = 0; i < n; ++i) {
      rows.row(i) = model.directions.row(at[i]);
      part.white(i, q) = model.residual[at[i]] - (prior ? rows.row(i).dot(start) : 0.0);
    }
    if (prior)
      part.white.leftCols(q).noalias() = rows * root;
    else
      part.white.leftCols(q) = rows;
    part.factor.matrixL().solveInPlace(part.white);
    log_determinant += 2 * part.factor.matrixLLT().diagonal().array().log().sum();
    precision.noalias() += part.white.leftCols(q).transpose() * part.white.leftCols(q);
    slope.noalias() += part.white.leftCols(q).transpose() * part.white.col(q);
    square += part.white.col(q).squaredNorm();
    result.points += static_cast<int>(n);
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(precision);
  const Eigen::VectorXd x = factor.solve(slope);
  log_determinant += 2 * factor.matrixLLT().diagonal().array().log().sum();
  result.chi2 = square - slope.dot(x);
  result.log_evidence = -0.5 * (result.chi2 + log_determinant + result.points * std::log(2 * M_PI));
  result.mean = start + root * x;
  result.covariance = root * factor.solve(Eigen::MatrixXd(root.transpose()));
  result.gradient = result.innovations = Eigen::VectorXd::Zero(model.residual.size());
  for (std::size_t s = 0; s < parts.size(); ++s) {
    if (!use[s]) continue;
    Eigen::VectorXd left = parts[s].white.col(q) - parts[s].white.leftCols(q) * x;
    for (std::size_t i = 0; i < noise.series()[s].size(); ++i)
      result.innovations[noise.series()[s][i]] = left[static_cast<Eigen::Index>(i)];
    parts[s].factor.matrixL().transpose().solveInPlace(left);
    for (std::size_t i = 0; i < noise.series()[s].size(); ++i)
      result.gradient[noise.series()[s][i]] = left[static_cast<Eigen::Index>(i)];
  }
  return result;
}

double chi2_tail(double x, int n) {
  if (n <= 0) return 1;
  const double v = 2.0 / (9.0 * n);
  return 0.5 * std::erfc((std::cbrt(x / n) - (1 - v)) / std::sqrt(2 * v));
}

double runs_test(const DataNoise& noise, const Eigen::VectorXd& residual, const std::vector<bool>& use) {
  double runs = 0, expected = 0, variance = 0;
  for (std::size_t s = 0; s < noise.series().size(); ++s) {
    if (!use[s]) continue;
    double above = 0, below = 0, here = 0;
    int last = 0;
    for (const Eigen::Index i : noise.series()[s]) {
      const int sign = residual[i] > 0 ? 1 : -1;
      (sign > 0 ? above : below) += 1;
      if (sign != last) ++here, last = sign;
    }
    const double n = above + below;
    if (n < 2) continue;
    // With an expectation of zero for the residual both signs have probability 1/2.
    runs += here;
    expected += 1 + (n - 1) / 2;
    variance += (n - 1) / 4;
  }
  return variance > 0 ? std::erfc(std::abs(runs - expected) / std::sqrt(2 * variance)) : 1;
}

}  // namespace seedflow
