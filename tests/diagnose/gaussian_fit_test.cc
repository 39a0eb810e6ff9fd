// The evidence against the density of the full covariance, written out; the tails against tables.
#include "seedflow/diagnose/gaussian_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace seedflow {
namespace {

std::vector<DataPoint> two_series(int n) {
  std::vector<DataPoint> points;
  for (int s = 0; s < 2; ++s)
    for (int i = 0; i < n; ++i) {
      DataPoint p;
      p.condition = p.series = s;
      p.coordinate = i;
      p.sigma = 0.5 + 0.1 * i;
      p.correlated_sigma = 0.3;
      p.correlation_length = 2;
      points.push_back(p);
    }
  return points;
}

LinearModel some_model(int n, int q) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  LinearModel m;
  m.residual = Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
  m.directions = Eigen::MatrixXd::NullaryExpr(n, q, [&] { return normal(random); });
  m.tolerance = 0.2 * Eigen::MatrixXd::NullaryExpr(n, 1, [&] { return normal(random); });
  return m;
}

Eigen::MatrixXd full_covariance(const DataNoise& noise, const NoiseVariant& variant, const LinearModel& m) {
  Eigen::MatrixXd k = m.directions * m.directions.transpose();
  for (std::size_t s = 0; s < noise.series().size(); ++s) {
    const Eigen::MatrixXd b = noise.block(s, variant, m.tolerance);
    const auto& at = noise.series()[s];
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t j = 0; j < at.size(); ++j) k(at[i], at[j]) += b(i, j);
  }
  return k;
}

double log_density(const Eigen::VectorXd& x, const Eigen::MatrixXd& k) {
  const Eigen::MatrixXd two_pi_k = 2 * M_PI * k;
  return -0.5 * (x.dot(k.ldlt().solve(x)) + std::log(two_pi_k.determinant()));
}

TEST(GaussianFit, EvidenceIsTheDensityOfTheFullCovariance) {
  const int n = 6;
  const auto points = two_series(n);
  const DataNoise noise(points);
  const LinearModel m = some_model(2 * n, 3);
  for (const NoiseVariant variant : {NoiseVariant{}, NoiseVariant{2, 0, 0}, NoiseVariant{1, 3, 0.4}}) {
    const Eigen::MatrixXd k = full_covariance(noise, variant, m);
    const LinearFit f = fit(noise, variant, m, {true, true});
    EXPECT_NEAR(f.log_evidence, log_density(m.residual, k), 1e-10);
    EXPECT_NEAR(f.chi2, m.residual.dot(k.ldlt().solve(m.residual)), 1e-10);
    EXPECT_LT((f.gradient - k.ldlt().solve(m.residual)).norm(), 1e-10);
    // Posterior of x: D^T K^-1 r, and the innovations carry the same chi-square.
    EXPECT_LT((f.mean - m.directions.transpose() * k.ldlt().solve(m.residual)).norm(), 1e-10);
  }
}

TEST(GaussianFit, ProbabilitiesOfPartsMultiply) {
  const int n = 5;
  const auto points = two_series(n);
  const DataNoise noise(points);
  const LinearModel m = some_model(2 * n, 2);
  const NoiseVariant stated;
  const LinearFit first = fit(noise, stated, m, {true, false});
  const LinearFit second = fit(noise, stated, m, {false, true}, &first);
  const LinearFit both = fit(noise, stated, m, {true, true});
  EXPECT_NEAR(first.log_evidence + second.log_evidence, both.log_evidence, 1e-10);
  EXPECT_LT((second.mean - both.mean).norm(), 1e-10);
  EXPECT_LT((second.covariance - both.covariance).norm(), 1e-10);
}

TEST(GaussianFit, TailsAgreeWithTables) {
  // 5 % and 1 % points of chi-square (Abramowitz & Stegun, table 26.8); Wilson-Hilferty is good to 2e-3 here.
  EXPECT_NEAR(chi2_tail(18.307, 10), 0.05, 1e-3);
  EXPECT_NEAR(chi2_tail(23.209, 10), 0.01, 1e-3);
  EXPECT_NEAR(chi2_tail(124.342, 100), 0.05, 1e-3);
  EXPECT_NEAR(chi2_tail(100, 100), 0.481, 2e-3);
}

TEST(GaussianFit, RunsTestSeesWavesAndPassesNoise) {
  const int n = 40;
  const auto points = two_series(n);
  const DataNoise noise(points);
  Eigen::VectorXd wave(2 * n), white(2 * n);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2 * n; ++i) wave[i] = std::sin(0.3 * i), white[i] = normal(random);
  EXPECT_LT(runs_test(noise, wave, {true, true}), 1e-6);
  EXPECT_GT(runs_test(noise, white, {true, true}), 0.01);
}

}  // namespace
}  // namespace seedflow
