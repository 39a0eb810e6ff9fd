#pragma once

#include <mpi.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "seedflow/base/parameters.h"
#include "seedflow/experiment/agreement.h"
#include "seedflow/experiment/experiment.h"
#include "seedflow/output/checkpoint.h"

namespace seedflow {

/// A long computation as its supervisor sees it. All functions are called on all ranks.
struct LongWork {
  std::string label = "simulated";              ///< in front of the progress line
  double end = 1;                               ///< of what `time` counts, for the progress line
  double checkpoint_interval = 600;             ///< wall time between checkpoints [s]
  std::function<double()> time;                 ///< simulated time [s]
  std::function<bool()> finished;               ///< the same on all ranks
  std::function<void()> advance;                ///< one step, with all that is written after it
  std::function<std::string()> note = nullptr;  ///< a few words for the progress line
};

/// What belongs to every long run whatever it computes: used.prm, progress, checkpoints, resumption,
/// interruption (state saved, Interrupted thrown), failure (state saved apart from the sound checkpoints, the
/// message says where, RunError goes on).
///
///   SupervisedRun run(parameters, options, comm, save);
///   if (options.resume) run.resume(load, {"Run/End time"});
///   run.carry_out(work);
class SupervisedRun {
 public:
  using Save = std::function<void(CheckpointWriter&)>;
  using Load = std::function<void(CheckpointReader&)>;

  /// Without options.resume, states that an earlier run left in the folder are removed, so that a later
  /// --resume cannot take them for its own. The parameters must outlive it. Collective.
  SupervisedRun(const Parameters& parameters, const RunOptions& options, MPI_Comm comm, Save save);
  ~SupervisedRun();

  /// Reads the last checkpoint. `may_change`: entries that may differ. Collective.
  void resume(const Load& load, const std::vector<std::string>& may_change);
  /// Runs to the end and leaves a checkpoint there, from which a later end can be reached. Collective.
  void carry_out(const LongWork& work);
  /// Of all parts of the run so far [s].
  double wall_time() const { return seconds; }

 private:
  void save_state(const std::string& folder, double time) const;
  std::string save_failed_state(double time);

  const Parameters& parameters;
  const RunOptions& options;
  MPI_Comm comm;
  int rank = 0;
  Save save;
  Meeting meeting;
  double seconds = 0;
};

/// The complete .prm as text.
std::string as_text(const Parameters& parameters);

}  // namespace seedflow
