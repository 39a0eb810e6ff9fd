#include "seedflow/diagnose/inferred_law.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/base/units.h"

namespace seedflow {

namespace {

const std::string head = "Effects/Inferred law/";
const char* const directions[] = {"Slip", "Gravity", "x", "y", "z", "Spin lift", "Shear lift"};
const char* const groups[] = {"Reynolds number", "Spin ratio", "Wall ratio", "Tube ratio", "Solid fraction"};
constexpr int n_groups = 5;
constexpr double probe = 0.02;  ///< coefficient of the terms of the library, small enough to be linear

/// A law: direction, coefficient at the reference values of the groups, exponents (0: group absent).
struct Law {
  int direction = 0;
  double coefficient = probe;
  double exponent[n_groups] = {};
  bool has[n_groups] = {};
};

/// A library term is fitted by a coefficient with a wide prior: +-1 in units of the reference force.
constexpr double coefficient_deviation = 1;
/// A further group must raise the evidence by this.
constexpr double price_of_group = 5;

class LawSearch {
 public:
  LawSearch(ObservableModel& model, Responses& responses, Weighing& weighing, const DataNoise& noise,
            const Split& split)
      : model(model), responses(responses), weighing(weighing), noise(noise), split(split) {
    reference_reynolds = 10;
    const auto& names = model.regimes();
    if (std::find(names.begin(), names.end(), "Reynolds number") != names.end()) {
      const Eigen::VectorXd re = model.regime("Reynolds number");
      double sum = 0, n = 0;
      for (Eigen::Index i = 0; i < re.size(); ++i)
        if (re[i] > 0) sum += std::log(re[i]), ++n;
      // A round number, so that the library does not depend on details.
      if (n > 0) reference_reynolds = std::pow(10.0, std::round(sum / n / std::log(10.0)));
    }
  }

  Setting setting(const Law& law) const {
    Setting s;
    s.entries[head + "Strength"] = 1;
    double scale = 1;
    for (int g = 0; g < n_groups; ++g) {
      if (!law.has[g]) continue;
      s.entries[head + "Exponent " + groups[g]] = law.exponent[g];
      scale *= std::pow(reference(g), -law.exponent[g]);
    }
    s.entries[head + "Coefficient " + directions[law.direction]] = law.coefficient * scale;
    return s;
  }
  double reference(int group) const { return group == 0 ? reference_reynolds : 0.1; }

  /// Log evidence of a law about which the model is linear in `columns`, with parameter deviations `prior`.
  LinearFit evaluate(const Eigen::VectorXd& value, const Eigen::MatrixXd& columns) {
    LinearModel linear = weighing.linearise({}, {}, true);
    linear.residual += responses.base() - value;
    const Eigen::Index q = linear.directions.cols();
    linear.directions.conservativeResize(Eigen::NoChange, q + columns.cols());
    linear.directions.rightCols(columns.cols()) = columns;
    return fit(noise, noise_variants()[0], linear, split.all);
  }

  Eigen::VectorXd changed(const Law& law) {
    Eigen::VectorXd d = model.predict(setting(law)) - responses.base();
    for (Eigen::Index i = 0; i < d.size(); ++i)
      if (!std::isfinite(d[i])) d[i] = 0;
    return d;
  }

  /// Coefficient by the linear response.
  double screen(Law& law) {
    law.coefficient = probe;
    const Eigen::VectorXd d = changed(law) / probe;
    if (d.cwiseAbs().maxCoeff() == 0) return -1e300;
    const LinearFit f = evaluate(responses.base(), coefficient_deviation * d);
    law.coefficient = coefficient_deviation * f.mean[f.mean.size() - 1];
    return f.log_evidence;
  }

  /// Gauss-Newton over coefficient and exponents with real runs.
  struct Refined {
    Law law;
    double log_evidence = -1e300, chi2 = 0;
    int points = 0;
    std::vector<double> deviation;  // coefficient, then exponents of the groups it has
  };
  Refined refine(Law law) {
    Refined best;
    double step_limit = 1;
    Law trial = law;
    for (int iteration = 0; iteration < 10; ++iteration) {
      std::vector<int> present;
      for (int g = 0; g < n_groups; ++g)
        if (trial.has[g]) present.push_back(g);
      const Eigen::VectorXd now = model.predict(setting(trial));
      if (!now.allFinite()) break;
      Eigen::MatrixXd columns(now.size(), 1 + static_cast<Eigen::Index>(present.size()));
      Eigen::VectorXd centre(columns.cols());
      {
        Law moved = trial;
        const double h = 0.02 * std::max(std::abs(trial.coefficient), probe);
        moved.coefficient += h;
        columns.col(0) = coefficient_deviation * (model.predict(setting(moved)) - now) / h;
        centre[0] = trial.coefficient / coefficient_deviation;
      }
      for (std::size_t i = 0; i < present.size(); ++i) {
        Law moved = trial;
        const double h = 0.02;
        moved.exponent[present[i]] += h;
        const auto c = static_cast<Eigen::Index>(i) + 1;
        columns.col(c) = exponent_deviation * (model.predict(setting(moved)) - now) / h;
        centre[c] = trial.exponent[present[i]] / exponent_deviation;
      }
      if (!columns.allFinite()) break;
      // Priors are N(0, deviation^2) about zero, the linear model is about the present values.
      const LinearFit f = evaluate(now - columns * centre, columns);
      const Eigen::Index first = f.mean.size() - columns.cols();
      if (f.log_evidence > best.log_evidence) {
        best.log_evidence = f.log_evidence;
        best.law = trial;
        best.chi2 = f.chi2;
        best.points = f.points;
        best.deviation = {coefficient_deviation * std::sqrt(f.covariance(first, first))};
        for (Eigen::Index i = 1; i < columns.cols(); ++i)
          best.deviation.push_back(exponent_deviation * std::sqrt(f.covariance(first + i, first + i)));
      }
      double moved = 0;
      const double limit = step_limit * (std::abs(trial.coefficient) + 0.05);
      const double dc = std::clamp(coefficient_deviation * f.mean[first] - trial.coefficient, -limit, limit);
      trial.coefficient += dc;
      moved = std::abs(dc) / std::max(best.deviation[0], 1e-9);
      for (std::size_t i = 0; i < present.size(); ++i) {
        const double de = std::clamp(exponent_deviation * f.mean[first + 1 + static_cast<Eigen::Index>(i)] -
                                         trial.exponent[present[i]],
                                     -0.5 * step_limit, 0.5 * step_limit);
        trial.exponent[present[i]] = std::clamp(trial.exponent[present[i]] + de, -4.0, 4.0);
        moved = std::max(moved, std::abs(de) / std::max(best.deviation[i + 1], 1e-9));
      }
      if (moved < 0.05) {
        best.law = trial;
        break;
      }
      step_limit *= 0.9;
    }
    return best;
  }

 private:
  static constexpr double exponent_deviation = 2;
  ObservableModel& model;
  Responses& responses;
  Weighing& weighing;
  const DataNoise& noise;
  const Split& split;
  double reference_reynolds;
};

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

InferredLaw infer_law(ObservableModel& model, Responses& responses, Weighing& weighing,
                      const DataNoise& noise, const Split& split, Diagnosis& answer) {
  InferredLaw found;
  try {
    model.base_value(head + "Strength", 0);
  } catch (const InputError&) {
    return found;
  }
  LawSearch search(model, responses, weighing, noise, split);
  // One group at most: the library.
  std::vector<std::pair<double, Law>> library;
  for (int direction = 0; direction < 7; ++direction) {
    Law constant;
    constant.direction = direction;
    const double e = search.screen(constant);
    if (e <= -1e300) continue;
    library.emplace_back(e, constant);
    for (int g = 0; g < n_groups; ++g)
      for (const double exponent : {-1.0, -0.5, 0.5, 1.0, 2.0}) {
        Law law;
        law.direction = direction;
        law.has[g] = true;
        law.exponent[g] = exponent;
        const double evidence = search.screen(law) - price_of_group;
        if (evidence > -1e300) library.emplace_back(evidence, law);
      }
  }
  if (library.empty()) return found;
  std::stable_sort(library.begin(), library.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  // The best term of each of the three best combinations of direction and group is refined.
  LawSearch::Refined best;
  double best_score = -1e300;
  std::vector<std::pair<int, int>> done;
  for (const auto& [evidence, law] : library) {
    int group = -1;
    for (int g = 0; g < n_groups; ++g)
      if (law.has[g]) group = g;
    if (std::find(done.begin(), done.end(), std::make_pair(law.direction, group)) != done.end()) continue;
    done.emplace_back(law.direction, group);
    const LawSearch::Refined refined = search.refine(law);
    const double score = refined.log_evidence - (group >= 0 ? price_of_group : 0);
    if (score > best_score) best_score = score, best = refined;
    if (done.size() == 3) break;
  }
  // A second group, if the data want it.
  for (int g = 0; g < n_groups && best_score > -1e300 && best.chi2 > 1.3 * best.points; ++g) {
    if (best.law.has[g]) continue;
    Law law = best.law;
    law.has[g] = true;
    law.exponent[g] = 0.2;
    const LawSearch::Refined refined = search.refine(law);
    const double score = refined.log_evidence - 2 * price_of_group;
    if (score > best_score) best_score = score, best = refined;
  }
  if (best_score <= -1e300) return found;

  const Setting setting = search.setting(best.law);
  found.found = true;
  found.direction = directions[best.law.direction];
  const double c = best.law.coefficient, s = 1.96 * best.deviation[0];
  found.coefficient = {c, c - s, c + s};
  std::string product = short_text(c);
  std::size_t i = 1;
  for (int g = 0; g < n_groups; ++g) {
    if (!best.law.has[g]) continue;
    const double e = best.law.exponent[g], se = 1.96 * best.deviation[i++];
    found.factors.push_back({groups[g], {e, e - se, e + se}});
    product += std::string(" (") + groups[g] + "/" + short_text(search.reference(g)) + ")^" + short_text(e) +
               " (" + short_text(e - se) + " to " + short_text(e + se) + ")";
  }
  const bool body = best.law.direction >= 1 && best.law.direction <= 4;
  found.text =
      std::string("force along ") + found.direction + " = " + product + " x " + (body ? "weight" : "drag");
  const Eigen::VectorXd after = model.predict(setting);
  answer.after.assign(after.data(), after.data() + after.size());
  for (const auto& [path, value] : setting.entries)
    answer.overrides.push_back(path + "=" + exact_text(value));
  return found;
}

}  // namespace seedflow
