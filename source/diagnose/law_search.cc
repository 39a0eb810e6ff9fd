#include "law_search.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

const std::string head = "Effects/Inferred law/";
constexpr double probe = 0.02;  ///< coefficient of the terms of the library, small enough to be linear
/// Prior standard deviations: coefficients in units of drag or weight, exponents.
constexpr double coefficient_deviation = 0.5, exponent_deviation = 2;
constexpr double library_exponents[] = {-1.0, -0.5, 0.5, 1.0, 2.0};
constexpr std::size_t n_tolerated = 25;  ///< terms of the library that are looked at closely

}  // namespace

const char* const Law::directions[] = {"Slip",      "Gravity",    "x",      "y",      "z",
                                       "Spin lift", "Shear lift", "Trap x", "Trap y", "Trap z"};
const char* const Law::groups[] = {"Reynolds number", "Spin ratio",     "Wall ratio",
                                   "Tube ratio",      "Solid fraction", "shear Reynolds number"};

std::string Law::reference() const {
  const std::string name = directions[direction];
  if (name == "Slip") return "drag";
  if (name.find("lift") != std::string::npos) return "Stokes drag";
  return name.rfind("Trap", 0) == 0 ? "weight per diameter of distance" : "weight";
}

std::string Law::force_in_words() const {
  static const char* const words[n_directions] = {
      "force along the slip",
      "force along gravity",
      "force along x",
      "force along y",
      "force along z",
      "lift by spin",
      "lift by shear",
      "force along x that grows with the distance from the origin",
      "force along y that grows with the distance from the origin",
      "force along z that grows with the distance from the origin"};
  return words[direction];
}

double Law::price() const {
  // A force fixed in space breaks the symmetry of the flow; it is less likely before anything is seen.
  static const double of_direction[n_directions] = {0, 1, 3, 3, 3, 0, 0, 4, 4, 4};
  double sum = std::log(n_directions / Weighing::odds) + of_direction[direction];
  for (const bool one : has)
    if (one) sum += std::log(static_cast<double>(n_groups));
  return sum;
}

double Law::log_prior() const {
  double sum = std::pow(coefficient / coefficient_deviation, 2);
  for (int g = 0; g < n_groups; ++g)
    if (has[g]) sum += std::pow(exponent[g] / exponent_deviation, 2);
  return -0.5 * sum;
}

bool LawSearch::possible(const ObservableModel& model) {
  return model.has_entry(head + "Strength");
}

LawSearch::LawSearch(ObservableModel& model, Responses& responses, Weighing& weighing, const DataNoise& noise,
                     const Split& split)
    : model(model),
      responses(responses),
      weighing(weighing),
      noise(noise),
      split(split),
      nothing(weighing.linearise({}, {}, true)),
      linear(nothing) {
  const auto& names = model.regimes();
  if (std::find(names.begin(), names.end(), "Reynolds number") == names.end()) return;
  const Eigen::VectorXd re = model.regime("Reynolds number");
  double sum = 0, n = 0;
  for (Eigen::Index i = 0; i < re.size(); ++i)
    if (re[i] > 0) sum += std::log(re[i]), ++n;
  // A round number, so that the library does not depend on details.
  if (n > 0) reference_reynolds = std::pow(10.0, std::round(sum / n / std::log(10.0)));
}

Setting LawSearch::setting(const Law& law) const {
  Setting s;
  s.entries[head + "Strength"] = 1;
  double scale = 1;
  for (int g = 0; g < Law::n_groups; ++g) {
    if (!law.has[g]) continue;
    s.entries[head + "Exponent " + Law::groups[g]] = law.exponent[g];
    scale *= std::pow(reference(g), -law.exponent[g]);
  }
  s.entries[head + "Coefficient " + Law::directions[law.direction]] = law.coefficient * scale;
  return s;
}

LinearFit LawSearch::evaluate(const Eigen::VectorXd& value, const Eigen::MatrixXd& columns,
                              const Eigen::VectorXd& tolerance, const NoiseVariant& variant) {
  LinearModel with = linear;
  with.residual += responses.base() - value;
  const Eigen::Index q = with.directions.cols();
  with.directions.conservativeResize(Eigen::NoChange, q + columns.cols());
  with.directions.rightCols(columns.cols()) = columns;
  if (tolerance.size() > 0) {
    with.tolerance.conservativeResize(Eigen::NoChange, with.tolerance.cols() + 1);
    with.tolerance.rightCols(1) = tolerance;
  }
  return WhitenedModel(noise, variant, with, split.all).full();
}

void LawSearch::prepare_library() {
  // The ranks share the whole library, terms that turn out to say nothing included.
  std::vector<Setting> settings;
  for (int direction = 0; direction < Law::n_directions; ++direction) {
    Law law;
    law.direction = direction;
    law.coefficient = probe;
    settings.push_back(setting(law));
    for (int g = 0; g < Law::n_groups; ++g)
      for (const double exponent : library_exponents) {
        Law with = law;
        with.has[g] = true;
        with.exponent[g] = exponent;
        settings.push_back(setting(with));
      }
  }
  model.prepare_runs(settings);
}

std::vector<LawSearch::Screened> LawSearch::screened_laws(const NoiseVariant& other) {
  const auto response = [&](Law law) {
    law.coefficient = probe;
    Eigen::VectorXd d = (model.predict(setting(law)) - responses.base()) / probe;
    for (Eigen::Index i = 0; i < d.size(); ++i)
      if (!std::isfinite(d[i])) d[i] = 0;
    return d;
  };
  std::vector<NoiseVariant> variants = {stated_noise};
  if (!other.as_stated()) variants.push_back(other);
  std::vector<WhitenedModel> whitened;
  for (const NoiseVariant& variant : variants) whitened.emplace_back(noise, variant, nothing, split.all);
  struct Term {
    Screened screened;
    Eigen::VectorXd response;
    std::vector<double> coefficient;  // per variant
  };
  std::vector<Term> terms;
  const auto screen = [&](const Law& law, const Eigen::VectorXd& d) {
    Term term{{law}, d, {}};
    for (std::size_t v = 0; v < variants.size(); ++v) {
      const auto with = whitened[v].with(coefficient_deviation * d);
      term.coefficient.push_back(coefficient_deviation * with.mean);
      term.screened.take(with.log_evidence, variants[v], term.coefficient[v]);
    }
    terms.push_back(term);
  };
  prepare_library();
  for (int direction = 0; direction < Law::n_directions; ++direction) {
    Law constant;
    constant.direction = direction;
    const Eigen::VectorXd d = response(constant);
    if (d.cwiseAbs().maxCoeff() == 0) continue;
    screen(constant, d);
    for (int g = 0; g < Law::n_groups; ++g) {
      Law law = constant;
      law.has[g] = true;
      law.exponent[g] = 1;
      const Eigen::VectorXd first = response(law);
      // A group that is the same everywhere (or zero) says nothing.
      const double scale = first.norm() * d.norm();
      if (!(scale > 0) || first.dot(d) > (1 - 1e-6) * scale) continue;
      for (const double exponent : library_exponents) {
        law.exponent[g] = exponent;
        const Eigen::VectorXd r = exponent == 1 ? first : response(law);
        if (r.cwiseAbs().maxCoeff() > 0) screen(law, r);
      }
    }
  }
  // Exponents lie between those of the library, and responses bend: a tenth of the change is tolerated. This
  // takes a fit of its own, so only the better terms get it.
  const auto better = [](const Term& a, const Term& b) { return a.screened.score > b.screened.score; };
  std::stable_sort(terms.begin(), terms.end(), better);
  const std::size_t n = std::min(terms.size(), n_tolerated);
  for (std::size_t i = 0; i < n; ++i) {
    terms[i].screened.score = -1e300;
    for (std::size_t v = 0; v < variants.size(); ++v) {
      Term& term = terms[i];
      const LinearFit f = evaluate(responses.base(), coefficient_deviation * term.response,
                                   0.1 * std::abs(term.coefficient[v]) * term.response, variants[v]);
      term.screened.take(f.log_evidence, variants[v], coefficient_deviation * f.mean[f.mean.size() - 1]);
    }
  }
  std::stable_sort(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(n), better);
  std::vector<Screened> list;
  for (const Term& term : terms) list.push_back(term.screened);
  return list;
}

void LawSearch::Screened::take(double log_evidence, const NoiseVariant& variant, double coefficient) {
  const double now = log_evidence - law.price() - (variant.as_stated() ? 0 : Weighing::price_of_noise);
  if (now <= score) return;
  score = now;
  law.coefficient = coefficient;
}

LawSearch::Refined LawSearch::refine(const Law& start) {
  Refined best;
  Law law = start;
  std::vector<double> step;  // of the coefficient and the exponents
  double share = 1, reached = -1e300;
  const auto stepped = [&] {
    Law to = law;
    to.coefficient += share * step[0];
    std::size_t i = 1;
    for (int g = 0; g < Law::n_groups; ++g)
      if (to.has[g]) to.exponent[g] = std::clamp(to.exponent[g] + share * step[i++], -4.0, 4.0);
    return to;
  };
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Law trial = step.empty() ? start : stepped();
    const Eigen::VectorXd now = model.predict(setting(trial));
    // Gauss-Newton steps that the simulation does not confirm are shortened.
    const LinearFit fixed =
        now.allFinite() ? evaluate(now, Eigen::MatrixXd(now.size(), 0), Eigen::VectorXd(), stated_noise)
                        : LinearFit();
    const double probability = now.allFinite() ? fixed.log_evidence + trial.log_prior() : -1e301;
    if (probability <= reached) {
      share *= 0.4;
      if (step.empty() || share < 0.01) break;
      continue;
    }
    law = trial, reached = probability, share = 1;
    std::vector<int> present;
    for (int g = 0; g < Law::n_groups; ++g)
      if (law.has[g]) present.push_back(g);
    Eigen::MatrixXd columns(now.size(), 1 + static_cast<Eigen::Index>(present.size()));
    Eigen::VectorXd centre(columns.cols());
    {
      Law moved = law;
      const double h = 0.02 * std::max(std::abs(law.coefficient), probe);
      moved.coefficient += h;
      columns.col(0) = coefficient_deviation * (model.predict(setting(moved)) - now) / h;
      centre[0] = law.coefficient / coefficient_deviation;
    }
    for (std::size_t i = 0; i < present.size(); ++i) {
      Law moved = law;
      const double h = 0.02;
      moved.exponent[present[i]] += h;
      const auto c = static_cast<Eigen::Index>(i) + 1;
      columns.col(c) = exponent_deviation * (model.predict(setting(moved)) - now) / h;
      centre[c] = law.exponent[present[i]] / exponent_deviation;
    }
    if (!columns.allFinite()) break;
    // Priors are N(0, deviation^2) about zero, the linear model is about the present values.
    const LinearFit f = evaluate(now - columns * centre, columns, Eigen::VectorXd(), stated_noise);
    const Eigen::Index first = f.mean.size() - columns.cols();
    best = {law, f.log_evidence, fixed.chi2, fixed.points, {}};
    best.deviation.push_back(coefficient_deviation * std::sqrt(f.covariance(first, first)));
    for (Eigen::Index i = 1; i < columns.cols(); ++i)
      best.deviation.push_back(exponent_deviation * std::sqrt(f.covariance(first + i, first + i)));
    const double limit = std::abs(law.coefficient) + 0.05;
    step = {std::clamp(coefficient_deviation * f.mean[first] - law.coefficient, -limit, limit)};
    for (std::size_t i = 0; i < present.size(); ++i)
      step.push_back(std::clamp(
          exponent_deviation * f.mean[first + 1 + static_cast<Eigen::Index>(i)] - law.exponent[present[i]],
          -0.5, 0.5));
    double moved = 0;
    for (std::size_t i = 0; i < step.size(); ++i)
      moved = std::max(moved, std::abs(step[i]) / std::max(best.deviation[i], 1e-9));
    if (moved < 0.05) break;
  }
  return best;
}

void LawSearch::refine_about(const Law& law) {
  linear = weighing.linearise_about(setting(law));
}

double LawSearch::chi2_of_nothing() const {
  return fit(noise, stated_noise, nothing, split.all).chi2;
}

}  // namespace seedflow
