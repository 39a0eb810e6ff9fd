#pragma once

#include <vector>

#include "seedflow/diagnose/gaussian_fit.h"
#include "seedflow/diagnose/responses.h"

namespace seedflow {

/// What may explain the data: a set of candidates (empty: nothing is missing), or one input that is off, in
/// all conditions alike, with a prior eight times as wide as stated.
struct Hypothesis {
  std::vector<int> set;
  int nuisance = -1;
};

/// A hypothesis beside the data.
struct Weighed {
  Hypothesis what;
  bool possible = true;             ///< its runs succeeded
  double score = -1e300;            ///< log evidence less the prices of multiplicity and of unstated noise
  double score_as_stated = -1e300;  ///< with the noise as stated
  double chi2_as_stated = 0;        ///< per point, with the noise as stated
  NoiseVariant noise;               ///< the best
  std::vector<double> amplitude, deviation;  ///< of the candidates, with standard deviations
  LinearModel linear;                        ///< about the fitted amplitudes
  LinearFit fit;                             ///< under the best noise
};

/// Scores hypotheses against measured values (fixed published coefficients, amplitude prior N(1, 0.25)).
class Weighing {
 public:
  static constexpr double amplitude_deviation = 0.25;
  static constexpr double odds = 0.01;            ///< prior probability that an effect is missing
  static constexpr double price_of_noise = 4;     ///< for noise other than stated, nats
  static constexpr double form_tolerance = 0.07;  ///< published forms of one effect differ by about this
  static constexpr double widening = 8;           ///< of the prior of an input that may be off

  /// `acting`: candidates that change anything.
  Weighing(ObservableModel& model, Responses& responses, const DataNoise& noise, int acting);

  /// `joint`: the runs of the whole set are made; otherwise changes are added up. `chains`: kinds of noise
  /// that are tried, the stated one first.
  Weighed weigh(const Hypothesis& what, const std::vector<bool>& use, bool joint, const NoiseChains& chains);
  /// The linear model of a hypothesis about given amplitudes.
  LinearModel linearise(const Hypothesis& what, const std::vector<double>& amplitude, bool joint);
  /// Nothing missing, but inputs as they act in the model with these entries.
  LinearModel linearise_about(const Setting& setting);
  double price(const Hypothesis& what) const;
  /// Makes the runs of several sets together.
  void prepare(const std::vector<std::vector<int>>& sets) { responses.prepare(sets); }
  /// Nuisances that make sense as inputs that are off altogether.
  std::vector<int> inputs_that_may_be_off() const;
  /// First column of the amplitudes among the directions.
  Eigen::Index first_amplitude();

 private:
  LinearModel linearise(const Hypothesis& what, const std::vector<double>& amplitude,
                        const Responses::Value& now, const Eigen::MatrixXd& inputs);
  ObservableModel& model;
  Responses& responses;
  const DataNoise& noise;
  Eigen::VectorXd measured;
  int acting;
};

}  // namespace seedflow
