#include "seedflow/diagnose/observable_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/base/parameter_file.h"
#include "seedflow/base/units.h"
#include "seedflow/experiment/experiment.h"
#include "seedflow/output/folder.h"

namespace seedflow {

namespace {

Observer observer_of(const Problem& problem) {
  const ParameterLine line = find_parameter_line(problem.prm, problem.overrides, "Experiment");
  std::vector<std::string> able;
  for (const Experiment& experiment : experiment_catalogue()) {
    if (!experiment.observer) continue;
    able.push_back(experiment.name);
    if (experiment.name == line.value) return experiment.observer();
  }
  throw InputError(problem.prm + ": the experiment \"" + line.value +
                   "\" cannot be compared with measurements. " + suggestion(line.value, able, "experiment"));
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + ";";
  return all;
}

std::string key_of(const std::string& head, const PreparedRun::Changes& changed) {
  std::string key = head;
  for (const auto& [path, value] : changed) key += path + "=" + exact_text(value) + ";";
  return key;
}

/// Of the scatter under all conditions in that under one, in degrees of freedom.
constexpr double weight_of_other_conditions = 4;

std::string hash(const std::string& text) {
  std::uint64_t h = 14695981039346656037ull;  // FNV-1a
  for (const unsigned char c : text) h = (h ^ c) * 1099511628211ull;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(h));
  return digits;
}

/// An error about the overrides of a condition, said where the condition stands.
std::string said_of(const Condition& condition, std::string error) {
  for (const std::string& text : condition.overrides) {
    const std::string given = '"' + text + '"', as_option = "--set " + given;
    const std::size_t at = error.find(as_option);
    if (at != std::string::npos) error.replace(at, as_option.size(), given);
  }
  return (condition.where.empty() ? "" : condition.where + ": ") + "condition \"" + condition.name +
         "\": " + error;
}

}  // namespace

ObservableModel::ObservableModel(const Problem& p, RunStore& store)
    : problem(p), store(store), observer(observer_of(p)) {
  if (problem.conditions.empty()) throw InputError("The problem has no conditions.");
  identity = hash(read_file(problem.prm) + joined(problem.overrides));
  const auto checked = [&](const Condition& condition) {
    try {
      return &prepare(condition);
    } catch (const InputError& error) {
      throw InputError(said_of(condition, error.what()));
    }
  };
  for (const Condition& condition : problem.conditions) ready.push_back(checked(condition));
  for (const Condition& condition : problem.possible_experiments) checked(condition);
  step_path = ready[0]->time_step;
  read_points();
  choose_candidates();
  choose_nuisances();
  if (!observer.random_entry.empty()) n_repeats = problem.budget.repeats;
  allowed = problem.budget.runs;
  for (std::size_t c = 0; c < ready.size(); ++c)
    key_heads.push_back(key_head(problem.conditions[c], wanted[c]));
}

const PreparedRun& ObservableModel::prepare(const Condition& condition) const {
  std::vector<std::string> all = condition.overrides;
  all.insert(all.end(), problem.overrides.begin(), problem.overrides.end());
  return store.prepared(identity + joined(all), [&] { return observer.prepare(problem.prm, all); });
}

bool ObservableModel::has_entry(const std::string& path) const {
  try {
    base_value(path, 0);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

double ObservableModel::base_value(const std::string& path, int condition) const {
  return ready[condition]->value(path);
}

std::vector<std::pair<std::string, double>> ObservableModel::changes(const Setting& setting,
                                                                     int condition) const {
  return changes(setting, condition, *ready[condition]);
}

std::vector<std::pair<std::string, double>> ObservableModel::changes(const Setting& setting, int condition,
                                                                     const PreparedRun& sizes) const {
  std::map<std::string, double> values = setting.entries;
  for (const auto& [k, a] : setting.amplitude)
    for (const Candidate::Entry& e : all_candidates[k].entries) {
      const double published = e.of.empty() ? e.published : e.published * sizes.value(e.of);
      values[e.path] = e.absent + a * (published - e.absent);
    }
  const auto present = [&](const std::string& path) {
    const auto found = values.find(path);
    return found != values.end() ? found->second : base_value(path, condition);
  };
  for (const auto& [e, theta] : setting.error) {
    if (theta == 0 || !errors[e].applies[condition]) continue;
    const Nuisance& nuisance = all_nuisances[errors[e].nuisance];
    const double value = present(nuisance.path);
    values[nuisance.path] = nuisance.relative ? value * (1 + nuisance.standard_deviation * theta)
                                              : value + nuisance.standard_deviation * theta;
  }
  if (setting.step_factor != 1) values[step_path] = setting.step_factor * base_value(step_path, condition);
  return {values.begin(), values.end()};
}

std::vector<std::pair<std::string, double>> ObservableModel::changes(const Setting& setting) const {
  const bool shares = std::any_of(setting.amplitude.begin(), setting.amplitude.end(), [&](const auto& part) {
    const auto& entries = all_candidates[part.first].entries;
    return std::any_of(entries.begin(), entries.end(), [](const auto& e) { return !e.of.empty(); });
  });
  return changes(setting, 0, shares ? prepare({}) : *ready[0]);
}

std::string ObservableModel::key_head(const Condition& condition,
                                      const std::vector<WantedValue>& values) const {
  std::string what = identity + "|" + joined(condition.overrides) + "|";
  for (const WantedValue& w : values) what += w.quantity + "@" + exact_text(w.coordinate) + ",";
  return condition.name + "|" + hash(what) + "|";
}

std::vector<std::string> ObservableModel::choices(const Setting& setting) const {
  std::vector<std::string> all;
  for (const auto& [k, a] : setting.amplitude)
    if (a > 0.5) all.insert(all.end(), all_candidates[k].choices.begin(), all_candidates[k].choices.end());
  return all;
}

ObservableModel::Chosen ObservableModel::chosen(const Setting& setting, int c) {
  const std::vector<std::string> texts = choices(setting);
  if (texts.empty()) return {problem.conditions[c], ready[c], key_heads[c]};
  Chosen other{problem.conditions[c], nullptr, ""};
  other.condition.overrides.insert(other.condition.overrides.end(), texts.begin(), texts.end());
  try {
    other.model = &prepare(other.condition);
  } catch (const InputError& error) {
    other.error = error.what();
  }
  other.key_head = key_head(other.condition, wanted[c]);
  return other;
}

bool ObservableModel::may_run(const std::string& key) {
  if (asked_for.count(key)) return true;
  if (n_runs >= allowed) {
    refused = true;
    refusal.error = "the budget of runs is used up";
    return false;
  }
  ++n_runs;
  asked_for.insert(key);
  return true;
}

std::vector<PreparedRun::Changes> ObservableModel::repeated(const Setting& setting, int condition) const {
  std::vector<PreparedRun::Changes> all(n_repeats, changes(setting, condition));
  for (int r = 1; r < n_repeats; ++r)
    all[r].emplace_back(observer.random_entry, base_value(observer.random_entry, condition) + r);
  return all;
}

void ObservableModel::prepare_runs(const std::vector<Setting>& settings) {
  int size = 1;
  MPI_Comm_size(store.comm(), &size);
  if (size == 1) return;  // nothing is gained beforehand
  std::vector<RunStore::Task> tasks;
  std::unordered_set<std::string> listed;
  for (const Setting& setting : settings)
    for (std::size_t c = 0; c < ready.size(); ++c) {
      const Chosen model = chosen(setting, static_cast<int>(c));
      if (!model.model) continue;
      for (const PreparedRun::Changes& changed : repeated(setting, static_cast<int>(c))) {
        const std::string key = key_of(model.key_head, changed);
        if (!listed.insert(key).second || !may_run(key)) continue;
        tasks.push_back({key, [this, c, changed, run = model.model] {
                           return run->observe(changed, wanted[c], MPI_COMM_SELF);
                         }});
      }
    }
  store.share(tasks);
}

const RunOutcome& ObservableModel::run(const Asked& asked, const PreparedRun::Changes& changed) {
  const std::string key = key_of(asked.key_head, changed);
  if (!may_run(key)) return refusal;
  const RunOutcome& outcome =
      store.get(key, [&] { return asked.model.observe(changed, asked.values, store.comm()); });
  note(asked.condition, changed, outcome.error, outcome.seconds);
  return outcome;
}

void ObservableModel::note(const Condition& condition, const PreparedRun::Changes& changed,
                           const std::string& error, double seconds) {
  RunRecord record{
      condition.name, "./seedflow run " + problem.prm, {}, error.empty() ? "done" : error, seconds};
  const auto set = [&](const std::string& text) { record.command += " --set \"" + text + '"'; };
  for (const std::string& text : condition.overrides) set(text);
  for (const std::string& text : problem.overrides) set(text);
  for (const auto& [path, value] : changed) {
    record.overrides.push_back(path + "=" + exact_text(value));
    set(record.overrides.back());
  }
  if (listed_commands.insert(record.command).second) run_list.push_back(record);
}

Eigen::VectorXd ObservableModel::predict(const Setting& setting) {
  Eigen::VectorXd all = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(data.size()),
                                                  std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < ready.size(); ++c) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(wanted[c].size()));
    bool ok = true;
    const Chosen model = chosen(setting, static_cast<int>(c));
    if (!model.model) {
      note(model.condition, {}, model.error, 0);
      continue;
    }
    for (const PreparedRun::Changes& changed : repeated(setting, static_cast<int>(c))) {
      const RunOutcome& outcome = run({model.condition, *model.model, wanted[c], model.key_head}, changed);
      ok = ok && outcome.ok();
      for (Eigen::Index i = 0; i < sum.size() && ok; ++i) sum[i] += outcome.values[i];
    }
    for (Eigen::Index i = 0; i < sum.size() && ok; ++i)
      all[static_cast<Eigen::Index>(point_index[c][i])] = sum[i] / n_repeats;
  }
  return all;
}

Eigen::VectorXd ObservableModel::predict_condition(const Condition& condition, int like,
                                                   const Setting& setting) {
  const auto n = static_cast<Eigen::Index>(wanted[like].size());
  Condition with_choices = condition;
  for (const std::string& text : choices(setting)) with_choices.overrides.push_back(text);
  const std::string head = key_head(with_choices, wanted[like]);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
  for (const PreparedRun::Changes& changed : repeated(setting, like)) {
    const RunOutcome& outcome = run({with_choices, prepare(with_choices), wanted[like], head}, changed);
    if (!outcome.ok()) return Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
    sum += Eigen::Map<const Eigen::VectorXd>(outcome.values.data(), n);
  }
  return sum / n_repeats;
}

Eigen::VectorXd ObservableModel::regime(const std::string& name) {
  Eigen::VectorXd all = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(data.size()),
                                                  std::numeric_limits<double>::quiet_NaN());
  const auto over = std::find_if(observer.observables.begin(), observer.observables.end(),
                                 [&](const Observable& o) { return o.name == name; });
  for (std::size_t c = 0; c < ready.size(); ++c) {
    std::vector<WantedValue> values;
    std::vector<std::size_t> index;
    for (const std::size_t i : point_index[c]) {
      const auto about = std::find_if(observer.observables.begin(), observer.observables.end(),
                                      [&](const Observable& o) { return o.name == data[i].quantity; });
      if (about->coordinate != over->coordinate) continue;
      values.push_back({name, data[i].coordinate});
      index.push_back(i);
    }
    if (values.empty()) continue;
    const RunOutcome& outcome =
        run({problem.conditions[c], *ready[c], values, key_head(problem.conditions[c], values)}, {});
    for (std::size_t i = 0; i < index.size() && outcome.ok(); ++i)
      all[static_cast<Eigen::Index>(index[i])] = outcome.values[i];
  }
  return all;
}

const std::string& ObservableModel::coordinate_name(const std::string& quantity) const {
  return std::find_if(observer.observables.begin(), observer.observables.end(),
                      [&](const Observable& o) { return o.name == quantity; })
      ->coordinate;
}

std::map<std::string, std::pair<double, double>> ObservableModel::add_scatter(
    const std::vector<Setting>& settings) {
  std::map<std::string, std::pair<double, double>> range;
  if (n_repeats < 2) return range;
  struct Squares {
    double sum = 0, freedom = 0;
  };
  std::map<std::string, Squares> everywhere;
  std::map<std::pair<std::string, int>, Squares> under;
  for (const Setting& setting : settings)
    for (std::size_t c = 0; c < ready.size(); ++c) {
      const Chosen model = chosen(setting, static_cast<int>(c));
      if (!model.model) continue;
      std::vector<std::vector<double>> values;
      for (const PreparedRun::Changes& changed : repeated(setting, static_cast<int>(c))) {
        const RunOutcome& outcome = run({model.condition, *model.model, wanted[c], model.key_head}, changed);
        if (outcome.ok()) values.push_back(outcome.values);
      }
      if (values.size() < 2) continue;
      for (std::size_t i = 0; i < wanted[c].size(); ++i) {
        double mean = 0;
        for (const auto& v : values) mean += v[i] / static_cast<double>(values.size());
        for (Squares* s :
             {&everywhere[wanted[c][i].quantity], &under[{wanted[c][i].quantity, static_cast<int>(c)}]}) {
          for (const auto& v : values) s->sum += (v[i] - mean) * (v[i] - mean);
          s->freedom += static_cast<double>(values.size()) - 1;
        }
      }
    }
  for (DataPoint& point : data) {
    const auto all = everywhere.find(point.quantity);
    if (all == everywhere.end()) continue;
    const Squares& here = under[{point.quantity, point.condition}];
    const double variance = (weight_of_other_conditions * all->second.sum / all->second.freedom + here.sum) /
                            (weight_of_other_conditions + here.freedom);
    const double error = std::sqrt(variance / n_repeats);
    point.sigma = std::hypot(point.sigma, error);
    auto& [low, high] = range.try_emplace(point.quantity, error, error).first->second;
    low = std::min(low, error), high = std::max(high, error);
  }
  return range;
}

double ObservableModel::share_in_range(const std::string& effect) {
  if (!ready[0]->share_in_range) return 1;
  double sum = 0, n = 0;
  for (std::size_t c = 0; c < ready.size(); ++c) {
    const RunOutcome& outcome = store.get("in range|" + effect + "|" + key_heads[c], [&] {
      return std::vector<double>{ready[c]->share_in_range(effect)};
    });
    if (outcome.ok()) sum += outcome.values[0], ++n;
  }
  return n > 0 ? sum / n : 1;
}

std::vector<std::string> ObservableModel::idle_effects() {
  std::vector<std::string> names;
  if (!ready[0]->idle_effects) return names;
  for (std::size_t c = 0; c < ready.size(); ++c) {
    std::vector<std::string> idle;
    try {
      idle = ready[c]->idle_effects();
    } catch (const std::exception&) {
      continue;  // the run itself has failed and is on record
    }
    if (c == 0) names = idle;
    names.erase(std::remove_if(names.begin(), names.end(),
                               [&](const std::string& name) {
                                 return std::find(idle.begin(), idle.end(), name) == idle.end();
                               }),
                names.end());
  }
  return names;
}

}  // namespace seedflow
