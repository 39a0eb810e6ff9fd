#pragma once

#include "seedflow/base/lane.h"

namespace seedflow {

/// Kinematic eddy viscosity of the WALE model (Nicoud & Ducros 1999, doi:10.1023/A:1009995426001) divided by
/// (C_w Delta)^2 [1/s]:
///
///   (Sd:Sd)^(3/2) / ((S:S)^(5/2) + (Sd:Sd)^(5/4)),
///   S = sym(g),  Sd = sym(g g) - tr(g g)/3 I,  g = grad u
///
/// It is zero in pure shear, falls like the cube of the distance from a wall, and needs no wall distance.
/// \param g  g[i][j] = d u_i / d x_j [1/s]; two-dimensional flow: the third row and column are zero
template <int dim>
SEEDFLOW_INLINE Lanes wale_rate(const Lanes (&g)[dim][dim]) {
  Lanes square[dim][dim], trace{}, strain{}, deviator{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      square[i][j] = g[i][0] * g[0][j];
      for (int k = 1; k < dim; ++k) square[i][j] += g[i][k] * g[k][j];
    }
  for (int i = 0; i < dim; ++i) trace += square[i][i];
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      const Lanes s = 0.5 * (g[i][j] + g[j][i]);
      Lanes sd = 0.5 * (square[i][j] + square[j][i]);
      if (i == j) sd -= (1.0 / 3.0) * trace;
      strain += s * s;
      deviator += sd * sd;
    }
  if (dim == 2) deviator += (1.0 / 9.0) * trace * trace;
  const Lanes root = lane_sqrt(deviator);
  // The last term keeps 0/0 of still air at 0; it is far below any rate that matters [1/s^5].
  const Lanes below = strain * strain * lane_sqrt(strain) + deviator * lane_sqrt(root);
  return deviator * root / (below + broadcast(1e-30));
}

}  // namespace seedflow
