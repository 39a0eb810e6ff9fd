#pragma once

#include <mpi.h>

#include <filesystem>
#include <optional>

#include "seedflow/experiment/granular_run.h"
#include "seedflow/output/vtu.h"

namespace seedflow {

/// Writes series.csv and, for ParaView, seeds.pvd, walls.vtp (walls at rest) and moving_walls.pvd (those that
/// move or are taken away), on rank 0.
class GranularRecorder {
 public:
  /// \param resume_time if given, files are continued after it [s].
  GranularRecorder(const GranularParameters& parameters, const GranularScene& scene, const Dem& dem,
                   const std::filesystem::path& folder, MPI_Comm comm, std::optional<double> resume_time);

  /// Called on all ranks after every series interval, `time` from the beginning of the experiment [s].
  void record(const Dem& dem, double time);

 private:
  void write_row(const Dem& dem, double time);
  void write_seeds(const Dem& dem, double time);
  void write_walls(const Dem& dem, bool moving, const std::string& name) const;

  const GranularParameters& parameters;
  const GranularScene& scene;
  std::filesystem::path folder;
  MPI_Comm comm;
  bool writes = false;
  long next_field = 0;
  std::optional<SeriesWriter> series;
  std::optional<PvdSeries> pvd, moving_walls;
};

}  // namespace seedflow
