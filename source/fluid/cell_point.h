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

/// The explicit terms of the momentum equation whose part outside the nodal space is treated as a subscale:
/// c grad p, and with dynamic subscales also the force and the past, c grad p - S - f + rho (a1 eps u^n + a2
/// eps u^{n-1})/dt [N/m3]. `past` is the last term alone.
/// `old`, `older`: a1 eps^n and a2 eps^{n-1}; `rate`: rho/dt.
template <int dim>
SEEDFLOW_INLINE Lanes past_momentum(const FlowFields<dim>& fields, std::size_t k, int d, double rate,
                                    Lanes old, Lanes older) {
  return rate * (old * fields.u_old[k * dim + d] + older * fields.u_older[k * dim + d]);
}
template <int dim>
SEEDFLOW_INLINE Lanes subscale_terms(bool dynamic, const FlowFields<dim>& fields, std::size_t k, int d,
                                     Lanes pressure, double rate, Lanes old, Lanes older) {
  if (!dynamic) return pressure;
  return pressure - fields.source[k * dim + d] + past_momentum(fields, k, d, rate, old, older);
}

/// Nodal values of the projection of subscale_terms / M.
template <int dim, int degree>
SEEDFLOW_INLINE void gather_projected(const NodalSpace<dim, degree>& space, const StepCoefficients& c,
                                      const FlowFields<dim>& fields, std::size_t group, int d, Lanes* y) {
  constexpr int n = NodalSpace<dim, degree>::n;
  space.gather(fields.y[d], group, y);
  if (!c.dynamic_subscales) return;
  Lanes z[n];
  space.gather(fields.z[d], group, z);
  for (int i = 0; i < n; ++i) y[i] += z[i];
}

}  // namespace seedflow
