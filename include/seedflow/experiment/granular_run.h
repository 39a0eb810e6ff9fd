#pragma once

#include <mpi.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "seedflow/coupling/air_drag.h"
#include "seedflow/experiment/experiment.h"
#include "seedflow/experiment/granular_parameters.h"
#include "seedflow/experiment/granular_view.h"
#include "seedflow/experiment/supervised_run.h"
#include "seedflow/output/series.h"
#include "seedflow/output/summary.h"

namespace seedflow {

/// A room that is filled with seeds of one group before the experiment begins.
struct FillingRoom {
  std::string name;
  Vec3 low, high;    ///< [m]; walls inside are respected
  double share = 1;  ///< of all seeds
  int group = 0;     ///< colour
};

/// What is special about one experiment: where its walls are, how it begins, what is measured.
struct GranularScene {
  Vec3 low, high;           ///< seeds' centres must stay inside [m]
  std::vector<Wall> walls;  ///< materials by their number in the table
  std::vector<FillingRoom> rooms;
  /// Begins the experiment at `start` [s]: opens gates, sets the drum turning. Called again after a resume.
  std::function<void(Dem&, double start)> begin;
  /// Advances the seeds by `duration` [s] after the beginning, with loads from outside on them, in place of
  /// Dem::advance; returns the impulse of these loads [N s].
  std::function<Vec3(Dem&, double duration)> advance = nullptr;
  /// After every series interval, `time` after the beginning [s]; may remove seeds.
  std::function<void(Dem&, double time)> after_interval = nullptr;
  std::function<bool(const Dem&, double time)> finished = nullptr;  ///< ends the run early
  std::vector<Column> columns;                                      ///< of series.csv behind the common ones
  std::function<std::vector<double>(const Dem&, double time)> observe;
  /// Entries and sections ("Drum/Speed", "Run/") that do not change the settled filling.
  std::vector<std::string> not_of_filling;
  /// Those that change nothing but how the seeds are measured: a resumed run may change them.
  std::vector<std::string> only_measuring;
  /// State of the measurement, for checkpoints.
  std::function<void(std::ostream&)> save = nullptr;
  std::function<void(std::istream&)> load = nullptr;
};

/// Fills, waits for rest, begins, runs, records: what all granular experiments share. Writes into the output
/// folder used.prm, series.csv (time from the beginning, number of seeds, energies, what the scene observes),
/// seeds.pvd and checkpoints; adds balances and rates to the summary.
///
/// Errors: InputError if seeds do not fit into a room, the time step is too large, or seeds start in walls;
/// RunError (state saved) for NaN, lost seeds, a filling that does not come to rest; Interrupted.
class GranularRun {
 public:
  /// Parameters and scene must outlive the run.
  GranularRun(const GranularParameters& parameters, const GranularScene& scene, MPI_Comm comm);

  /// What --dry-run prints.
  std::string describe() const;
  void carry_out(const Parameters& parameters, const RunOptions& options, Summary& summary);

  Dem& dem() { return seeds; }
  const Dem& dem() const { return seeds; }
  /// After the beginning of the experiment [s]; negative while filling.
  double time() const;
  int n_seeds_at_start() const { return n_at_start; }
  /// RunError if an effect is on that added nothing during the whole run.
  void require_action() const;

 private:
  void add_seeds();
  void advance();
  bool at_rest() const;
  void fill(const Parameters& parameters, SupervisedRun& run);
  bool use_cached_filling(const Parameters& parameters);
  void begin(double start);
  void save(CheckpointWriter& checkpoint) const;
  void load(CheckpointReader& checkpoint);
  void add_balances(double wall_time, Summary& summary) const;

  const GranularParameters& parameters;
  const GranularScene& scene;
  MPI_Comm comm;
  int rank = 0;
  Dem seeds;
  std::optional<AirDrag> air;  ///< if on; acts from the beginning of the experiment, not on the filling
  int n_at_start = 0;
  double start_time = -1;     ///< of the experiment [s]; negative: still filling
  double settling_since = 0;  ///< [s] of the Dem's clock
  long intervals = 0;         ///< since the start
  Vec3 momentum_error;        ///< change of momentum that neither gravity nor walls explain [N s]
  double weight_impulse = 0;  ///< of gravity, summed [N s]
};

}  // namespace seedflow
