#include "seedflow/diagnose/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "conclusion.h"
#include "law_search.h"
#include "least_runs.h"
#include "seedflow/base/error.h"
#include "seedflow/base/units.h"
#include "seedflow/diagnose/experiment_design.h"
#include "seedflow/diagnose/inferred_law.h"
#include "seedflow/diagnose/scan.h"
#include "seedflow/diagnose/selection.h"

namespace seedflow {

namespace {

/// Conditions whose base run succeeded.
std::vector<bool> usable_conditions(const ObservableModel& model, const Eigen::VectorXd& base,
                                    Diagnosis& answer) {
  std::vector<bool> usable(model.conditions().size(), true);
  for (std::size_t i = 0; i < model.points().size(); ++i)
    if (!std::isfinite(base[static_cast<Eigen::Index>(i)])) usable[model.points()[i].condition] = false;
  for (std::size_t c = 0; c < usable.size(); ++c) {
    if (usable[c]) continue;
    const std::string& name = model.conditions()[c].name;
    const auto failure = std::find_if(
        model.records().begin(), model.records().end(),
        [&](const RunRecord& r) { return r.condition == name && r.overrides.empty() && r.status != "done"; });
    answer.remarks.push_back("The run of the condition \"" + name + "\" failed; it is left out: " +
                             (failure != model.records().end() ? failure->status : "a repetition failed"));
  }
  return usable;
}

/// Errors: RunError if the runs of all conditions to train on failed.
void require_training(const ObservableModel& model, const std::vector<bool>& usable,
                      const Diagnosis& answer) {
  for (std::size_t c = 0; c < usable.size(); ++c)
    if (usable[c] && !model.conditions()[c].held_out) return;
  std::string text = "No condition is left to train on:";
  for (const std::string& remark : answer.remarks) text += "\n  " + remark;
  throw RunError(text +
                 "\nRemedy: mend the model until ./seedflow run carries it out under these conditions.");
}

/// Candidates that change anything, and whose runs succeed.
std::vector<int> acting_candidates(ObservableModel& model, Responses& responses, bool default_candidates,
                                   Diagnosis& answer) {
  std::vector<int> acting;
  std::string idle, failed, outside;
  for (std::size_t k = 0; k < model.candidates().size(); ++k) {
    const int i = static_cast<int>(k);
    const std::string& name = model.candidates()[k].name;
    if (default_candidates && model.share_in_range(name) == 0)
      outside += (outside.empty() ? "" : ", ") + name;
    else if (!responses.ok({i}))
      failed += (failed.empty() ? "" : ", ") + name;
    else if (responses.acts(i))
      acting.push_back(i);
    else
      idle += (idle.empty() ? "" : ", ") + name;
  }
  if (!idle.empty()) answer.remarks.push_back("Without any action under these conditions: " + idle + ".");
  if (!outside.empty())
    answer.remarks.push_back("Outside their range of validity under every condition, left out: " + outside +
                             ".");
  if (!failed.empty()) answer.remarks.push_back("Candidates whose runs failed, left out: " + failed + ".");
  return acting;
}

/// Classes of candidates whose signatures are parallel once inputs are projected out.
std::vector<std::vector<std::string>> parallel_classes(const ObservableModel& model, Responses& responses,
                                                       Weighing& weighing, const DataNoise& noise,
                                                       const std::vector<bool>& use,
                                                       const std::vector<int>& acting) {
  const LinearModel nothing = weighing.linearise({}, {}, true);
  std::vector<Eigen::VectorXd> signature, weighted;
  for (const int k : acting) {
    LinearModel one = nothing;
    one.residual = responses.at({k}, {1.0}, true).value - responses.base();
    for (Eigen::Index i = 0; i < one.residual.size(); ++i)
      if (!std::isfinite(one.residual[i])) one.residual[i] = 0;
    signature.push_back(one.residual);
    weighted.push_back(fit(noise, stated_noise, one, use).gradient);
  }
  std::vector<std::vector<std::string>> classes;
  std::vector<bool> taken(acting.size(), false);
  for (std::size_t a = 0; a < acting.size(); ++a) {
    if (taken[a]) continue;
    std::vector<std::string> names = {model.candidates()[acting[a]].name};
    for (std::size_t b = a + 1; b < acting.size(); ++b) {
      const double rho =
          signature[a].dot(weighted[b]) /
          std::sqrt(std::max(signature[a].dot(weighted[a]) * signature[b].dot(weighted[b]), 1e-300));
      if (std::abs(rho) > 0.95) names.push_back(model.candidates()[acting[b]].name), taken[b] = true;
    }
    if (names.size() > 1) classes.push_back(names);
  }
  return classes;
}

/// Runs the model with all that was fitted; the answer of the simulation, not of its linear model. Where they
/// differ, the fit is repeated about the simulated values.
Eigen::VectorXd run_fitted(ObservableModel& model, Responses& responses, Weighing& weighing,
                           const DataNoise& noise, const Split& split, Tried& winner) {
  Weighed& w = winner.trained;
  const auto inputs = static_cast<Eigen::Index>(model.uncertain_inputs().size());
  const Eigen::Index first = weighing.first_amplitude();
  Eigen::VectorXd measured(static_cast<Eigen::Index>(model.points().size()));
  for (std::size_t i = 0; i < model.points().size(); ++i)
    measured[static_cast<Eigen::Index>(i)] = model.points()[i].value;
  Eigen::VectorXd simulated;
  for (int pass = 0; pass < 3; ++pass) {
    Setting setting;
    for (std::size_t i = 0; i < w.what.set.size(); ++i) setting.amplitude[w.what.set[i]] = w.amplitude[i];
    Eigen::VectorXd x = w.fit.mean;
    for (Eigen::Index e = 0; e < inputs; ++e) {
      const bool off = model.uncertain_inputs()[e].nuisance == w.what.nuisance;
      setting.error[static_cast<int>(e)] = x[e] + (off ? Weighing::widening * x[x.size() - 1] : 0.0);
    }
    for (std::size_t i = 0; i < w.amplitude.size(); ++i)
      x[first + static_cast<Eigen::Index>(i)] = (w.amplitude[i] - 1) / Weighing::amplitude_deviation;
    simulated = model.predict(setting);
    // The numerical error was fitted, not run.
    const Eigen::VectorXd linear = measured - w.linear.residual + w.linear.directions * x -
                                   responses.numerics() * x.segment(inputs, first - inputs);
    double worst = 0;
    for (Eigen::Index i = 0; i < linear.size(); ++i)
      if (std::isfinite(simulated[i]))
        worst = std::max(worst, std::abs(simulated[i] - linear[i]) / noise.sigma(i));
    if (worst < 0.3 || pass == 2) break;
    for (Eigen::Index i = 0; i < linear.size(); ++i)
      if (std::isfinite(simulated[i])) w.linear.residual[i] += linear[i] - simulated[i];
    w.fit = fit(noise, w.noise, w.linear, split.training);
    for (std::size_t i = 0; i < w.amplitude.size(); ++i) {
      const Eigen::Index c = first + static_cast<Eigen::Index>(i);
      w.amplitude[i] = std::clamp(1 + Weighing::amplitude_deviation * w.fit.mean[c], 0.05, 1.95);
      w.deviation[i] = Weighing::amplitude_deviation * std::sqrt(w.fit.covariance(c, c));
    }
    if (split.has_held_out) predict_held_out(weighing, noise, split.held_out, winner);
  }
  return simulated;
}

std::vector<double> as_vector(const Eigen::VectorXd& v) {
  return {v.data(), v.data() + v.size()};
}

}  // namespace

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::named:
      return "NAMED";
    case Verdict::none:
      return "NONE";
    case Verdict::ambiguous:
      return "AMBIGUOUS";
    case Verdict::not_in_catalogue:
      return "NOT IN CATALOGUE";
    case Verdict::input_uncertain:
      return "INPUT UNCERTAIN";
    case Verdict::numerics_dominate:
      return "NUMERICS DOMINATE";
  }
  return "";
}

Diagnosis diagnose(const Problem& problem, RunStore& store) {
  Diagnosis answer;
  const long computed_before = store.computed();
  ObservableModel model(problem, store);
  const auto n_conditions = static_cast<long>(model.conditions().size());
  const auto n_candidates = static_cast<long>(model.candidates().size());
  const auto n_inputs = static_cast<long>(model.nuisances().size());
  const long lean = least_runs(model);
  if (problem.budget.runs < lean)
    throw InputError(
        (problem.where.count("Runs") ? problem.where.at("Runs") + ": " : "") + "The budget of " +
        std::to_string(problem.budget.runs) + " runs is too small: " + std::to_string(n_candidates) +
        " candidates and " + std::to_string(n_inputs) + " inputs under " + std::to_string(n_conditions) +
        " conditions" +
        (model.repeats() > 1 ? ", repeated " + std::to_string(model.repeats()) + " times," : "") +
        " need at least " + std::to_string(lean) + ". Raise it, or name fewer candidates.");
  const bool frugal = problem.budget.runs < 6 * lean;
  Responses responses(model, frugal);
  // What the winner needs at the end is kept back.
  const long for_winner = 3 * n_conditions * model.repeats();
  model.allow(std::max(lean, problem.budget.runs - for_winner));
  responses.prepare();

  // Pre-checks.
  const Eigen::VectorXd& base = responses.base();
  const std::vector<bool> usable = usable_conditions(model, base, answer);
  require_training(model, usable, answer);
  for (const auto& [quantity, error] : model.add_scatter(responses.settings())) {
    std::ostringstream text;
    text.precision(2);
    text << "Repetitions scatter: " << quantity << " is the mean of " << model.repeats()
         << " runs with other random numbers, its standard error of " << error.first << " to " << error.second
         << " (SI, by condition) is part of the uncertainty.";
    answer.remarks.push_back(text.str());
  }
  DataNoise noise(model.points());
  const Split split = split_series(model, noise, usable);
  for (const std::string& effect : model.idle_effects())
    answer.remarks.push_back("The effect \"" + effect +
                             "\" is switched on in the base model and did nothing under any condition.");
  const std::vector<int> acting = acting_candidates(model, responses, problem.candidates.empty(), answer);
  Weighing weighing(model, responses, noise, static_cast<int>(acting.size()));
  const LinearModel nothing = weighing.linearise({}, {}, true);
  const std::vector<Eigen::Index> outliers = raise_outliers(noise, nothing, split.all);
  if (!outliers.empty()) {
    std::ostringstream text;
    text << outliers.size() << " of " << model.points().size()
         << " points lie far from what their neighbours say; their uncertainty was raised:";
    for (const Eigen::Index i : outliers)
      text << " " << model.conditions()[model.points()[i].condition].name << " " << model.points()[i].quantity
           << " at " << model.points()[i].coordinate << ";";
    answer.remarks.push_back(text.str());
  }

  // Where.
  Eigen::VectorXd z(base.size());
  for (Eigen::Index i = 0; i < base.size(); ++i)
    z[i] = std::isfinite(base[i]) ? (model.points()[i].value - base[i]) /
                                        std::hypot(noise.sigma(i), model.points()[i].correlated_sigma)
                                  : 0;
  answer.places = scan(make_bins(model, noise, split.all), z);

  // What.
  answer.classes = parallel_classes(model, responses, weighing, noise, split.training, acting);
  int training_conditions = 0;
  for (std::size_t c = 0; c < usable.size(); ++c)
    training_conditions += usable[c] && !model.conditions()[c].held_out;
  const int largest = std::min(problem.budget.largest_names, training_conditions);
  if (largest < problem.budget.largest_names)
    answer.remarks.push_back("Only " + std::to_string(training_conditions) +
                             (training_conditions == 1 ? " training condition" : " training conditions") +
                             ": at most as many effects can be told apart.");
  std::vector<Tried> tried = select(weighing, noise, split, acting, largest);

  const Adequacy gate = adequacy(noise, nothing, split, answer);
  Conclusion conclusion{model, responses, weighing, noise, split, gate, z};
  if (!frugal && LawSearch::possible(model)) {
    const auto nothing_missing = std::find_if(tried.begin(), tried.end(), [](const Tried& t) {
      return t.trained.what.set.empty() && t.trained.what.nuisance < 0;
    });
    const auto laws =
        LawSearch(model, responses, weighing, noise, split).screened_laws(nothing_missing->trained.noise);
    if (!laws.empty()) conclusion.score_of_law = laws.front().score;
  }
  Tried* winner = conclusion.decide(tried, answer);
  if (winner && !winner->trained.what.set.empty() && !split.has_held_out)
    conclusion.cross_validate(*winner, tried, answer);

  if (model.out_of_budget())
    answer.remarks.push_back("The budget of " + std::to_string(problem.budget.runs) +
                             " runs was used up: explanations whose runs it did not allow were left out.");
  model.allow(std::max(problem.budget.runs, model.runs() + for_winner));

  // Add and show.
  answer.before = as_vector(base);
  for (const DataPoint& point : model.points()) answer.unit_scale.push_back(point.unit_scale);
  answer.after = answer.before;
  if (winner && (answer.verdict == Verdict::named || answer.verdict == Verdict::input_uncertain)) {
    answer.after = as_vector(run_fitted(model, responses, weighing, noise, split, *winner));
    conclusion.fill_in(*winner, answer);
  }
  if (answer.verdict == Verdict::not_in_catalogue)
    answer.law = infer_law(model, responses, weighing, noise, split, answer);
  conclusion.fill_gaps(winner, answer);
  if (answer.verdict == Verdict::ambiguous)
    answer.suggestion = suggest_experiment(problem, model, noise, tried, conclusion.rivals);
  conclusion.fill_explanations(tried, answer);
  conclusion.say(answer);
  answer.run_list = model.records();
  answer.runs = model.runs();
  answer.runs_computed = store.computed() - computed_before;
  return answer;
}

Diagnosis diagnose(const Problem& problem) {
  RunStore store;
  return diagnose(problem, store);
}

}  // namespace seedflow
