#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "seedflow/diagnose/benchmark.h"

namespace seedflow {

namespace {

using Names = std::set<std::string>;

Names names_of(const std::vector<NamedEffect>& effects) {
  Names names;
  for (const NamedEffect& effect : effects) names.insert(effect.name);
  return names;
}

std::string in_words(const Diagnosis& d) {
  std::string text = verdict_name(d.verdict);
  for (const NamedEffect& effect : d.effects) text += " " + effect.name + ";";
  for (const auto& rival : d.rivals) {
    text += " {";
    for (const std::string& name : rival) text += name + ";";
    text += "}";
  }
  if (!d.input.empty()) text += " " + d.input;
  if (d.law.found) text += " " + d.law.text;
  return text;
}

/// Effects whose law is the same in model and truth, so that the hidden amplitude is the one to be found.
bool same_law(const std::string& effect) {
  static const Names exact = {"Added mass", "Pressure gradient", "Rotational drag", "Faxen force"};
  return exact.count(effect) > 0;
}

/// Whether the hidden part disagrees more inside the place that was ranked first than elsewhere. Only places
/// that the data alone define: a condition, a quantity, a span of time.
void judge_place(const BenchmarkData& data, const Diagnosis& answer, BenchmarkOutcome& outcome) {
  if (answer.places.empty()) return;
  const Place& place = answer.places.front();
  double inside = 0, all = 0;
  int n_inside = 0;
  const auto& points = data.problem.measurements;
  if (place.axis != "condition" && place.axis != "quantity" && place.axis != "time") return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double square = data.disagreement[i] * data.disagreement[i];
    all += square;
    const bool in = place.axis == "condition" ? points[i].condition == place.bin
                    : place.axis == "quantity"
                        ? points[i].quantity == place.bin
                        : points[i].coordinate >= place.low && points[i].coordinate <= place.high;
    if (in) inside += square, ++n_inside;
  }
  ++outcome.places;
  outcome.place_right += n_inside > 0 && inside / n_inside > all / static_cast<double>(points.size());
}

void judge_gap(const Diagnosis& answer, BenchmarkOutcome& outcome) {
  double points = 0, before = 0, after = 0;
  for (const Gap& gap : answer.gaps)
    if (gap.held_out)
      points += gap.points, before += gap.points * gap.chi2_before, after += gap.points * gap.chi2_after;
  if (points > 0) outcome.gap_before = before / points, outcome.gap_after = after / points;
}

bool lists_both(const Diagnosis& answer, const std::vector<std::string>& rivals) {
  return answer.verdict == Verdict::ambiguous &&
         std::all_of(rivals.begin(), rivals.end(), [&](const std::string& rival) {
           return std::any_of(answer.rivals.begin(), answer.rivals.end(),
                              [&](const auto& set) { return set == std::vector<std::string>{rival}; });
         });
}

}  // namespace

BenchmarkOutcome judge(const BenchmarkCase& one, const Diagnose& diagnose, const std::filesystem::path& prm) {
  const auto start = std::chrono::steady_clock::now();
  const BenchmarkData data = benchmark_data(one.truth, one.noise, one.draw, prm);
  const Diagnosis answer = diagnose(data.problem);
  BenchmarkOutcome outcome;
  outcome.answer = in_words(answer);
  const Names hidden(one.truth.hidden.begin(), one.truth.hidden.end());
  const bool named = answer.verdict == Verdict::named;
  outcome.none = answer.verdict == Verdict::none;
  outcome.ambiguous = answer.verdict == Verdict::ambiguous;
  outcome.flagged = answer.verdict == Verdict::not_in_catalogue;
  outcome.input = answer.verdict == Verdict::input_uncertain;
  outcome.right = named && !one.truth.outside && names_of(answer.effects) == hidden;
  outcome.wrong = named && !outcome.right;
  outcome.listed = outcome.ambiguous &&
                   std::any_of(answer.rivals.begin(), answer.rivals.end(),
                               [&](const auto& set) { return Names(set.begin(), set.end()) == hidden; });
  if (!one.truth.rivals.empty()) outcome.listed = lists_both(answer, one.truth.rivals);

  if ((named || outcome.none) && !answer.explanations.empty() && !one.truth.outside) {
    outcome.confidence = answer.explanations.front().posterior;
    outcome.confidence_right = outcome.right || (outcome.none && hidden.empty());
  }
  if (outcome.right)
    for (const NamedEffect& effect : answer.effects)
      for (std::size_t i = 0; i < one.truth.hidden.size(); ++i)
        if (one.truth.hidden[i] == effect.name && same_law(effect.name)) {
          ++outcome.intervals;
          outcome.covered += effect.amplitude.low <= one.truth.amplitudes[i] &&
                             one.truth.amplitudes[i] <= effect.amplitude.high;
        }
  if (one.kind == "hidden" && outcome.right) judge_gap(answer, outcome);
  if (one.kind == "hidden" && !outcome.none) judge_place(data, answer, outcome);
  if (outcome.flagged && !one.truth.group.empty()) {
    ++outcome.exponents;
    for (const auto& factor : answer.law.factors)
      if (factor.group == one.truth.group)
        outcome.exponent_right = std::abs(factor.exponent.value - one.truth.exponent) <= 0.1,
        outcome.exponent_covered =
            factor.exponent.low <= one.truth.exponent && one.truth.exponent <= factor.exponent.high;
  }
  if (one.kind == "confounded" && outcome.ambiguous && answer.suggestion.found) {
    const BenchmarkData more =
        benchmark_data(one.truth, one.noise, one.draw, prm, {answer.suggestion.condition});
    const Diagnosis second = diagnose(more.problem);
    outcome.resolved = second.verdict == Verdict::named && names_of(second.effects) == hidden;
    outcome.answer += " -> " + answer.suggestion.condition.name + " -> " + in_words(second);
  } else if (one.kind == "confounded") {
    outcome.resolved = outcome.right;
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

}  // namespace seedflow
