#include "seedflow/output/summary.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/output/json.h"

namespace seedflow {

namespace {

template <class List>
auto find_name(List& list, const std::string& name) {
  return std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.name == name; });
}

}  // namespace

void Summary::text(const std::string& name, const std::string& words) {
  const auto known = std::find_if(all_texts.begin(), all_texts.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  if (known != all_texts.end())
    known->second = words;
  else
    all_texts.emplace_back(name, words);
}

void Summary::observe(const std::string& name, double value, const std::string& unit) {
  const auto known = find_name(all_observables, name);
  if (known != all_observables.end())
    *known = {name, value, unit};
  else
    all_observables.push_back({name, value, unit});
}

void Summary::conserve(const std::string& name, double relative_error, double limit) {
  const auto known = find_name(all_balances, name);
  if (known != all_balances.end())
    *known = {name, relative_error, limit};
  else
    all_balances.push_back({name, relative_error, limit});
}

double Summary::observable(const std::string& name) const {
  const auto known = find_name(all_observables, name);
  if (known != all_observables.end()) return known->value;
  std::string names;
  for (const Observable& entry : all_observables) names += (names.empty() ? "'" : ", '") + entry.name + "'";
  throw InputError("There is no observable '" + name + "'; there are " + (names.empty() ? "none" : names) +
                   ".");
}

std::vector<std::string> Summary::violations() const {
  std::vector<std::string> sentences;
  for (const Balance& balance : all_balances) {
    // Written so that NaN counts as broken.
    if (std::abs(balance.relative_error) <= balance.limit && std::isfinite(balance.relative_error)) continue;
    std::ostringstream sentence;
    sentence << balance.name << ": relative error " << balance.relative_error << ", allowed " << balance.limit
             << ".";
    sentences.push_back(sentence.str());
  }
  return sentences;
}

void Summary::require_conservation() const {
  const std::vector<std::string> broken = violations();
  if (broken.empty()) return;
  std::string message = "The run is finished but does not keep its balances:";
  for (const std::string& sentence : broken) message += "\n  " + sentence;
  throw RunError(message +
                 "\nTighten the solver tolerances or reduce the time step; the results are not to be used.");
}

void Summary::write(const std::filesystem::path& file) const {
  Json json = Json::object();
  Json& texts = json["texts"] = Json::object();
  for (const auto& [name, words] : all_texts) texts[name] = words;
  Json& observables = json["observables"] = Json::object();
  for (const Observable& entry : all_observables)
    observables[entry.name] = {{"value", entry.value}, {"unit", entry.unit}};
  Json& conservation = json["conservation"] = Json::object();
  Json& limits = json["conservation_limits"] = Json::object();
  for (const Balance& balance : all_balances) {
    conservation[balance.name] =
        std::isfinite(balance.relative_error) ? Json(balance.relative_error) : Json(nullptr);
    if (std::isfinite(balance.limit)) limits[balance.name] = balance.limit;
  }
  json["performance"] = {
      {"wall_time_s", performance.wall_time_s},
      {"peak_memory_MiB", performance.peak_memory_MiB},
      {"sub_sphere_steps_per_second_per_core", performance.sub_sphere_steps_per_second_per_core},
      {"cell_steps_per_second_per_core", performance.cell_steps_per_second_per_core}};
  write_json(file, json);
}

Summary Summary::read(const std::filesystem::path& file) {
  const Json json = read_json(file);
  const auto number = [](const Json& value) {
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
  };
  Summary summary;
  try {
    for (const auto& item : json.at("texts").items())
      summary.text(item.key(), item.value().get<std::string>());
    for (const auto& item : json.at("observables").items())
      summary.observe(item.key(), item.value().at("value").get<double>(),
                      item.value().at("unit").get<std::string>());
    const Json& limits = json.at("conservation_limits");
    for (const auto& item : json.at("conservation").items())
      summary.conserve(item.key(), number(item.value()),
                       limits.contains(item.key()) ? limits.at(item.key()).get<double>()
                                                   : std::numeric_limits<double>::infinity());
    const Json& performance = json.at("performance");
    summary.performance = {performance.at("wall_time_s").get<double>(),
                           performance.at("peak_memory_MiB").get<double>(),
                           performance.at("sub_sphere_steps_per_second_per_core").get<double>(),
                           performance.at("cell_steps_per_second_per_core").get<double>()};
  } catch (const Json::exception& error) {
    throw InputError("'" + file.string() + "' is not the summary of a run: " + error.what());
  }
  return summary;
}

double peak_memory_MiB() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB
}

double peak_memory_MiB(MPI_Comm comm) {
  const double mine = peak_memory_MiB();
  double sum = 0;
  MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  return sum;
}

}  // namespace seedflow
