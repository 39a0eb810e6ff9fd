#pragma once

#include <mpi.h>

#include <string>

namespace seedflow {

/// What a step with a turning rotor took; CPU time of the slowest rank.
struct RotorBenchmark {
  double cells = 0, interface_faces = 0;
  double seconds_per_step = 0;
  double turning = 0;  ///< share of lookup, couplings and their part of the matrices in a step
  double pressure_iterations = 0, momentum_iterations = 0;  ///< mean per step
  double preconditioners = 0;                               ///< multigrid hierarchies built per step
  double mass_residual = 0;                                 ///< largest over the steps
  double bytes_per_cell = 0;  ///< growth of peak resident memory, mesh and solvers included
};

/// A slab of 4 x 4 x 1.5 turns under another, each of n x n x (3 n / 8) cells, with air blown through both;
/// the sliding interface is the plane between them, where the corners of the turned square lack partners. The
/// slab turns by a tenth of a cell at the rim per step.
RotorBenchmark bench_rotor(int n, int steps, const std::string& backend, MPI_Comm comm);

}  // namespace seedflow
