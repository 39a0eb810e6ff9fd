#pragma once

#include <vector>

#include "seedflow/coupling/bodies.h"
#include "seedflow/coupling/point_exchange.h"
#include "seedflow/mesh/point_location.h"

namespace seedflow {

/// The volume the seeds take from the air:  eps(x_q) = 1 - sum_p V_p w_pq / JxW_q  (paper Eq. 5, divided by
/// the cell's volume). The integral of 1 - eps is the seeds' volume to round-off, whatever the kernel.
class VoidFraction {
 public:
  VoidFraction(const CouplingParameters& parameters, double kernel_width, const PointLocation<3>& location,
               const QuadratureLayout<3>& layout, MPI_Comm comm);

  /// Computes eps for bodies at the given places. Bodies outside the mesh take no volume, if
  /// Coupling/Outside the mesh allows them. RunError if it does not or eps falls below its lower bound
  /// (where, which value, remedy). Collective.
  void compute(const Bodies& bodies, const std::vector<Vec3>& body_position,
               const std::vector<Vec3>& sphere_position, double time, std::vector<double>& eps);

  /// For each body the mean of a field over its volume, with the same weights; times V it is the exact
  /// counterpart of the integral of (1 - eps) times the field. Collective.
  std::vector<Vec3> average(const Bodies& bodies, const std::vector<dealii::Tensor<1, 3>>& field) const;

  /// Relative difference between the integral of 1 - eps and the bodies' volume at the last compute().
  double volume_error() const { return error; }
  bool active() const { return parameters.void_fraction_kernel != "none"; }

 private:
  CouplingParameters parameters;
  double sigma;
  const PointLocation<3>& location;
  const QuadratureLayout<3>& layout;
  MPI_Comm comm;
  PointExchange exchange;  ///< rows: bodies (gaussian) or sub-spheres (sampled)
  double error = 0;
};

}  // namespace seedflow
