#pragma once

#include <cstddef>

#include "seedflow/seeds/dem.h"

namespace seedflow {

/// What `seedflow bench seeds-bonded` measures on one core (CPU time of the calling thread).
struct SeedBench {
  int n_seeds = 0;
  int n_spheres = 0;  ///< sub-spheres in all
  int n_bonds_per_seed = 0;
  int lane_width = 0;  ///< doubles per SIMD register
  long n_substeps = 0;
  double rate = 0;               ///< sub-sphere-steps per second
  double bytes_per_sphere = 0;   ///< of all state and lists
  double contacts_per_seed = 0;  ///< touching pairs at the end
};

/// 800 bonded seeds of 70 sub-spheres (the paper's BS = 0.1 model) in double precision: bonds, motion,
/// contact search and contact forces. `packed`: a cubic lattice in which bounding spheres touch and all seeds
/// jostle at 0.05 m/s; else a cloud of seeds that fly at 0.3 m/s half a diameter apart, as in the
/// seed-metering device of the paper, where 800 seeds fall and slide. Neither is as dense as a settled heap.
SeedBench bench_seeds_bonded(bool packed = false, double seconds = 2);

/// The same seeds as rigid bodies.
SeedBench bench_seeds_rigid(bool packed = false, double seconds = 2);

}  // namespace seedflow
