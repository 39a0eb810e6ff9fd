#pragma once

#include <map>
#include <vector>

#include "seedflow/diagnose/observable_model.h"

namespace seedflow {

/// How the simulated values answer to effects and inputs, from few runs that do not depend on the measured
/// values: every candidate at amplitudes 0, 0.6, 1, 1.4 (a cubic), sets of candidates at full strength (the
/// rest of their joint action taken as the product of amplitudes), inputs by one standard deviation.
class Responses {
 public:
  /// `frugal`: one run per candidate, the response taken as proportional to the amplitude, and inputs in the
  /// base model only.
  Responses(ObservableModel& model, bool frugal) : model(model), frugal(frugal) {}

  struct Value {
    Eigen::VectorXd value;
    Eigen::MatrixXd slope;  ///< one column per candidate of the set, d value/d amplitude
  };
  /// Makes the runs of base model, candidates, inputs and half step together, shared over the ranks.
  void prepare();
  /// What those runs are.
  std::vector<Setting> settings() const;
  /// The same for sets of candidates and the inputs beside them.
  void prepare(const std::vector<std::vector<int>>& sets);
  const Eigen::VectorXd& base();
  /// Values of the set at the given amplitudes. `joint`: with the runs of the whole set; otherwise the
  /// candidates' own changes are added up.
  Value at(const std::vector<int>& set, const std::vector<double>& amplitude, bool joint);
  /// One column per uncertain input, change by one standard deviation, with the set at the given amplitudes:
  /// the response at amplitude 1, and what every effect of the set alone changes in it per amplitude.
  Eigen::MatrixXd inputs(const std::vector<int>& set, const std::vector<double>& amplitude);
  /// The same about a model with these entries and amplitudes, by runs of its own.
  Eigen::MatrixXd inputs(const Setting& about);
  /// Numerical error by Richardson extrapolation of a halved step (second order): 4/3 (half - full), one
  /// column per condition; empty if the experiment has no step to halve.
  const Eigen::MatrixXd& numerics();
  /// Whether all runs of this set succeeded where the base run did.
  bool ok(const std::vector<int>& set);
  /// False if the candidate changes nothing anywhere.
  bool acts(int candidate);

 private:
  const Eigen::VectorXd& full(const std::vector<int>& set);
  static Setting at_full_strength(const std::vector<int>& set);
  Setting with_input(Setting setting, int nuisance) const;
  /// Standard deviations by which inputs are moved: more where repetitions scatter.
  double input_step() const { return model.repeats() > 1 ? 4 : 1; }
  const Eigen::MatrixXd& inputs_at_full_strength(const std::vector<int>& set);
  Eigen::VectorXd joint_rest(const std::vector<int>& set);

  ObservableModel& model;
  bool frugal;
  Eigen::VectorXd base_values;
  std::map<int, Eigen::MatrixXd> cubic;  // columns: coefficients of a, a^2, a^3
  std::map<std::vector<int>, Eigen::VectorXd> full_values;
  std::map<std::vector<int>, Eigen::MatrixXd> input_columns;
  Eigen::MatrixXd numerical;
  bool numerics_known = false;
};

}  // namespace seedflow
