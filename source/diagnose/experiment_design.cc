#include "seedflow/diagnose/experiment_design.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <set>

#include "seedflow/base/error.h"
#include "seedflow/base/units.h"

namespace seedflow {

namespace {

/// The conditions with one entry of their own multiplied.
std::vector<std::pair<Condition, int>> variations(const ObservableModel& model) {
  std::vector<std::pair<Condition, int>> all;
  for (std::size_t c = 0; c < model.conditions().size(); ++c) {
    const Condition& from = model.conditions()[c];
    for (std::size_t o = 0; o < from.overrides.size(); ++o) {
      const std::size_t equals = from.overrides[o].find('=');
      NumberWithUnit parts;
      try {
        parts = split_unit(from.overrides[o].substr(equals + 1));
      } catch (const InputError&) {
        continue;  // an entry of words
      }
      const double value = std::stod(parts.number);
      for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
        Condition changed = from;
        const std::string text = exact_text(factor * value) + (parts.unit.empty() ? "" : " " + parts.unit);
        changed.overrides[o] = from.overrides[o].substr(0, equals + 1) + text;
        changed.held_out = false;
        changed.name = from.name + " with " + from.overrides[o].substr(0, equals) + " = " + text;
        all.emplace_back(changed, static_cast<int>(c));
      }
    }
  }
  return all;
}

Setting fitted(const ObservableModel& model, const Weighed& w) {
  Setting setting;
  for (std::size_t e = 0; e < model.uncertain_inputs().size() && w.what.nuisance >= 0; ++e)
    if (model.uncertain_inputs()[e].nuisance == w.what.nuisance)
      setting.error[static_cast<int>(e)] = Weighing::widening * w.fit.mean[w.fit.mean.size() - 1];
  for (std::size_t i = 0; i < w.what.set.size(); ++i) setting.amplitude[w.what.set[i]] = w.amplitude[i];
  return setting;
}

}  // namespace

SuggestedExperiment suggest_experiment(const Problem& problem, ObservableModel& model, const DataNoise& noise,
                                       const std::vector<Tried>& tried,
                                       const std::vector<std::size_t>& rivals) {
  std::vector<std::pair<Condition, int>> possible;
  for (const Condition& condition : problem.possible_experiments) possible.emplace_back(condition, 0);
  if (possible.empty()) possible = variations(model);
  SuggestedExperiment best;
  for (const auto& [condition, like] : possible) {
    std::vector<Eigen::VectorXd> predicted;
    Eigen::VectorXd sigma;
    Eigen::MatrixXd inputs;
    try {
      const Eigen::VectorXd base = model.predict_condition(condition, like, {});
      // Measured as well as the condition it resembles.
      sigma.resize(base.size());
      Eigen::Index row = 0;
      for (std::size_t i = 0; i < model.points().size(); ++i) {
        if (model.points()[i].condition != like) continue;
        const double relative =
            std::abs(model.points()[i].value) > 0 ? std::abs(base[row] / model.points()[i].value) : 1.0;
        sigma[row] = noise.sigma(static_cast<Eigen::Index>(i)) * std::max(relative, 1e-3);
        ++row;
      }
      for (const std::size_t r : rivals)
        predicted.push_back(model.predict_condition(condition, like, fitted(model, tried[r].trained)));
      inputs.setZero(base.size(), static_cast<Eigen::Index>(model.nuisances().size()));
      for (std::size_t e = 0; e < model.uncertain_inputs().size(); ++e) {
        if (!model.uncertain_inputs()[e].applies[like]) continue;
        Setting setting;
        setting.error[static_cast<int>(e)] = 1;
        inputs.col(model.uncertain_inputs()[e].nuisance) =
            model.predict_condition(condition, like, setting) - base;
      }
    } catch (const InputError&) {
      continue;  // a variation outside the bounds of an entry
    }
    Eigen::MatrixXd k = inputs * inputs.transpose();
    k.diagonal() += sigma.cwiseAbs2();
    const Eigen::LLT<Eigen::MatrixXd> factor(k);
    // The rival that would still be hardest to tell from the best explanation.
    double separation = 1e300;
    for (std::size_t b = 1; b < predicted.size(); ++b) {
      const Eigen::VectorXd d = predicted[0] - predicted[b];
      separation =
          std::min(separation, d.allFinite() && k.allFinite() ? std::sqrt(d.dot(factor.solve(d))) : 0);
    }
    if (separation < 1e300 && separation > best.separation)
      best.separation = separation, best.condition = condition, best.found = true;
  }
  return best;
}

}  // namespace seedflow
