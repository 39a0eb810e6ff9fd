#include "seedflow/diagnose/diagnosis_files.h"

#include <nlohmann/json.hpp>

#include "seedflow/base/error.h"
#include "seedflow/base/parameter_file.h"
#include "seedflow/experiment/experiment.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/json.h"

namespace seedflow {

namespace {

Json as_json(const Interval& x) {
  return {{"value", x.value}, {"low", x.low}, {"high", x.high}};
}

Json as_json(const std::vector<NamedEffect>& effects) {
  Json list = Json::array();
  for (const NamedEffect& e : effects)
    list.push_back({{"name", e.name}, {"amplitude", as_json(e.amplitude)}});
  return list;
}

}  // namespace

void write_diagnosis(const std::filesystem::path& file, const Problem& problem, const Diagnosis& answer) {
  Json all;
  all["name"] = problem.name;
  all["verdict"] = verdict_name(answer.verdict);
  all["sentence"] = answer.sentence;
  all["effects"] = as_json(answer.effects);
  all["rivals"] = answer.rivals;
  if (!answer.input.empty())
    all["input"] = {{"name", answer.input}, {"standard_uncertainties", as_json(answer.input_value)}};
  if (answer.suggestion.found)
    all["suggested_experiment"] = {{"condition", answer.suggestion.condition.name},
                                   {"overrides", answer.suggestion.condition.overrides},
                                   {"separation", answer.suggestion.separation}};
  if (answer.law.found) {
    Json factors = Json::array();
    for (const auto& f : answer.law.factors)
      factors.push_back({{"group", f.group}, {"exponent", as_json(f.exponent)}});
    all["inferred_law"] = {{"direction", answer.law.direction},
                           {"coefficient", as_json(answer.law.coefficient)},
                           {"factors", factors},
                           {"text", answer.law.text}};
  }
  all["explained"] = answer.explained;
  all["noise_scale"] = answer.noise_scale;
  Json explanations = Json::array();
  for (const Explanation& e : answer.explanations)
    explanations.push_back({{"effects", e.names},
                            {"input", e.input},
                            {"posterior", e.posterior},
                            {"log_evidence_training", e.log_evidence},
                            {"log_evidence", e.log_evidence_all},
                            {"chi2_training", e.chi2_training},
                            {"chi2_held_out", e.chi2_held_out},
                            {"amplitudes", as_json(e.effects)},
                            {"why_lost", e.why_lost}});
  all["explanations"] = explanations;
  all["indistinguishable"] = answer.classes;
  Json places = Json::array();
  for (const Place& p : answer.places)
    places.push_back({{"axis", p.axis},
                      {"bin", p.bin},
                      {"low", p.low},
                      {"high", p.high},
                      {"statistic", p.statistic},
                      {"p_value", p.p_value}});
  all["places"] = places;
  Json gaps = Json::array();
  for (const Gap& g : answer.gaps)
    gaps.push_back({{"condition", g.condition},
                    {"held_out", g.held_out},
                    {"points", g.points},
                    {"chi2_before", g.chi2_before},
                    {"chi2_after", g.chi2_after},
                    {"deviation_before", g.deviation_before},
                    {"deviation_after", g.deviation_after}});
  all["conditions"] = gaps;
  all["remarks"] = answer.remarks;
  all["overrides"] = answer.overrides;
  Json runs = Json::array();
  for (const RunRecord& r : answer.run_list)
    runs.push_back(
        {{"condition", r.condition}, {"command", r.command}, {"status", r.status}, {"seconds", r.seconds}});
  all["runs"] = runs;
  all["runs_asked"] = answer.runs;
  all["runs_computed"] = answer.runs_computed;
  write_json(file, all);
}

void write_diagnosed_model(const std::filesystem::path& file, const Problem& problem,
                           const Diagnosis& answer) {
  const ParameterLine line = find_parameter_line(problem.prm, problem.overrides, "Experiment");
  for (const Experiment& experiment : experiment_catalogue()) {
    if (experiment.name != line.value || !experiment.observer) continue;
    // Without conditions: the base model, as the conditions change it.
    const PreparedRun base = experiment.observer().prepare(problem.prm, problem.overrides);
    if (!base.parameters_text) return;
    std::string head = "# " + answer.sentence + "\n";
    write_file_atomically(file, head + base.parameters_text(answer.overrides));
  }
}

}  // namespace seedflow
