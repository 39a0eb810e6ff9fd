#include "seedflow/diagnose/run_store.h"

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/together.h"
#include "seedflow/output/folder.h"

namespace seedflow {

RunStore::RunStore(const std::filesystem::path& folder, MPI_Comm comm) {
  const std::filesystem::path path = folder / "runs.jsonl";
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::string text;
  together(comm, [&] {
    if (rank != 0) return;
    prepare_output_folder(folder);
    if (std::filesystem::exists(path)) text = read_file(path);
    file.reset(std::fopen(path.c_str(), "a"));
    if (!file)
      throw InputError("The file '" + path.string() + "' cannot be written. Choose another --output.");
    // Ends the line that a killed process left open.
    if (!text.empty() && text.back() != '\n') std::fputc('\n', file.get());
  });
  unsigned long size = text.size();
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG, 0, comm);
  text.resize(size);
  MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, 0, comm);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto record = nlohmann::json::parse(line, nullptr, false);
    if (record.is_discarded() || !record.contains("key")) continue;
    RunOutcome outcome;
    outcome.values = record.value("values", std::vector<double>());
    outcome.error = record.value("error", std::string());
    outcome.seconds = record.value("seconds", 0.0);
    outcomes[record["key"].get<std::string>()] = outcome;
  }
}

RunStore::~RunStore() = default;

const RunOutcome& RunStore::get(const std::string& key, const std::function<std::vector<double>()>& run) {
  const auto found = outcomes.find(key);
  if (found != outcomes.end()) return found->second;
  RunOutcome outcome;
  const auto begin = std::chrono::steady_clock::now();
  try {
    outcome.values = run();
    for (const double value : outcome.values)
      if (!std::isfinite(value)) outcome.error = "a value of the run is not a finite number";
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    outcome.error = error.what();
  }
  if (!outcome.ok()) outcome.values.clear();
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ++n_computed;
  if (file) {
    const nlohmann::ordered_json record = {
        {"key", key}, {"values", outcome.values}, {"error", outcome.error}, {"seconds", outcome.seconds}};
    const std::string line = record.dump() + "\n";
    if (std::fwrite(line.data(), 1, line.size(), file.get()) != line.size() || std::fflush(file.get()) != 0)
      throw RunError("The record of a run could not be written. Remedy: free the disk and start again.");
  }
  return outcomes[key] = outcome;
}

const PreparedRun& RunStore::prepared(const std::string& key, const std::function<PreparedRun()>& prepare) {
  const auto found = ready.find(key);
  return found != ready.end() ? found->second : ready[key] = prepare();
}

}  // namespace seedflow
