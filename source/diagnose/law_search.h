#pragma once

#include <string>
#include <vector>

#include "seedflow/diagnose/selection.h"

namespace seedflow {

/// A law of the library: direction, coefficient at the reference values of the groups, exponents.
struct Law {
  static constexpr int n_groups = 6, n_directions = 10;
  static const char* const directions[n_directions];
  static const char* const groups[n_groups];

  int direction = 0;
  double coefficient = 0;
  double exponent[n_groups] = {};
  bool has[n_groups] = {};
  /// In which unit the coefficient is: "drag", "weight", "Stokes drag".
  std::string reference() const;
  /// "force along the slip"
  std::string force_in_words() const;
  /// Against nothing missing: the odds that an effect is missing, and that of all laws it is this one [nats].
  double price() const;
  /// Of its numbers, up to a constant.
  double log_prior() const;
};

/// Searches laws outside the catalogue by their simulated effect. Internal to the diagnosis.
class LawSearch {
 public:
  LawSearch(ObservableModel& model, Responses& responses, Weighing& weighing, const DataNoise& noise,
            const Split& split);

  /// Whether the model has the effect "Inferred law".
  static bool possible(const ObservableModel& model);

  struct Screened {
    Law law;
    double score = -1e300;  ///< log evidence of all conditions less the price of the search
    void take(double log_evidence, const NoiseVariant& variant, double coefficient);
  };
  /// Every direction, alone and with every group to a few powers, as far as it acts: linear response, under
  /// the stated noise and under `other`. Best first.
  std::vector<Screened> screened_laws(const NoiseVariant& other);

  /// Gauss-Newton over coefficient and exponents with real runs, which must confirm every step.
  struct Refined {
    Law law;
    double log_evidence = -1e300;
    double chi2 = 0;  ///< of the simulated law, inputs marginalised
    int points = 0;
    std::vector<double> deviation;  ///< coefficient, then exponents of the groups it has
  };
  Refined refine(const Law& start);
  /// From now on inputs act as they do beside this law, not as in the base model, where a drift that the law
  /// makes does not exist.
  void refine_about(const Law& law);
  /// chi-square without any law, as Refined::chi2.
  double chi2_of_nothing() const;

  Setting setting(const Law& law) const;
  double reference(int group) const { return group == 0 ? reference_reynolds : group == 5 ? 1 : 0.1; }

 private:
  void prepare_library();
  LinearFit evaluate(const Eigen::VectorXd& value, const Eigen::MatrixXd& columns,
                     const Eigen::VectorXd& tolerance, const NoiseVariant& variant);

  ObservableModel& model;
  Responses& responses;
  Weighing& weighing;
  const DataNoise& noise;
  const Split& split;
  LinearModel nothing;  ///< nothing missing
  LinearModel linear;   ///< the same, inputs as they act beside the law
  double reference_reynolds = 10;
};

}  // namespace seedflow
