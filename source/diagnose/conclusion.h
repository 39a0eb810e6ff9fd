#pragma once

#include <vector>

#include "seedflow/diagnose/diagnosis.h"
#include "seedflow/diagnose/selection.h"

namespace seedflow {

/// Whether the base model already agrees with the data, inputs and numerical error being uncertain.
struct Adequacy {
  double p_chi2 = 1;              ///< of chi-square
  double p_runs = 1;              ///< of the runs test
  double p_without_numerics = 1;  ///< of chi-square, the numerical error taken as zero
  bool passes() const { return p_chi2 > 0.02 && p_runs > 1e-3; }
};
Adequacy adequacy(const DataNoise& noise, const LinearModel& nothing_missing, const Split& split,
                  Diagnosis& answer);

/// From weighed explanations to the verdict. Internal to the diagnosis.
struct Conclusion {
  ObservableModel& model;
  Responses& responses;
  Weighing& weighing;
  const DataNoise& noise;
  const Split& split;
  const Adequacy& gate;
  const Eigen::VectorXd& z;      ///< standardised residuals of the base model
  double score_of_law = -1e300;  ///< of the best law outside the catalogue, see LawSearch::screened_laws
  std::vector<std::size_t> rivals = {};  ///< among the explanations, of an ambiguous verdict

  /// Sets verdict and rivals; returns the explanation that won, or null.
  Tried* decide(std::vector<Tried>& tried, Diagnosis& answer);
  /// Every training condition in turn is predicted from the others; a winner that does not predict loses.
  void cross_validate(Tried& winner, const std::vector<Tried>& tried, Diagnosis& answer);
  void fill_in(const Tried& winner, Diagnosis& answer) const;
  void fill_gaps(const Tried* winner, Diagnosis& answer) const;
  void fill_explanations(const std::vector<Tried>& tried, Diagnosis& answer) const;
  void say(Diagnosis& answer) const;

 private:
  std::string words(const Hypothesis& what) const;
  bool holds_out(const Tried& winner, const Tried& nothing, Diagnosis& answer) const;
  double rms_gap() const;
};

}  // namespace seedflow
