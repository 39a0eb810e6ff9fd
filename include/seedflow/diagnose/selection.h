#pragma once

#include <string>
#include <vector>

#include "seedflow/diagnose/weighing.h"

namespace seedflow {

/// An explanation weighed on the training conditions and tried on the others.
struct Tried {
  Weighed trained;
  double predictive = 0;     ///< log density of the held-out values
  double chi2_held_out = 0;  ///< with the uncertainty of the prediction
  int points_held_out = 0;
  double total() const { return trained.score + predictive; }
};

/// Which series train and which are held out.
struct Split {
  std::vector<bool> training, held_out, all;
  bool has_held_out = false;
};
/// Series of conditions without a base run belong to neither.
Split split_series(const ObservableModel& model, const DataNoise& noise, const std::vector<bool>& usable);

/// Forward search: nothing, inputs, single candidates, then pairs and triples around the best; every set that
/// survives the screening by added-up changes is weighed with its own runs. Sets of which one effect can be
/// removed without loss lose to the smaller ones by the price of multiplicity (the backward check). Best
/// first.
std::vector<Tried> select(Weighing& weighing, const DataNoise& noise, const Split& split,
                          const std::vector<int>& acting, int largest);

/// Predicts the series `to` from what was fitted elsewhere.
void predict_held_out(Weighing& weighing, const DataNoise& noise, const std::vector<bool>& to, Tried& tried);

/// Points far from what their neighbours say (smooth discrepancy allowed, more than 5 standard deviations
/// when left out): their uncertainty is raised to the deviation. Returns their indices.
std::vector<Eigen::Index> raise_outliers(DataNoise& noise, const LinearModel& nothing_missing,
                                         const std::vector<bool>& use);

}  // namespace seedflow
