#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "seedflow/experiment/observation.h"

namespace seedflow {

/// What came out of one run of one condition.
struct RunOutcome {
  std::vector<double> values;  ///< empty if it failed
  std::string error;           ///< why it failed, or ""
  double seconds = 0;
  bool ok() const { return error.empty(); }
};

/// Tells this build of the program from others: a hash of the running executable.
std::string this_build();

/// Runs that another build of the program made.
enum class OtherBuilds { ignore, use };

/// Remembers every run, so that none is made twice: in memory, and in a file of the given folder, from which
/// an interrupted diagnosis goes on. The file holds one line per finished run (JSON: key, values, error,
/// build, seconds); a line cut off by a killed process is ignored, and so are runs of another build of the
/// program, unless they are asked for.
class RunStore {
 public:
  RunStore() = default;
  /// All ranks remember; the first one reads the files, every rank writes one of its own (runs.jsonl,
  /// runs.1.jsonl, ...). Collective. Errors: InputError if the folder cannot be written.
  explicit RunStore(const std::filesystem::path& folder, MPI_Comm comm = MPI_COMM_SELF,
                    OtherBuilds others = OtherBuilds::ignore, const std::string& build = this_build());
  ~RunStore();
  RunStore(const RunStore&) = delete;
  RunStore& operator=(const RunStore&) = delete;

  /// The remembered outcome, or that of `run`, which is called if there is none. What it throws (except
  /// Interrupted) and values that are not finite become a failed outcome.
  const RunOutcome& get(const std::string& key, const std::function<std::vector<double>()>& run);

  /// A run to be made by a single rank.
  struct Task {
    std::string key;
    std::function<std::vector<double>()> run;
  };
  /// Makes those that are not remembered, shared over the ranks, each by whoever is free. All ranks remember
  /// all of them. Collective, with the same keys in the same order everywhere.
  void share(const std::vector<Task>& tasks);
  bool remembers(const std::string& key) const { return outcomes.count(key) > 0; }
  MPI_Comm comm() const { return ranks; }

  /// Models made ready, by file content and overrides.
  const PreparedRun& prepared(const std::string& key, const std::function<PreparedRun()>& prepare);

  /// Remembered runs in the files that only another build has made, used or not.
  long of_other_builds() const { return n_other; }
  long computed() const { return n_computed; }
  std::size_t size() const { return outcomes.size(); }

 private:
  RunOutcome make(const std::string& key, const std::function<std::vector<double>()>& run);

  MPI_Comm ranks = MPI_COMM_SELF;
  std::unordered_map<std::string, RunOutcome> outcomes;
  std::unordered_map<std::string, PreparedRun> ready;
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::unique_ptr<std::FILE, Close> file;
  std::string build;
  long n_computed = 0, n_other = 0;
};

}  // namespace seedflow
