#include "seedflow/diagnose/run_store.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/together.h"
#include "seedflow/base/work_counter.h"
#include "seedflow/output/folder.h"

namespace seedflow {

namespace {

std::string line_of(const std::string& key, const std::string& build, const RunOutcome& outcome) {
  const nlohmann::ordered_json record = {{"key", key},
                                         {"values", outcome.values},
                                         {"error", outcome.error},
                                         {"seconds", outcome.seconds},
                                         {"build", build}};
  return record.dump() + "\n";
}

struct Remembered {
  std::unordered_map<std::string, RunOutcome> own, others;
};

Remembered read_lines(const std::string& text, const std::string& build) {
  Remembered all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto record = nlohmann::json::parse(line, nullptr, false);
    if (record.is_discarded() || !record.contains("key")) continue;
    RunOutcome outcome;
    outcome.values = record.value("values", std::vector<double>());
    outcome.error = record.value("error", std::string());
    outcome.seconds = record.value("seconds", 0.0);
    (record.value("build", std::string()) == build ? all.own : all.others)[record["key"].get<std::string>()] =
        outcome;
  }
  return all;
}

/// The texts of all ranks, on all ranks.
std::string gathered(const std::string& mine, MPI_Comm comm) {
  int size = 1, length = static_cast<int>(mine.size());
  MPI_Comm_size(comm, &size);
  std::vector<int> lengths(size), starts(size);
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, comm);
  int total = 0;
  for (int r = 0; r < size; ++r) starts[r] = total, total += lengths[r];
  std::string all(total, ' ');
  MPI_Allgatherv(mine.data(), length, MPI_CHAR, all.data(), lengths.data(), starts.data(), MPI_CHAR, comm);
  return all;
}

}  // namespace

std::string this_build() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  if (!program) throw RunError("The program cannot read its own file /proc/self/exe.");
  std::uint64_t h = 14695981039346656037ull;  // FNV-1a, by words
  for (std::array<char, 65536> part; program.read(part.data(), part.size()) || program.gcount() > 0;)
    for (std::streamsize i = 0; i < program.gcount(); i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, part.data() + i, std::min<std::streamsize>(8, program.gcount() - i));
      h = (h ^ word) * 1099511628211ull;
    }
  return std::to_string(h);
}

RunStore::RunStore(const std::filesystem::path& folder, MPI_Comm comm, OtherBuilds others,
                   const std::string& build)
    : ranks(comm), build(build) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::string text;
  together(comm, [&] {
    if (rank != 0) return;
    prepare_output_folder(folder);
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name.rfind("runs.", 0) == 0 && entry.path().extension() == ".jsonl")
        text += read_file(entry.path()) + "\n";
    }
  });
  const Remembered all = read_lines(gathered(text, comm), build);
  outcomes = all.own;
  for (const auto& [key, outcome] : all.others) {
    if (all.own.count(key)) continue;
    ++n_other;
    if (others == OtherBuilds::use) outcomes[key] = outcome;
  }
  const std::filesystem::path path =
      folder / (rank == 0 ? "runs.jsonl" : "runs." + std::to_string(rank) + ".jsonl");
  together(comm, [&] {
    file.reset(std::fopen(path.c_str(), "a"));
    if (!file)
      throw InputError("The file '" + path.string() + "' cannot be written. Choose another --output.");
    // Ends the line that a killed process may have left open.
    if (std::filesystem::file_size(path) > 0) std::fputc('\n', file.get());
  });
}

RunStore::~RunStore() = default;

RunOutcome RunStore::make(const std::string& key, const std::function<std::vector<double>()>& run) {
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
  if (file) {
    const std::string line = line_of(key, build, outcome);
    if (std::fwrite(line.data(), 1, line.size(), file.get()) != line.size() || std::fflush(file.get()) != 0)
      throw RunError("The record of a run could not be written. Remedy: free the disk and start again.");
  }
  return outcome;
}

const RunOutcome& RunStore::get(const std::string& key, const std::function<std::vector<double>()>& run) {
  const auto found = outcomes.find(key);
  if (found != outcomes.end()) return found->second;
  const RunOutcome outcome = make(key, run);
  ++n_computed;
  return outcomes[key] = outcome;
}

void RunStore::share(const std::vector<Task>& tasks) {
  int size = 1;
  MPI_Comm_size(ranks, &size);
  std::vector<const Task*> missing;
  for (const Task& task : tasks)
    if (!remembers(task.key)) missing.push_back(&task);
  if (missing.empty()) return;
  std::string mine;
  int interrupted = 0;
  {
    WorkCounter counter(ranks);
    together(ranks, [&] {
      try {
        for (auto i = counter.next(); i < static_cast<long>(missing.size()); i = counter.next())
          mine += line_of(missing[i]->key, build, make(missing[i]->key, missing[i]->run));
      } catch (const Interrupted&) {
        interrupted = 1;  // finished runs of the other ranks are in their files
      }
    });
  }
  MPI_Allreduce(MPI_IN_PLACE, &interrupted, 1, MPI_INT, MPI_MAX, ranks);
  if (interrupted) throw Interrupted();
  for (const auto& [key, outcome] : read_lines(gathered(mine, ranks), build).own) outcomes[key] = outcome;
  n_computed += static_cast<long>(missing.size());
}

const PreparedRun& RunStore::prepared(const std::string& key, const std::function<PreparedRun()>& prepare) {
  const auto found = ready.find(key);
  return found != ready.end() ? found->second : ready[key] = prepare();
}

}  // namespace seedflow
