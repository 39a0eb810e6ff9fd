#pragma once

#include <string>

#include "seedflow/seeds/dem.h"

namespace seedflow {

/// What the benches of the seeds measure, by the CPU time of the ranks.
struct SeedBench {
  int n_seeds = 0;
  int n_spheres = 0;  ///< sub-spheres in all
  int n_ranks = 1;
  double rate = 0;                 ///< sub-sphere-steps per second and core
  double bytes_per_sphere = 0;     ///< of all state and lists on one rank
  double contacts_per_seed = 0;    ///< touching pairs of sub-spheres over seeds
  double substeps_per_search = 0;  /// < neighbour search
  double kinetic_energy = 0;       ///< per seed at the end [J]
  double imbalance = 1;            ///< cost of the busiest rank over the mean
};

/// A heap of 4 mm seeds at rest under gravity in a box whose edges are as many seeds long as the cube root of
/// their number, in the paper's materials. It is settled in the bench itself: plain spheres first, which then
/// become seeds and settle again.
struct HeapBench {
  int n_seeds = 800;
  int n_sub_spheres = 70;  ///< 1: plain spheres
  bool rigid = false;
  double time_step = 1e-6;  ///< of the measured steps [s]
  double seconds = 2;       ///< CPU time measured
};
SeedBench bench_heap(const HeapBench& heap, MPI_Comm communicator = MPI_COMM_SELF);

/// 2,200 spheres of 4 mm in a drum of 100 mm diameter and 45 mm length at `rpm` turns a minute with end walls
/// at rest, step 2e-6 s.
SeedBench bench_drum(double rpm = 40, double seconds = 2, MPI_Comm communicator = MPI_COMM_SELF);

}  // namespace seedflow
