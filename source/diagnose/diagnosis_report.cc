#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "seedflow/diagnose/diagnosis_files.h"
#include "seedflow/output/report.h"

namespace seedflow {

namespace {

std::string name_of(const Explanation& e) {
  if (!e.input.empty()) return e.input + " off";
  if (e.names.empty()) return "nothing missing";
  std::string text;
  for (const std::string& name : e.names) text += (text.empty() ? "" : " + ") + name;
  return text;
}

std::string in_words(const Place& place) {
  return place.axis == "condition" ? place.bin : place.axis + " " + place.bin;
}

void add_places(const Diagnosis& answer, Report& report) {
  report.heading("Where measured and simulated values differ");
  Table table{"Places, the most striking first",
              {"axis", "place", "excess [standard deviations]", "p (permutation)"}};
  BarPlot plot{"Where they differ", {}, {"excess of chi-square", "standard deviations"}};
  BarSeries bars{"excess", {}};
  for (std::size_t i = 0; i < std::min<std::size_t>(answer.places.size(), 10); ++i) {
    const Place& p = answer.places[i];
    table.rows.push_back({p.axis, p.bin, Table::number(p.statistic, 3), Table::number(p.p_value, 2)});
    if (i < 6) plot.groups.push_back(in_words(p)), bars.values.push_back(p.statistic);
  }
  if (answer.places.empty()) {
    report.paragraph("There is one bin only.");
    return;
  }
  plot.series.push_back(bars);
  plot.caption = "How much the squared differences in a bin exceed what the uncertainties allow.";
  report.paragraph(answer.places[0].p_value < 0.05
                       ? "They differ most at " + in_words(answer.places[0]) + "."
                       : "No place stands out against the others: where they differ, they do so everywhere.");
  report.add(plot);
  table.note =
      "p: how often chance alone would make some place stand out as much against the others; near 1 where "
      "all "
      "places are alike.";
  report.add(table);
}

void add_explanations(const Diagnosis& answer, Report& report) {
  report.heading("What was weighed, and why each lost");
  Table table{"Explanations",
              {"explanation", "probability", "log evidence", "chi2/n training", "chi2/n held out",
               "amplitudes (95 %)", "why it lost"}};
  BarPlot plot{"Log evidence against the best", {}, {"log evidence behind the best", "1"}};
  BarSeries bars{"behind", {}};
  for (std::size_t i = 0; i < std::min<std::size_t>(answer.explanations.size(), 30); ++i) {
    const Explanation& e = answer.explanations[i];
    std::string amplitudes;
    for (const NamedEffect& a : e.effects)
      amplitudes += (amplitudes.empty() ? "" : "; ") + Table::number(a.amplitude.value, 3) + " (" +
                    Table::number(a.amplitude.low, 3) + " to " + Table::number(a.amplitude.high, 3) + ")";
    table.rows.push_back({name_of(e), Table::number(e.posterior, 3), Table::number(e.log_evidence_all, 5),
                          Table::number(e.chi2_training, 3),
                          e.chi2_held_out > 0 ? Table::number(e.chi2_held_out, 3) : "–", amplitudes,
                          e.why_lost});
    if (i < 8) {
      plot.groups.push_back(name_of(e));
      bars.values.push_back(answer.explanations[0].log_evidence_all - e.log_evidence_all);
    }
  }
  table.note =
      "Probability: among the explanations of this table. Log evidence includes the price of naming one "
      "effect "
      "out of many. chi2/n counts the uncertainty of "
      "inputs, fit and numerics.";
  plot.series.push_back(bars);
  plot.caption = "Every unit is a factor of e in probability.";
  report.add(plot);
  report.add(table);
  for (const auto& group : answer.classes) {
    std::string names;
    for (const std::string& name : group) names += (names.empty() ? "" : ", ") + name;
    report.paragraph("Alike in these measurements (known before fitting): " + names + ".");
  }
}

/// Disagreement of every condition, training first.
void add_gaps(const Diagnosis& answer, Report& report) {
  constexpr std::size_t most = 16;
  const bool changed = !answer.effects.empty() || !answer.input.empty() || answer.law.found;
  BarPlot plot{"Disagreement by condition", {}, {"rms difference", "standard deviations"}};
  BarSeries before{"before", {}}, after{"after", {}};
  for (const bool held_out : {false, true})
    for (const Gap& g : answer.gaps) {
      if (g.held_out != held_out || g.points == 0 || plot.groups.size() == most) continue;
      plot.groups.push_back(g.condition + (held_out ? ", never seen" : ""));
      before.values.push_back(g.deviation_before), after.values.push_back(g.deviation_after);
    }
  if (plot.groups.empty()) return;
  plot.series = {before};
  if (changed) plot.series.push_back(after);
  plot.horizontal = {{1, "what the uncertainties allow"}};
  plot.caption = "Standard deviations of measurement and inputs together; about 1 or less is agreement.";
  report.add(plot);
}

void add_before_and_after(const Problem& problem, const Diagnosis& answer, Report& report) {
  report.heading("Before and after");
  add_gaps(answer, report);
  for (const bool held_out : {false, true}) {
    Table table{held_out ? "Conditions never seen" : "Training conditions",
                {"condition", "points", "chi2/n before", "chi2/n after", "deviation before [sd]",
                 "deviation after [sd]"}};
    for (const Gap& g : answer.gaps)
      if (g.held_out == held_out)
        table.rows.push_back({g.condition, std::to_string(g.points), Table::number(g.chi2_before, 3),
                              Table::number(g.chi2_after, 3), Table::number(g.deviation_before, 3),
                              Table::number(g.deviation_after, 3)});
    table.note =
        "chi2/n: by the uncertainty of the measurement alone. Deviation: by that of measurement, inputs and "
        "fit.";
    if (!table.rows.empty()) report.add(table);
  }
  // One plot per condition and quantity, training first.
  int plots = 0;
  for (const bool held_out : {false, true})
    for (const Condition& condition : problem.conditions) {
      if (condition.held_out != held_out) continue;
      std::map<std::string, std::vector<std::size_t>> by_quantity;
      for (std::size_t i = 0; i < problem.measurements.size(); ++i)
        if (problem.measurements[i].condition == condition.name &&
            std::isfinite(problem.measurements[i].coordinate) && std::isfinite(answer.before[i]))
          by_quantity[problem.measurements[i].quantity].push_back(i);
      for (auto& [quantity, at] : by_quantity) {
        if (++plots > 12) return;
        std::sort(at.begin(), at.end(), [&](std::size_t a, std::size_t b) {
          return problem.measurements[a].coordinate < problem.measurements[b].coordinate;
        });
        const Measurement& first = problem.measurements[at[0]];
        LineSeries measured{"measured", {}, {}}, before{"before", {}, {}}, after{"after", {}, {}};
        double low = 1e300, high = -1e300;
        for (const std::size_t i : at) {
          const Measurement& m = problem.measurements[i];
          // Simulated values are in SI, the plot in the unit of the measurement.
          const double scale = answer.unit_scale[i];
          for (LineSeries* s : {&measured, &before, &after}) s->x.push_back(m.coordinate);
          measured.y.push_back(m.value);
          measured.error.push_back(m.standard_uncertainty);
          before.y.push_back(answer.before[i] / scale);
          after.y.push_back(answer.after[i] / scale);
          low = std::min(low, m.coordinate), high = std::max(high, m.coordinate);
        }
        measured.draw = LineSeries::Draw::markers;
        Axis x{first.coordinate_unit == "s" ? "time" : "coordinate", first.coordinate_unit};
        x.logarithmic = low > 0 && high > 1000 * low;
        LinePlot plot{condition.name + (held_out ? ", never seen" : ", training"), x, {quantity, first.unit}};
        plot.y.logarithmic = x.logarithmic && *std::min_element(measured.y.begin(), measured.y.end()) > 0;
        if (plot.y.logarithmic) measured.error.clear();
        plot.series = {measured, before, after};
        report.add(plot);
      }
    }
}

}  // namespace

void write_diagnosis_report(const std::filesystem::path& file, const Problem& problem,
                            const Diagnosis& answer, const std::string& command) {
  Report report("Diagnosis: " + problem.name, command, "seedflow");
  report.lead("Which effect is missing between the model `" +
              std::filesystem::path(problem.prm).filename().string() + "` and " +
              std::to_string(problem.measurements.size()) + " measured values under " +
              std::to_string(problem.conditions.size()) + " conditions?");
  // The box says how model and data stand to each other: only NONE is agreement.
  report.verdict(answer.verdict == Verdict::none               ? Report::Verdict::agrees
                 : answer.verdict == Verdict::named            ? Report::Verdict::neutral
                 : answer.verdict == Verdict::not_in_catalogue ? Report::Verdict::disagrees
                                                               : Report::Verdict::doubtful,
                 "**" + verdict_name(answer.verdict) + ".** " + answer.sentence);
  if (!answer.effects.empty()) {
    Table table{"Found", {"effect", "amplitude", "from (95 %)", "to (95 %)"}};
    for (const NamedEffect& e : answer.effects)
      table.rows.push_back({e.name, Table::number(e.amplitude.value, 3), Table::number(e.amplitude.low, 3),
                            Table::number(e.amplitude.high, 3)});
    table.note = "Amplitude 1: the published coefficients.";
    report.add(table);
  }
  if (!answer.remarks.empty()) report.list(answer.remarks);
  if (answer.suggestion.found) {
    report.heading("What to measure next");
    std::string entries;
    for (const std::string& text : answer.suggestion.condition.overrides)
      entries += (entries.empty() ? "" : "; ") + text;
    report.paragraph(answer.suggestion.condition.name + " (" + entries +
                     "), at the same coordinates: the explanations differ there by " +
                     Table::number(answer.suggestion.separation, 2) + " standard deviations.");
  }
  add_places(answer, report);
  add_explanations(answer, report);
  add_before_and_after(problem, answer, report);
  Table failed{"Runs that failed", {"condition", "entries", "why"}};
  int of_laws = 0;
  for (const RunRecord& r : answer.run_list) {
    if (r.status == "done") continue;
    std::string entries;
    for (const std::string& text : r.overrides) entries += (entries.empty() ? "" : "; ") + text;
    if (entries.find("Effects/Inferred law/") != std::string::npos)
      ++of_laws;
    else
      failed.rows.push_back({r.condition, entries, r.status});
  }
  if (!failed.rows.empty()) report.add(failed);
  report.paragraph("diagnosis.json lists all " + std::to_string(answer.run_list.size()) +
                   " runs, each with the command that makes it" +
                   (of_laws > 0 ? "; " + std::to_string(of_laws) +
                                      " with laws on trial did not go through, which rules those laws out."
                                : "."));
  report.write(file);
}

}  // namespace seedflow
