#pragma once

#include <mpi.h>

namespace seedflow {

/// What `./seedflow bench locate` measures.
struct PointLocationRate {
  unsigned int n_cells = 0, n_points = 0;
  double look_up_ms = 0;  ///< all points to their cells, median over repeats [ms]
  double build_ms = 0;    ///< the table, once per mesh change [ms]
  /// The same on a mesh of as many trilinear hexahedra: the first time, and after a step, with each point's
  /// last cell as first guess.
  double hexahedra_first_ms = 0, hexahedra_look_up_ms = 0, hexahedra_build_ms = 0;
};

/// 800 clusters of 70 points (seeds of sub-spheres) in a box refined to about 50,000 cells.
PointLocationRate measure_point_location(MPI_Comm communicator);

}  // namespace seedflow
