#include "seedflow/diagnose/observable_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/base/parameter_file.h"
#include "seedflow/base/units.h"
#include "seedflow/effects/catalogue.h"
#include "seedflow/effects/contact_effects.h"
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

std::string where(const Measurement& m) {
  return m.line > 0 ? "measurement in line " + std::to_string(m.line) : "measurement of " + m.quantity;
}

/// Factor from a unit to the SI unit of a quantity of the same dimension.
double factor(const std::string& unit, const std::string& si_unit, const std::string& place) {
  Unit parsed;
  try {
    parsed = parse_unit(unit);
  } catch (const InputError& error) {
    throw InputError(place + ": " + error.what());
  }
  if (parsed.dimension != parse_unit(si_unit).dimension)
    throw InputError(place + ": the unit \"" + unit + "\" does not measure the same as " + si_unit + ".");
  if (parsed.offset != 0) throw InputError(place + ": a unit with an offset cannot be compared; use K.");
  return parsed.factor * std::pow(10.0, parsed.exponent);
}

const Observable& find_observable(const Observer& observer, const Measurement& m) {
  std::vector<std::string> names;
  for (const Observable& o : observer.observables) {
    if (o.name == m.quantity) return o;
    names.push_back(o.name);
  }
  throw InputError(where(m) + ": the experiment produces no quantity \"" + m.quantity + "\". " +
                   suggestion(m.quantity, names, "quantity"));
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + ";";
  return all;
}

std::string hash(const std::string& text) {
  std::uint64_t h = 14695981039346656037ull;  // FNV-1a
  for (const unsigned char c : text) h = (h ^ c) * 1099511628211ull;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(h));
  return digits;
}

}  // namespace

ObservableModel::ObservableModel(const Problem& p, RunStore& store)
    : problem(p), store(store), observer(observer_of(p)) {
  if (problem.conditions.empty()) throw InputError("The problem has no conditions.");
  identity = hash(read_file(problem.prm) + joined(problem.overrides));
  for (const Condition& condition : problem.conditions) {
    try {
      ready.push_back(&prepare(condition));
    } catch (const InputError& error) {
      throw InputError("condition \"" + condition.name + "\": " + error.what());
    }
  }
  step_path = ready[0]->time_step;
  read_points();
  choose_candidates();
  choose_nuisances();
}

void ObservableModel::read_points() {
  const std::size_t n = problem.conditions.size();
  wanted.resize(n);
  point_index.resize(n);
  std::map<std::pair<int, std::string>, int> series;
  std::set<std::tuple<int, std::string, double>> seen;
  for (const Measurement& m : problem.measurements) {
    const auto found = std::find_if(problem.conditions.begin(), problem.conditions.end(),
                                    [&](const Condition& c) { return c.name == m.condition; });
    if (found == problem.conditions.end()) {
      std::vector<std::string> names;
      for (const Condition& c : problem.conditions) names.push_back(c.name);
      throw InputError(where(m) + ": there is no condition \"" + m.condition + "\". " +
                       suggestion(m.condition, names, "condition"));
    }
    const Observable& about = find_observable(observer, m);
    if (m.unit.empty()) throw InputError(where(m) + ": " + m.quantity + " has no unit.");
    const double scale = factor(m.unit, about.unit, where(m) + ", " + m.quantity);
    DataPoint point;
    point.condition = static_cast<int>(found - problem.conditions.begin());
    point.quantity = m.quantity;
    point.unit_scale = scale;
    point.value = scale * m.value;
    point.sigma = scale * m.standard_uncertainty;
    point.correlated_sigma = scale * m.correlated_uncertainty;
    point.coordinate = std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(m.value)) throw InputError(where(m) + ": the value is not a finite number.");
    if (!(m.standard_uncertainty > 0) || !std::isfinite(m.standard_uncertainty))
      throw InputError(where(m) + ": the standard uncertainty must be positive and finite.");
    if (!about.coordinate.empty()) {
      if (!std::isfinite(m.coordinate) || m.coordinate_unit.empty())
        throw InputError(where(m) + ": " + m.quantity + " needs its " + about.coordinate +
                         " as coordinate, in " + about.coordinate_unit + ".");
      const double c = factor(m.coordinate_unit, about.coordinate_unit, where(m) + ", coordinate");
      point.coordinate = c * m.coordinate;
      point.correlation_length = c * m.correlation_length;
    } else if (std::isfinite(m.coordinate)) {
      throw InputError(where(m) + ": " + m.quantity + " has no coordinate; leave it and its unit empty.");
    }
    point.series =
        series.try_emplace({point.condition, m.quantity}, static_cast<int>(series.size())).first->second;
    point_index[point.condition].push_back(data.size());
    wanted[point.condition].push_back({m.quantity, std::isfinite(point.coordinate) ? point.coordinate : 0});
    data.push_back(point);
  }
  series_count = static_cast<int>(series.size());
  for (std::size_t c = 0; c < n; ++c)
    if (wanted[c].empty())
      throw InputError("nothing was measured under the condition \"" + problem.conditions[c].name +
                       "\". Remove it or add its measurements.");
}

void ObservableModel::choose_candidates() {
  all_candidates = problem.candidates;
  if (all_candidates.empty()) {
    std::vector<std::string> names;
    // One realisation of a random effect is no signature; it can still be asked for by name.
    for (const EffectDefinition& effect : effect_catalogue())
      if (!effect.record.random) names.push_back(effect.record.name);
    for (const EffectRecord& record : contact_effect_records()) names.push_back(record.name);
    for (const std::string& name : names) {
      const std::string path = "Effects/" + name + "/Strength";
      if (name == "Inferred law" || !has_entry(path)) continue;
      if (base_value(path, 0) == 0) all_candidates.push_back({name, {{path, 0, 1}}});
    }
  }
  for (const Candidate& candidate : all_candidates)
    for (const Candidate::Entry& entry : candidate.entries) base_value(entry.path, 0);
  if (all_candidates.empty())
    throw InputError("There is no candidate: every effect of the catalogue is on in the base model.");
}

void ObservableModel::choose_nuisances() {
  all_nuisances = problem.nuisances;
  if (all_nuisances.empty())
    for (const UsualUncertainty& u : observer.uncertainties)
      all_nuisances.push_back({u.name, u.path, u.standard_deviation, u.relative, u.each_condition});
  const std::size_t n = problem.conditions.size();
  for (std::size_t k = 0; k < all_nuisances.size(); ++k) {
    const Nuisance& nuisance = all_nuisances[k];
    if (!(nuisance.standard_deviation > 0) || !std::isfinite(nuisance.standard_deviation))
      throw InputError("The uncertainty of \"" + nuisance.path + "\" must be positive.");
    std::map<double, std::size_t> group;
    for (std::size_t c = 0; c < n; ++c) {
      const double value = base_value(nuisance.path, static_cast<int>(c));
      const double key = nuisance.each_condition ? static_cast<double>(c) : value;
      const auto [found, fresh] = group.try_emplace(key, errors.size());
      if (fresh) errors.push_back({static_cast<int>(k), std::vector<bool>(n, false)});
      errors[found->second].applies[c] = true;
    }
  }
}

const PreparedRun& ObservableModel::prepare(const Condition& condition) {
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
  std::map<std::string, double> values = setting.entries;
  for (const auto& [k, a] : setting.amplitude)
    for (const Candidate::Entry& e : all_candidates[k].entries)
      values[e.path] = e.absent + a * (e.published - e.absent);
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

const RunOutcome& ObservableModel::run(const Condition& condition, const PreparedRun& model,
                                       const std::vector<std::pair<std::string, double>>& changed,
                                       const std::vector<WantedValue>& values) {
  ++n_runs;
  std::string what;
  for (const WantedValue& w : values) what += w.quantity + "@" + exact_text(w.coordinate) + ",";
  std::string key = identity + "|" + joined(condition.overrides) + "|";
  for (const auto& [path, value] : changed) key += path + "=" + exact_text(value) + ";";
  key += "|" + hash(what);
  const RunOutcome& outcome = store.get(key, [&] { return model.observe(changed, values); });
  if (!outcome.ok()) {
    RunRecord record{condition.name, {}, outcome.error, outcome.seconds};
    for (const auto& [path, value] : changed) record.overrides.push_back(path + "=" + exact_text(value));
    const bool known = std::any_of(failed.begin(), failed.end(), [&](const RunRecord& r) {
      return r.condition == record.condition && r.overrides == record.overrides;
    });
    if (!known) failed.push_back(record);
  }
  return outcome;
}

Eigen::VectorXd ObservableModel::predict(const Setting& setting) {
  Eigen::VectorXd all = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(data.size()),
                                                  std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < ready.size(); ++c) {
    const RunOutcome& outcome =
        run(problem.conditions[c], *ready[c], changes(setting, static_cast<int>(c)), wanted[c]);
    if (!outcome.ok()) continue;
    for (std::size_t i = 0; i < point_index[c].size(); ++i)
      all[static_cast<Eigen::Index>(point_index[c][i])] = outcome.values[i];
  }
  return all;
}

Eigen::VectorXd ObservableModel::predict_condition(const Condition& condition, int like,
                                                   const Setting& setting) {
  const RunOutcome& outcome = run(condition, prepare(condition), changes(setting, like), wanted[like]);
  if (!outcome.ok())
    return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(wanted[like].size()),
                                     std::numeric_limits<double>::quiet_NaN());
  return Eigen::Map<const Eigen::VectorXd>(outcome.values.data(),
                                           static_cast<Eigen::Index>(outcome.values.size()));
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
    const RunOutcome& outcome = run(problem.conditions[c], *ready[c], {}, values);
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
