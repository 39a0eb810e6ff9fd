#pragma once

#include <filesystem>
#include <optional>

#include "seedflow/experiment/simulation.h"
#include "seedflow/output/series.h"
#include "seedflow/output/vtu.h"

namespace seedflow {

/// Writes what a coupled run produces while it runs:
///   seeds.csv   time; of every seed position, velocity, spin, force of the air, air velocity, void fraction
///   seeds.pvd   sub-spheres for ParaView
///   air.pvd     velocity, pressure, void fraction for ParaView
///   walls.vtp   the box
/// Collective: all ranks call, rank 0 writes (the air's pieces are written by their owners).
class Recorder {
 public:
  /// \param resume_time if given, files are continued after it [s].
  Recorder(const Simulation& simulation, const std::filesystem::path& folder,
           std::optional<double> resume_time);

  /// After every air step and once at the start; decides by the intervals of section "Run" what to write.
  void record(Simulation& simulation);

 private:
  // On rank 0 only:
  void open(const Simulation& simulation, std::optional<double> resume_time);
  void write_row(const Simulation& simulation);
  void write_seeds(const Simulation& simulation, unsigned int count);
  // On all:
  void write_fields(Simulation& simulation);

  std::filesystem::path folder;
  MPI_Comm comm;
  bool writes;
  double series_interval, field_interval;
  long next_row = 0, next_field = 0;
  std::optional<SeriesWriter> series;
  std::optional<PvdSeries> seeds_pvd, air_pvd;
};

/// Columns of seeds.csv for n seeds.
std::vector<Column> seed_columns(int n_seeds);

}  // namespace seedflow
