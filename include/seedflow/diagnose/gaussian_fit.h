#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "seedflow/diagnose/observable_model.h"

namespace seedflow {

/// What the scatter of the data is taken to be, beside what the user states: white noise scaled, and a smooth
/// discrepancy of every series (a Gaussian process of Matern type, nu = 3/2; Kennedy & O'Hagan 2001,
/// doi:10.1111/1467-9868.00294).
struct NoiseVariant {
  double white_scale = 1;  ///< on the stated uncorrelated uncertainty
  double discrepancy = 0;  ///< standard deviation, in units of the series' median uncertainty
  double length = 0;       ///< correlation length, as a share of the points of a series
  bool as_stated() const { return white_scale == 1 && discrepancy == 0; }
};

/// Noise of one kind, growing.
using NoiseChains = std::vector<std::vector<NoiseVariant>>;

/// The noise as stated.
inline constexpr NoiseVariant stated_noise;
/// As stated, scaled, with discrepancies: as stated first.
const NoiseChains& noise_chains();

/// Covariance of the measured values without inputs and effects: block-diagonal by series.
class DataNoise {
 public:
  explicit DataNoise(const std::vector<DataPoint>& points);

  /// Points of a series, ordered by coordinate.
  const std::vector<std::vector<Eigen::Index>>& series() const { return members; }
  /// Multiplies the uncertainty of one point: an outlier.
  void inflate(Eigen::Index point, double factor) { scale[point] *= factor; }
  double inflation(Eigen::Index point) const { return scale[point]; }
  double sigma(Eigen::Index point) const { return points[point].sigma * scale[point]; }

  /// Covariance block of one series. `tolerance`: columns t with added covariance t t^T, smooth along the
  /// series.
  Eigen::MatrixXd block(std::size_t series, const NoiseVariant& variant,
                        const Eigen::MatrixXd& tolerance) const;

 private:
  const std::vector<DataPoint>& points;
  std::vector<std::vector<Eigen::Index>> members;
  std::vector<double> scale, typical;
};

/// residual = directions x + noise, x ~ N(0, 1): columns of `directions` are scaled by prior standard
/// deviations.
struct LinearModel {
  Eigen::VectorXd residual;
  Eigen::MatrixXd directions, tolerance;
};

/// Posterior of x, and how well the model stands.
struct LinearFit {
  double log_evidence = 0;  ///< log of the density of the residual
  double chi2 = 0;          ///< residual^T K^-1 residual, K with everything marginalised
  int points = 0;
  Eigen::VectorXd mean;         ///< of x
  Eigen::MatrixXd covariance;   ///< of x
  Eigen::VectorXd gradient;     ///< K^-1 residual, zero at points left out
  Eigen::VectorXd innovations;  ///< what every value adds to the ones before it in its series, N(0, 1)
};

/// A linear model divided by its noise: what all questions to it share. A series sees few of the directions
/// (the inputs of its condition), and only those are worked with.
class WhitenedModel {
 public:
  /// Uses the points of the series for which `use` holds. With `prior`, x has that posterior of an earlier
  /// fit instead of N(0, 1): the log density then is the predictive one.
  WhitenedModel(const DataNoise& noise, const NoiseVariant& variant, const LinearModel& model,
                const std::vector<bool>& use, const LinearFit* prior = nullptr);

  /// Evidence, chi-square and the mean alone.
  LinearFit brief() const;
  LinearFit full() const;
  /// As if `direction` were one more column of the model's directions.
  struct WithDirection {
    double log_evidence = 0, mean = 0;
  };
  WithDirection with(const Eigen::VectorXd& direction) const;

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Part {
    std::size_t series;
    std::vector<Eigen::Index> column;  ///< directions that the series sees
    Eigen::MatrixXd factor;            ///< Cholesky, lower
    Rows white;                        ///< whitened directions and, last, residual
  };
  const DataNoise& noise;
  std::vector<Part> parts;
  Eigen::LLT<Eigen::MatrixXd> precision;
  Eigen::VectorXd x, start;
  Eigen::MatrixXd root;  ///< of the prior's covariance; empty: unity
  double chi2 = 0, log_determinant = 0;
  int points = 0;
  Eigen::Index all_points = 0;
};

/// Fits once, in full.
LinearFit fit(const DataNoise& noise, const NoiseVariant& variant, const LinearModel& model,
              const std::vector<bool>& use, const LinearFit* prior = nullptr);

/// Probability that chi-square with n degrees of freedom exceeds x (Wilson & Hilferty 1931,
/// doi:10.1073/pnas.17.12.684).
double chi2_tail(double x, int n);
/// Two-sided probability of fewer or more sign runs than by chance along the series (Wald & Wolfowitz 1940,
/// doi:10.1214/aoms/1177731909).
double runs_test(const DataNoise& noise, const Eigen::VectorXd& residual, const std::vector<bool>& use);

}  // namespace seedflow
