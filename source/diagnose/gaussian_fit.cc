#include "seedflow/diagnose/gaussian_fit.h"

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

const NoiseChains& noise_chains() {
  static const NoiseChains all = [] {
    NoiseChains chains = {{stated_noise}, {}};
    for (const double scale : {1.4, 2.0, 2.8, 4.0}) chains.back().push_back({scale, 0, 0});
    for (const double length : {0.1, 0.4}) {
      chains.push_back({});
      for (const double size : {0.6, 1.2, 2.5, 6.0, 15.0, 40.0}) chains.back().push_back({1, size, length});
    }
    chains.push_back({{0.5, 0.9, 0.1}, {1.4, 1.4, 0.1}});  // the stated scatter mostly correlated; more
    return chains;
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
  Eigen::MatrixXd b(n, n), slopes(tolerance.cols(), n);
  // Smooth covariances depend on the distance in rank alone.
  std::vector<double> smooth(n, 0.0), slow(n);
  bool correlated = false;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double distance = static_cast<double>(k) / static_cast<double>(n);
    if (variant.discrepancy > 0)
      smooth[k] = std::pow(variant.discrepancy * typical[s], 2) * matern(distance / variant.length);
    slow[k] = matern(distance / tolerance_length);
    for (Eigen::Index t = 0; t < tolerance.cols(); ++t) slopes(t, k) = tolerance(at[k], t);
    correlated = correlated || points[at[k]].correlated_sigma > 0;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      double shared = 0;
      for (Eigen::Index t = 0; t < tolerance.cols(); ++t) shared += slopes(t, i) * slopes(t, j);
      b(i, j) = b(j, i) = smooth[i - j] + slow[i - j] * shared;
    }
    b(i, i) += std::pow(variant.white_scale * points[at[i]].sigma * scale[at[i]], 2);
  }
  if (!correlated) return b;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const DataPoint &p = points[at[i]], &q = points[at[j]];
      if (!(p.correlated_sigma > 0)) continue;
      const double distance = std::abs(p.coordinate - q.coordinate);
      b(i, j) += p.correlated_sigma * q.correlated_sigma *
                 (distance > 0 ? std::exp(-distance / p.correlation_length) : 1.0);
    }
  return b;
}

namespace {

/// rows <- L^-1 rows. Rows are short: loops without a library's set-up.
template <class Rows>
void solve_forward(const Eigen::MatrixXd& lower, Rows& rows) {
  const Eigen::Index m = rows.cols();
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    double* const here = &rows(i, 0);
    for (Eigen::Index k = 0; k < i; ++k) {
      const double l = lower(i, k);
      const double* const before = &rows(k, 0);
      for (Eigen::Index c = 0; c < m; ++c) here[c] -= l * before[c];
    }
    const double scale = 1 / lower(i, i);
    for (Eigen::Index c = 0; c < m; ++c) here[c] *= scale;
  }
}

}  // namespace

WhitenedModel::WhitenedModel(const DataNoise& the_noise, const NoiseVariant& variant,
                             const LinearModel& model, const std::vector<bool>& use, const LinearFit* prior)
    : noise(the_noise), all_points(model.residual.size()) {
  const Eigen::Index q = model.directions.cols();
  Eigen::MatrixXd transformed;
  if (prior) {
    start = prior->mean;
    root = prior->covariance.llt().matrixL();
    transformed = model.directions * root;
  }
  const Eigen::MatrixXd& directions = prior ? transformed : model.directions;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(q, q);
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(q);
  double square = 0;
  for (std::size_t s = 0; s < noise.series().size(); ++s) {
    if (!use[s]) continue;
    const std::vector<Eigen::Index>& at = noise.series()[s];
    const auto n = static_cast<Eigen::Index>(at.size());
    parts.push_back({s, {}, noise.block(s, variant, model.tolerance), {}});
    Part& part = parts.back();
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> in_place(part.factor);
    for (Eigen::Index c = 0; c < q; ++c)
      if (std::any_of(at.begin(), at.end(), [&](Eigen::Index i) { return directions(i, c) != 0; }))
        part.column.push_back(c);
    const auto m = static_cast<Eigen::Index>(part.column.size());
    part.white.resize(n, m + 1);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index c = 0; c < m; ++c) part.white(i, c) = directions(at[i], part.column[c]);
      part.white(i, m) = model.residual[at[i]] - (prior ? model.directions.row(at[i]).dot(start) : 0.0);
    }
    solve_forward(part.factor, part.white);
    for (Eigen::Index i = 0; i < n; ++i) log_determinant += 2 * std::log(part.factor(i, i));
    Eigen::MatrixXd products(m + 1, m + 1);
    products.noalias() = part.white.transpose() * part.white;
    for (Eigen::Index a = 0; a < m; ++a) {
      for (Eigen::Index b = 0; b < m; ++b) sum(part.column[a], part.column[b]) += products(a, b);
      slope[part.column[a]] += products(a, m);
    }
    square += products(m, m);
    points += static_cast<int>(n);
  }
  precision.compute(sum);
  x = precision.solve(slope);
  log_determinant += 2 * precision.matrixLLT().diagonal().array().log().sum();
  chi2 = square - slope.dot(x);
}

LinearFit WhitenedModel::brief() const {
  LinearFit result;
  result.points = points;
  result.chi2 = chi2;
  result.log_evidence = -0.5 * (chi2 + log_determinant + points * std::log(2 * M_PI));
  result.mean = root.size() > 0 ? Eigen::VectorXd(start + root * x) : x;
  return result;
}

LinearFit WhitenedModel::full() const {
  LinearFit result = brief();
  const Eigen::Index q = x.size();
  result.covariance =
      precision.solve(root.size() > 0 ? Eigen::MatrixXd(root.transpose()) : Eigen::MatrixXd::Identity(q, q));
  if (root.size() > 0) result.covariance = root * result.covariance;
  result.gradient = result.innovations = Eigen::VectorXd::Zero(all_points);
  for (const Part& part : parts) {
    const auto m = static_cast<Eigen::Index>(part.column.size());
    Eigen::VectorXd left = part.white.col(m);
    for (Eigen::Index c = 0; c < m; ++c) left -= x[part.column[c]] * part.white.col(c);
    const std::vector<Eigen::Index>& at = noise.series()[part.series];
    for (std::size_t i = 0; i < at.size(); ++i)
      result.innovations[at[i]] = left[static_cast<Eigen::Index>(i)];
    part.factor.triangularView<Eigen::Lower>().transpose().solveInPlace(left);
    for (std::size_t i = 0; i < at.size(); ++i) result.gradient[at[i]] = left[static_cast<Eigen::Index>(i)];
  }
  return result;
}

WhitenedModel::WithDirection WhitenedModel::with(const Eigen::VectorXd& direction) const {
  Eigen::VectorXd coupling = Eigen::VectorXd::Zero(x.size());
  double square = 0, slope = 0;
  for (const Part& part : parts) {
    const std::vector<Eigen::Index>& at = noise.series()[part.series];
    Rows d(static_cast<Eigen::Index>(at.size()), 1);
    for (std::size_t i = 0; i < at.size(); ++i) d(static_cast<Eigen::Index>(i), 0) = direction[at[i]];
    solve_forward(part.factor, d);
    const auto m = static_cast<Eigen::Index>(part.column.size());
    const Eigen::VectorXd products = part.white.transpose() * d.col(0);
    for (Eigen::Index c = 0; c < m; ++c) coupling[part.column[c]] += products[c];
    slope += products[m];
    square += d.squaredNorm();
  }
  // Rank-one change of the covariance: K + d d^T.
  const double dkd = square - coupling.dot(precision.solve(coupling)), dkr = slope - coupling.dot(x);
  const double mean = dkr / (1 + dkd);
  return {-0.5 * (chi2 - dkr * mean + log_determinant + std::log1p(dkd) + points * std::log(2 * M_PI)), mean};
}

LinearFit fit(const DataNoise& noise, const NoiseVariant& variant, const LinearModel& model,
              const std::vector<bool>& use, const LinearFit* prior) {
  return WhitenedModel(noise, variant, model, use, prior).full();
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
