#include "conclusion.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace seedflow {

namespace {

constexpr double sure = 4.6;          ///< ln 99: odds at which an explanation is named
constexpr double surer = 12;          ///< against a law that was made up for the data
constexpr double sure_of_more = 2.3;  ///< ln 10: against an explanation that adds to the best one
constexpr double largest_rest = 2.0;  ///< chi2/n by the stated uncertainties that an explanation may leave

double squared(double x) {
  return x * x;
}

std::string rounded(double value, int digits = 2) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// A smooth rest beyond the stated uncertainties, of which the data are sure; or inputs strained beyond
/// belief.
bool leaves_a_rest(const Weighed& w) {
  return (w.noise.discrepancy > 0 && w.chi2_as_stated > largest_rest && w.score - w.score_as_stated > sure) ||
         chi2_tail(w.fit.chi2, w.fit.points) < 1e-5;
}

std::string rest_in_words(const Weighed& w) {
  if (w.noise.discrepancy > 0)
    return "leaves a smooth rest of " + rounded(w.noise.discrepancy) + " standard uncertainties";
  return "strains the inputs beyond their uncertainties (chi2/n " + rounded(w.fit.chi2 / w.fit.points) + ")";
}

bool believable(const Weighed& w) {
  for (std::size_t i = 0; i < w.amplitude.size(); ++i)
    if (w.amplitude[i] < 3 * w.deviation[i] || w.amplitude[i] < 0.35 || w.amplitude[i] > 1.8) return false;
  return true;
}

bool contains(const std::vector<int>& larger, const std::vector<int>& smaller) {
  return std::includes(larger.begin(), larger.end(), smaller.begin(), smaller.end());
}

}  // namespace

Adequacy adequacy(const DataNoise& noise, const LinearModel& nothing, const Split& split, Diagnosis& answer) {
  (void)answer;
  Adequacy a;
  const LinearFit with = fit(noise, stated_noise, nothing, split.all);
  a.p_chi2 = chi2_tail(with.chi2, with.points);
  a.p_runs = runs_test(noise, with.innovations, split.all);
  return a;
}

std::string Conclusion::words(const Hypothesis& what) const {
  if (what.nuisance >= 0) return model.nuisances()[what.nuisance].name + " off";
  if (what.set.empty()) return "nothing missing";
  std::string text;
  for (const int k : what.set) text += (text.empty() ? "" : " + ") + model.candidates()[k].name;
  return text;
}

double Conclusion::rms_gap() const {
  return std::sqrt(z.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(z.size(), 1)));
}

bool Conclusion::holds_out(const Tried& winner, const Tried& nothing, Diagnosis& answer) const {
  if (!split.has_held_out) return true;
  if (chi2_tail(winner.chi2_held_out, winner.points_held_out) < 1e-4) {
    answer.remarks.push_back("\"" + words(winner.trained.what) +
                             "\" fits the training conditions but not the ones held out (chi2/n " +
                             rounded(winner.chi2_held_out / winner.points_held_out) + ").");
    return false;
  }
  for (std::size_t c = 0; c < model.conditions().size(); ++c) {
    std::vector<bool> one(split.held_out.size(), false);
    bool any = false;
    for (std::size_t s = 0; s < one.size(); ++s)
      if (split.held_out[s] && model.points()[noise.series()[s][0]].condition == static_cast<int>(c))
        one[s] = any = true;
    if (!any) continue;
    Tried with = winner, without = nothing;
    predict_held_out(weighing, noise, one, with);
    predict_held_out(weighing, noise, one, without);
    if (with.predictive < without.predictive - 3) {
      answer.remarks.push_back("\"" + words(winner.trained.what) + "\" makes the condition \"" +
                               model.conditions()[c].name + "\" worse, which it had not seen.");
      return false;
    }
  }
  return true;
}

Tried* Conclusion::decide(std::vector<Tried>& tried, Diagnosis& answer) {
  const auto is_nothing = [](const Tried& t) {
    return t.trained.what.set.empty() && t.trained.what.nuisance < 0;
  };
  Tried& nothing = *std::find_if(tried.begin(), tried.end(), is_nothing);
  answer.noise_scale = std::hypot(nothing.trained.noise.white_scale, nothing.trained.noise.discrepancy);
  // What has passed the gate is opened again only for a sure explanation.
  const auto likeliest = std::find_if(
      tried.begin(), tried.end(), [](const Tried& t) { return t.trained.possible && believable(t.trained); });
  const bool law_wanted = score_of_law > nothing.total() + sure;
  const bool reopened =
      law_wanted || (likeliest->total() > nothing.total() + sure && likeliest->trained.noise.as_stated());
  if (gate.passes() && !reopened) {
    answer.noise_scale = 1;
    LinearModel exact = nothing.trained.linear;
    const auto inputs = static_cast<Eigen::Index>(model.uncertain_inputs().size());
    exact.directions.conservativeResize(Eigen::NoChange, inputs);  // numerical errors stand last
    const LinearFit without = fit(noise, stated_noise, exact, split.all);
    answer.verdict =
        chi2_tail(without.chi2, without.points) < 1e-3 ? Verdict::numerics_dominate : Verdict::none;
    return &nothing;
  }
  // The most that the numerical error may do, against the gap.
  double numerical = 0;
  for (Eigen::Index i = 0; i < z.size(); ++i)
    numerical += squared(responses.numerics().row(i).sum() / noise.sigma(i));
  numerical = std::sqrt(numerical / static_cast<double>(z.size()));
  if (numerical > 1 && numerical > 0.5 * rms_gap()) {
    answer.verdict = Verdict::numerics_dominate;
    return &nothing;
  }

  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (tried[i].trained.possible && believable(tried[i].trained)) list.push_back(i);
  Tried& best = tried[list[0]];
  answer.noise_scale = std::hypot(best.trained.noise.white_scale, best.trained.noise.discrepancy);
  // A law that is free in direction and power must beat a published effect clearly.
  const bool flexible = score_of_law > best.total() + (best.trained.what.set.empty() ? sure : surer);
  if (flexible)
    answer.remarks.push_back("A law outside the catalogue explains the data better than \"" +
                             words(best.trained.what) + "\", by a factor of e^" +
                             rounded(score_of_law - best.total(), 3) + ".");
  if (flexible || leaves_a_rest(best.trained)) {
    answer.verdict = Verdict::not_in_catalogue;
    if (!is_nothing(best) && leaves_a_rest(best.trained))
      answer.remarks.push_back("\"" + words(best.trained.what) + "\" comes nearest but " +
                               rest_in_words(best.trained) + ".");
    return &nothing;
  }
  if (is_nothing(best)) {
    answer.verdict = Verdict::none;
    answer.remarks.push_back("The data scatter by about " + rounded(answer.noise_scale) +
                             " times the stated uncertainty, without a pattern that an effect would leave.");
    return &nothing;
  }
  if (!holds_out(best, nothing, answer)) {
    answer.verdict = Verdict::not_in_catalogue;
    return &nothing;
  }
  bool nothing_rivals = false;
  for (const std::size_t i : list) {
    if (&tried[i] == &best) continue;
    const Weighed& w = tried[i].trained;
    // How far the amplitude is from 1 shall not decide between effects that look alike.
    double excused = 0;
    for (const double a : w.amplitude) excused += 0.5 * squared((a - 1) / Weighing::amplitude_deviation);
    const bool adds =
        w.what.nuisance < 0 && !best.trained.what.set.empty() && contains(w.what.set, best.trained.what.set);
    const double behind = best.total() - tried[i].total() - (adds ? 0.0 : std::min(excused, 2.0));
    if (behind > (adds ? sure_of_more : sure)) continue;
    if (is_nothing(tried[i])) nothing_rivals = true;
    if (rivals.size() < 4) rivals.push_back(i);
  }
  if (nothing_rivals) {
    answer.verdict = Verdict::none;
    answer.remarks.push_back("A hint of \"" + words(best.trained.what) +
                             "\", too weak against the uncertainties to be named.");
    rivals.clear();
    return &nothing;
  }
  if (!rivals.empty()) {
    answer.verdict = Verdict::ambiguous;
    rivals.insert(rivals.begin(), list[0]);
    for (const std::size_t i : rivals) {
      std::vector<std::string> names;
      for (const int k : tried[i].trained.what.set) names.push_back(model.candidates()[k].name);
      if (names.empty()) names.push_back(words(tried[i].trained.what));
      answer.rivals.push_back(names);
    }
    return &best;
  }
  answer.verdict = best.trained.what.nuisance >= 0 ? Verdict::input_uncertain : Verdict::named;
  return &best;
}

void Conclusion::cross_validate(Tried& winner, const std::vector<Tried>& tried, Diagnosis& answer) {
  if (answer.verdict != Verdict::named) return;
  const Tried& nothing = *std::find_if(tried.begin(), tried.end(), [](const Tried& t) {
    return t.trained.what.set.empty() && t.trained.what.nuisance < 0;
  });
  double chi2 = 0, gain = 0;
  int n = 0, folds = 0;
  for (std::size_t c = 0; c < model.conditions().size(); ++c) {
    std::vector<bool> others = split.training, one(others.size(), false);
    bool any = false, rest = false;
    for (std::size_t s = 0; s < one.size(); ++s) {
      if (!split.training[s]) continue;
      if (model.points()[noise.series()[s][0]].condition == static_cast<int>(c))
        one[s] = any = true, others[s] = false;
      else
        rest = true;
    }
    if (!any || !rest) continue;
    Tried with = winner, without = nothing;
    for (Tried* t : {&with, &without}) {
      t->trained.fit = fit(noise, t->trained.noise, t->trained.linear, others);
      predict_held_out(weighing, noise, one, *t);
    }
    chi2 += with.chi2_held_out, n += with.points_held_out;
    gain += with.predictive - without.predictive;
    ++folds;
  }
  if (folds == 0) {
    answer.remarks.push_back("There is one condition only: what is named could not be tried on another.");
    return;
  }
  winner.chi2_held_out = chi2, winner.points_held_out = n;
  if (chi2_tail(chi2, n) < 1e-4 || gain < 0) {
    answer.verdict = Verdict::not_in_catalogue;
    answer.remarks.push_back("\"" + words(winner.trained.what) +
                             "\" does not predict conditions left out in turn (chi2/n " + rounded(chi2 / n) +
                             ").");
  }
}

void Conclusion::fill_in(const Tried& winner, Diagnosis& answer) const {
  const Weighed& w = winner.trained;
  for (std::size_t i = 0; i < w.what.set.size(); ++i) {
    const Candidate& candidate = model.candidates()[w.what.set[i]];
    const double a = w.amplitude[i], s = 1.96 * w.deviation[i];
    answer.effects.push_back({candidate.name, {a, a - s, a + s}});
  }
  Setting setting;
  for (std::size_t i = 0; i < w.what.set.size(); ++i) setting.amplitude[w.what.set[i]] = w.amplitude[i];
  if (w.what.nuisance >= 0) {
    answer.input = model.nuisances()[w.what.nuisance].name;
    const Eigen::Index last = w.fit.mean.size() - 1;
    const double x = Weighing::widening * w.fit.mean[last],
                 s = 1.96 * Weighing::widening * std::sqrt(w.fit.covariance(last, last));
    answer.input_value = {x, x - s, x + s};
    for (std::size_t e = 0; e < model.uncertain_inputs().size(); ++e) {
      const auto& input = model.uncertain_inputs()[e];
      if (input.nuisance == w.what.nuisance &&
          std::all_of(input.applies.begin(), input.applies.end(), [](bool b) { return b; }))
        setting.error[static_cast<int>(e)] = x;
    }
  }
  answer.overrides = model.choices(setting);
  for (const auto& [path, value] : model.changes(setting))
    answer.overrides.push_back(path + "=" + rounded(value, 6));
}

void Conclusion::fill_gaps(const Tried* winner, Diagnosis& answer) const {
  const auto spread = [&](const LinearModel& linear, const Eigen::MatrixXd& covariance, Eigen::Index i) {
    const Eigen::VectorXd d = linear.directions.row(i);
    double v = d.dot(covariance * d);
    for (Eigen::Index t = 0; t < linear.tolerance.cols(); ++t) v += squared(linear.tolerance(i, t));
    return v;
  };
  const LinearModel nothing = weighing.linearise({}, {}, true);
  const Eigen::MatrixXd prior =
      Eigen::MatrixXd::Identity(nothing.directions.cols(), nothing.directions.cols());
  const bool added = winner && !answer.effects.empty();
  double gap_before = 0, gap_after = 0, n = 0;
  for (std::size_t c = 0; c < model.conditions().size(); ++c) {
    Gap gap;
    gap.condition = model.conditions()[c].name;
    gap.held_out = model.conditions()[c].held_out;
    for (std::size_t p = 0; p < model.points().size(); ++p) {
      const auto i = static_cast<Eigen::Index>(p);
      if (model.points()[p].condition != static_cast<int>(c) || !std::isfinite(answer.before[p])) continue;
      const double noise2 = squared(noise.sigma(i)) + squared(model.points()[p].correlated_sigma);
      const double r0 = model.points()[p].value - answer.before[p],
                   r1 = model.points()[p].value -
                        (std::isfinite(answer.after[p]) ? answer.after[p] : answer.before[p]);
      ++gap.points;
      gap.chi2_before += r0 * r0 / noise2;
      gap.chi2_after += r1 * r1 / noise2;
      gap.deviation_before += r0 * r0 / (noise2 + spread(nothing, prior, i));
      gap.deviation_after +=
          r1 * r1 /
          (noise2 + (added ? spread(winner->trained.linear, winner->trained.fit.covariance, i)
                           : spread(nothing, prior, i)));
    }
    gap_before += gap.chi2_before, gap_after += gap.chi2_after, n += gap.points;
    const double count = std::max(gap.points, 1);
    gap.chi2_before /= count, gap.chi2_after /= count;
    gap.deviation_before = std::sqrt(gap.deviation_before / count);
    gap.deviation_after = std::sqrt(gap.deviation_after / count);
    answer.gaps.push_back(gap);
  }
  if (gap_before > n) answer.explained = std::clamp(1 - (gap_after - n) / (gap_before - n), 0.0, 1.0);
}

void Conclusion::fill_explanations(const std::vector<Tried>& tried, Diagnosis& answer) const {
  const bool outside = answer.verdict == Verdict::not_in_catalogue;
  double sum = 0, top = -1e300;
  for (const Tried& t : tried)
    if (t.trained.possible && believable(t.trained)) top = std::max(top, t.total());
  for (const Tried& t : tried)
    if (t.trained.possible && believable(t.trained)) sum += std::exp(t.total() - top);
  for (const Tried& t : tried) {
    const Weighed& w = t.trained;
    Explanation e;
    for (const int k : w.what.set) e.names.push_back(model.candidates()[k].name);
    if (w.what.nuisance >= 0) e.input = model.nuisances()[w.what.nuisance].name;
    if (!w.possible) {
      e.why_lost = "a run with it failed";
      answer.explanations.push_back(e);
      continue;
    }
    e.log_evidence = w.score;
    e.log_evidence_all = t.total();
    e.posterior = believable(w) ? std::exp(t.total() - top) / sum : 0;
    const LinearFit stated = fit(noise, stated_noise, w.linear, split.training);
    e.chi2_training = stated.chi2 / stated.points;
    e.chi2_held_out = t.points_held_out > 0 ? t.chi2_held_out / t.points_held_out : 0;
    for (std::size_t i = 0; i < w.what.set.size(); ++i)
      e.effects.push_back(
          {model.candidates()[w.what.set[i]].name,
           {w.amplitude[i], w.amplitude[i] - 1.96 * w.deviation[i], w.amplitude[i] + 1.96 * w.deviation[i]}});
    if (!believable(w))
      e.why_lost = "its fitted amplitude is not that of the published effect";
    else if ((t.total() < top - 1e-9 || outside) && leaves_a_rest(w))
      e.why_lost = rest_in_words(w);
    else if (outside)
      e.why_lost = "a law outside the catalogue is more probable";
    else if (t.total() < top - 1e-9)
      e.why_lost = "less probable by a factor of e^" + rounded(top - t.total(), 3);
    answer.explanations.push_back(e);
  }
}

void Conclusion::say(Diagnosis& answer) const {
  double before = 0, after = 0;
  int unseen = 0;
  for (const Gap& gap : answer.gaps)
    if (gap.held_out && gap.points > 0)
      before += squared(gap.deviation_before), after += squared(gap.deviation_after), ++unseen;
  std::ostringstream text;
  const auto share = [&] { return rounded(100 * answer.explained, 3) + " %"; };
  switch (answer.verdict) {
    case Verdict::named: {
      text << "Missing: ";
      for (std::size_t i = 0; i < answer.effects.size(); ++i)
        text << (i == 0 ? "" : i + 1 == answer.effects.size() ? " and " : ", ") << answer.effects[i].name;
      text << ". " << (answer.effects.size() == 1 ? "It explains " : "They explain ") << share()
           << " of the gap";
      if (unseen > 0)
        text << "; on the " << unseen << (unseen == 1 ? " condition" : " conditions")
             << (answer.effects.size() == 1 ? " it" : " they")
             << " had never seen, the disagreement falls from " << rounded(std::sqrt(before / unseen))
             << " to " << rounded(std::sqrt(after / unseen)) << " standard deviations";
      text << ".";
      break;
    }
    case Verdict::none:
      text << "Nothing is missing: the model agrees with the data within "
           << (answer.noise_scale > 1.2 ? "their scatter, which is " + rounded(answer.noise_scale) +
                                              " times the stated uncertainty."
                                        : "the stated uncertainties.");
      break;
    case Verdict::ambiguous:
      text << "The data cannot tell apart: ";
      for (std::size_t i = 0; i < answer.rivals.size(); ++i) {
        text << (i == 0 ? "" : " | ");
        for (std::size_t k = 0; k < answer.rivals[i].size(); ++k)
          text << (k == 0 ? "" : " + ") << answer.rivals[i][k];
      }
      text << ".";
      if (answer.suggestion.found)
        text << " Measure next: " << answer.suggestion.condition.name << ", where they differ by "
             << rounded(answer.suggestion.separation) << " standard deviations.";
      break;
    case Verdict::not_in_catalogue:
      text << "Something is missing that is not in the catalogue.";
      if (answer.law.found)
        text << " Inferred law, which explains " << share() << " of the gap: " << answer.law.text << ".";
      break;
    case Verdict::input_uncertain:
      text << "An input is off: " << answer.input << ", by " << rounded(answer.input_value.value)
           << " times its stated uncertainty. Correcting it explains " << share() << " of the gap.";
      break;
    case Verdict::numerics_dominate:
      text << "The numerical error is as large as the disagreement: make the time step smaller before asking "
              "what is missing.";
      break;
  }
  answer.sentence = text.str();
}

}  // namespace seedflow
