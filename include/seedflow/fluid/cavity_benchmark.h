#pragma once

#include <mpi.h>

#include <string>

#include "seedflow/fluid/fluid.h"

namespace seedflow {

/// What the lid-driven cavity took; CPU time of the slowest rank.
struct CavityBenchmark {
  double cell_steps_per_second_per_core = 0;
  double bytes_per_cell = 0;
  double courant_number = 0;                                ///< largest, at the end
  double pressure_iterations = 0, momentum_iterations = 0;  ///< mean per step
  double mass_residual = 0;                                 ///< largest over the steps
  FluidStatistics statistics;                               ///< seconds of each part, timed steps only
  double seconds = 0;
};

/// Unit cube at Re = 1000 with a lid of velocity 1, `cells` (a multiple of 8 refines p4est-like) per edge,
/// convection implicit, pressure solved to 1e-6 of its right-hand side, velocity to 1e-5 in every node. The
/// flow starts from rest; `steps` are timed after a few that are not (first matrices and multigrid).
CavityBenchmark bench_cavity(int cells, int steps, double dt, const std::string& backend, MPI_Comm comm);

}  // namespace seedflow
