#include "seedflow/diagnose/inferred_law.h"

#include <algorithm>
#include <cmath>

#include "law_search.h"
#include "seedflow/base/units.h"

namespace seedflow {

namespace {

int only_group(const Law& law) {
  for (int g = 0; g < Law::n_groups; ++g)
    if (law.has[g]) return g;
  return -1;
}

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// "force along the slip = 0.4 (Reynolds number/10)^0.75 x drag, exponent between 0.56 and 0.94 (95 %)"
std::string in_words(const LawSearch::Refined& refined, const LawSearch& search) {
  const Law& law = refined.law;
  std::string product = short_text(law.coefficient), intervals;
  std::size_t i = 1;
  for (int g = 0; g < Law::n_groups; ++g) {
    if (!law.has[g]) continue;
    const double e = law.exponent[g], se = 1.96 * refined.deviation[i++];
    product +=
        std::string(" (") + Law::groups[g] + "/" + short_text(search.reference(g)) + ")^" + short_text(e);
    intervals += (intervals.empty() ? ", exponent between " : " and between ") + short_text(e - se) +
                 " and " + short_text(e + se);
  }
  return law.force_in_words() + " = " + product + " x " + law.reference() + intervals +
         (intervals.empty() ? "" : " (95 %)");
}

/// chi-square beyond the number of points by the stated uncertainties alone, inputs as they are said to be.
double plain_excess(const ObservableModel& model, const DataNoise& noise, const Eigen::VectorXd& simulated) {
  double sum = 0;
  for (std::size_t i = 0; i < model.points().size(); ++i) {
    const auto p = static_cast<Eigen::Index>(i);
    if (std::isfinite(simulated[p]))
      sum += std::pow((model.points()[i].value - simulated[p]) / noise.sigma(p), 2) - 1;
  }
  return sum;
}

/// A law that leaves more of the excess of chi-square is not worth adding.
constexpr double least_share_left = 0.5;

}  // namespace

InferredLaw infer_law(ObservableModel& model, Responses& responses, Weighing& weighing,
                      const DataNoise& noise, const Split& split, Diagnosis& answer) {
  InferredLaw found;
  if (!LawSearch::possible(model)) return found;
  LawSearch search(model, responses, weighing, noise, split);
  const std::vector<LawSearch::Screened> laws = search.screened_laws(stated_noise);
  // The best term of each of the best combinations of direction and group is refined.
  LawSearch::Refined best;
  double best_score = -1e300;
  std::vector<std::pair<int, int>> done;
  for (const auto& [law, screened] : laws) {
    const int group = only_group(law);
    if (std::find(done.begin(), done.end(), std::make_pair(law.direction, group)) != done.end()) continue;
    done.emplace_back(law.direction, group);
    const LawSearch::Refined refined = search.refine(law);
    const double score = refined.log_evidence - refined.law.price();
    if (!refined.deviation.empty() && score > best_score) best_score = score, best = refined;
    if (done.size() == 4) break;
  }
  // A second group, if the data want it.
  const bool poor = best_score > -1e300 && chi2_tail(best.chi2, best.points) < 1e-3;
  const Law first = best.law;
  for (int g = 0; g < Law::n_groups && poor && only_group(first) >= 0; ++g) {
    const bool varies =
        std::any_of(laws.begin(), laws.end(), [g](const LawSearch::Screened& l) { return l.law.has[g]; });
    if (first.has[g] || !varies) continue;
    Law law = first;
    law.has[g] = true;
    law.exponent[g] = 0.2;
    const LawSearch::Refined refined = search.refine(law);
    const double score = refined.log_evidence - refined.law.price();
    if (!refined.deviation.empty() && score > best_score) best_score = score, best = refined;
  }
  if (best_score <= -1e300) return found;
  const double excess = search.chi2_of_nothing() - best.points;
  if (best.chi2 - best.points > least_share_left * excess) {
    answer.remarks.push_back("No law of the library describes what is missing. The nearest is not added: " +
                             in_words(best, search) + ".");
    return found;
  }
  // Its numbers, with inputs as they act beside it, unless inputs then do the law's work.
  search.refine_about(best.law);
  const double gap = plain_excess(model, noise, responses.base());
  if (const LawSearch::Refined again = search.refine(best.law);
      !again.deviation.empty() &&
      plain_excess(model, noise, model.predict(search.setting(again.law))) < least_share_left * gap)
    best = again;

  const Setting setting = search.setting(best.law);
  found.found = true;
  found.direction = Law::directions[best.law.direction];
  const double c = best.law.coefficient, s = 1.96 * best.deviation[0];
  found.coefficient = {c, c - s, c + s};
  std::size_t i = 1;
  for (int g = 0; g < Law::n_groups; ++g) {
    if (!best.law.has[g]) continue;
    const double e = best.law.exponent[g], se = 1.96 * best.deviation[i++];
    found.factors.push_back({Law::groups[g], {e, e - se, e + se}});
  }
  found.text = in_words(best, search);
  const Eigen::VectorXd after = model.predict(setting);
  answer.after.assign(after.data(), after.data() + after.size());
  for (const auto& [path, value] : setting.entries)
    answer.overrides.push_back(path + "=" + exact_text(value));
  return found;
}

}  // namespace seedflow
