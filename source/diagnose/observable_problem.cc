// What an observable model is asked about: points in SI units, candidates, uncertain inputs.

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/base/units.h"
#include "seedflow/diagnose/candidate.h"
#include "seedflow/diagnose/observable_model.h"
#include "seedflow/effects/device_effects.h"

namespace seedflow {

namespace {

std::string where(const Measurement& m) {
  return m.file.empty() ? "measurement of " + m.quantity : m.where();
}

/// "d.prm:5: Candidates: "
std::string where(const Problem& problem, const std::string& entry) {
  const auto found = problem.where.find(entry);
  return (found == problem.where.end() ? "" : found->second + ": ") + entry + ": ";
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

/// Errors: InputError if no run has the measurement's coordinate [SI].
void require_inside(const CoordinateRange& range, const Measurement& m, const Observable& about,
                    double coordinate) {
  // Printed times are rounded.
  const double slack = 1e-9 * std::max(std::abs(range.low), std::abs(range.high));
  const bool inside = coordinate >= range.low - (std::isfinite(slack) ? slack : 0) &&
                      coordinate <= range.high + (std::isfinite(slack) ? slack : 0);
  if (inside && (!range.whole || coordinate == std::round(coordinate))) return;
  const std::string unit = about.coordinate_unit == "1" ? "" : " " + about.coordinate_unit;
  std::string allowed = range.whole ? "a whole number" : "";
  if (std::isfinite(range.low)) allowed += " from " + exact_text(range.low);
  if (std::isfinite(range.high)) allowed += " to " + exact_text(range.high);
  throw InputError(where(m) + ": " + m.quantity + " at " + about.coordinate + " " + exact_text(coordinate) +
                   unit + ": no run under the condition \"" + m.condition + "\" has it. Allowed: " +
                   allowed.substr(allowed.front() == ' ') + unit + ". " + range.remedy);
}

/// Errors: InputError at `place` if the entry does not exist or is no number, or the unit is not one of it.
void require_entry(const PreparedRun& run, const std::string& path, const std::string& unit,
                   const std::string& place) {
  try {
    const std::string si = run.unit ? run.unit(path) : "";  // knows the nearest entry, where there is none
    run.value(path);
    if (unit.empty() || unit == "%" || !run.unit) return;
    factor(unit, si.empty() ? "1" : si, "\"" + path + "\"");
  } catch (const InputError& error) {
    throw InputError(place + error.what());
  }
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

}  // namespace

void ObservableModel::read_points() {
  const std::size_t n = problem.conditions.size();
  wanted.resize(n);
  point_index.resize(n);
  std::map<std::pair<int, std::string>, int> series;
  std::map<std::pair<int, std::string>, CoordinateRange> ranges;
  std::set<std::string> seen;
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
    const std::string of_correlated = m.correlated_where + ", correlated part of " + m.quantity;
    point.correlated_sigma =
        m.correlated_uncertainty *
        (m.correlated_unit.empty() ? scale : factor(m.correlated_unit, about.unit, of_correlated));
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
      const std::string& unit = m.correlated_coordinate_unit;
      point.correlation_length =
          m.correlation_length * (unit.empty() ? c : factor(unit, about.coordinate_unit, of_correlated));
      if (const auto& range = ready[point.condition]->range) {
        const auto [known, fresh] = ranges.try_emplace({point.condition, m.quantity});
        if (fresh) known->second = range(m.quantity);
        require_inside(known->second, m, about, point.coordinate);
      }
    } else if (std::isfinite(m.coordinate)) {
      throw InputError(where(m) + ": " + m.quantity + " has no coordinate; leave it and its unit empty.");
    }
    // Ten digits: units are converted, the last digit is round-off.
    std::ostringstream key;
    key.precision(10);
    key << point.condition << m.quantity << " " << point.coordinate << " " << point.value;
    if (!seen.insert(key.str()).second)
      throw InputError(where(m) + ": this point stands in the file twice. Take one of them out.");
    point.series =
        series.try_emplace({point.condition, m.quantity}, static_cast<int>(series.size())).first->second;
    point_index[point.condition].push_back(data.size());
    wanted[point.condition].push_back({m.quantity, std::isfinite(point.coordinate) ? point.coordinate : 0});
    data.push_back(point);
  }
  series_count = static_cast<int>(series.size());
  for (std::size_t c = 0; c < n; ++c)
    if (wanted[c].empty())
      throw InputError((problem.conditions[c].where.empty() ? "" : problem.conditions[c].where + ": ") +
                       "nothing was measured under the condition \"" + problem.conditions[c].name +
                       "\". Remove it or add its measurements.");
  if (std::all_of(problem.conditions.begin(), problem.conditions.end(),
                  [](const Condition& c) { return c.held_out; }))
    throw InputError((problem.conditions[0].where.empty() ? "" : problem.conditions[0].where + ": ") +
                     "no condition is left to train on, all are held out. Write held_out = no for at least "
                     "one.");
}

bool ObservableModel::is_off(const EffectRecord& effect) const {
  const Candidate candidate = candidate_of(effect);
  try {
    if (candidate.entries.empty())
      return ready[0]->text && ready[0]->text(effect.entry.path) == effect.entry.absent;
    const Candidate::Entry& entry = candidate.entries[0];
    return base_value(entry.path, 0) == entry.absent && (entry.of.empty() || base_value(entry.of, 0) != 0);
  } catch (const InputError&) {
    return false;  // the model has no such entry
  }
}

void ObservableModel::choose_candidates() {
  all_candidates = problem.candidates;
  if (all_candidates.empty()) {
    // One realisation of a random effect is no signature; it can still be asked for by name.
    for (const EffectRecord& record : all_effect_records())
      if (!record.random && record.name != "Inferred law" && is_off(record))
        all_candidates.push_back(candidate_of(record));
  }
  for (const Candidate& candidate : all_candidates)
    for (const Candidate::Entry& entry : candidate.entries)
      for (const std::string& path : {entry.path, entry.of})
        if (!path.empty()) require_entry(*ready[0], path, entry.unit, where(problem, "Candidates"));
  if (all_candidates.empty())
    throw InputError("There is no candidate: every effect of the catalogue is on in the base model.");
}

void ObservableModel::choose_nuisances() {
  all_nuisances = problem.nuisances;
  for (const Nuisance& nuisance : all_nuisances)
    require_entry(*ready[0], nuisance.path, nuisance.unit, where(problem, "Nuisances"));
  if (all_nuisances.empty())
    for (const std::vector<UsualUncertainty>* usual :
         {&std::as_const(observer).uncertainties, &ready[0]->uncertainties})
      for (const UsualUncertainty& u : *usual)
        all_nuisances.push_back({u.name, u.path, u.standard_deviation, u.relative, u.each_condition});
  const std::size_t n = problem.conditions.size();
  for (std::size_t k = 0; k < all_nuisances.size(); ++k) {
    const Nuisance& nuisance = all_nuisances[k];
    if (!(nuisance.standard_deviation > 0) || !std::isfinite(nuisance.standard_deviation))
      throw InputError("The uncertainty of \"" + nuisance.path + "\" must be positive.");
    bool acts = !nuisance.relative;
    for (std::size_t c = 0; c < n; ++c) acts = acts || base_value(nuisance.path, static_cast<int>(c)) != 0;
    if (!acts && !problem.nuisances.empty())
      throw InputError(where(problem, "Nuisances") + "\"" + nuisance.path +
                       "\" is 0 under every condition, and a share of 0 is nothing. Write the uncertainty in "
                       "the entry's unit, or leave it out.");
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

}  // namespace seedflow
