#pragma once

#include "seedflow/fluid/flow_kernels.h"

namespace seedflow {

/// Geometry of lane_width cells at one quadrature point.
template <int dim>
struct CellPoint {
  const Lanes* j;  ///< d(xi_e)/d(x_d) at [e dim + d]
  Lanes weight;

  template <int degree>
  SEEDFLOW_INLINE CellPoint(const NodalSpace<dim, degree>& space, std::size_t group, int q)
      : j(space.inverse_jacobian(group, q)), weight(space.weight(group, q)) {}

  /// Reference components J^-1 v of a vector.
  SEEDFLOW_INLINE void to_reference(const Lanes* v, Lanes* r) const {
    for (int e = 0; e < dim; ++e) {
      r[e] = j[e * dim] * v[0];
      for (int d = 1; d < dim; ++d) r[e] += j[e * dim + d] * v[d];
    }
  }
  /// The gradient J^-T g from reference derivatives.
  SEEDFLOW_INLINE void to_physical(const Lanes* g, Lanes* r) const {
    for (int d = 0; d < dim; ++d) {
      r[d] = j[d] * g[0];
      for (int e = 1; e < dim; ++e) r[d] += j[e * dim + d] * g[e];
    }
  }
  SEEDFLOW_INLINE Lanes inverse_h2() const {
    Lanes s{};
    for (int k = 0; k < dim * dim; ++k) s += j[k] * j[k];
    return s / double(dim);
  }
  /// J^-1 J^-T
  SEEDFLOW_INLINE void metric(Lanes (&g)[dim][dim]) const {
    for (int e = 0; e < dim; ++e)
      for (int f = 0; f < dim; ++f) {
        g[e][f] = j[e * dim] * j[f * dim];
        for (int d = 1; d < dim; ++d) g[e][f] += j[e * dim + d] * j[f * dim + d];
      }
  }
};

template <int dim>
SEEDFLOW_INLINE Lanes length(const Lanes* v) {
  Lanes s = v[0] * v[0];
  for (int d = 1; d < dim; ++d) s += v[d] * v[d];
  return lane_sqrt(s);
}

template <int dim, int degree>
SEEDFLOW_INLINE void gradient(const NodalSpace<dim, degree>& space, const CellPoint<dim>& at, int q,
                              const Lanes* x, Lanes* g) {
  Lanes reference[dim];
  for (int e = 0; e < dim; ++e) reference[e] = space.shape.interpolate(q, 1 + e, x);
  at.to_physical(reference, g);
}

}  // namespace seedflow
