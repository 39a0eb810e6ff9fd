#pragma once

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include "seedflow/base/lane.h"

namespace seedflow {

constexpr int power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// Shape functions of Q_k and their reference derivatives at the points of the (k+1)-point Gauss rule, as
/// plain tables for the cell kernels. test[q][0][i] is the value of shape function i at point q,
/// test[q][1+d][i] its derivative in reference direction d.
template <int dim, int degree>
struct Element {
  static constexpr int n = power(degree + 1, dim);    ///< shape functions of a cell
  static constexpr int n_q = power(degree + 1, dim);  ///< quadrature points of a cell

  double test[n_q][dim + 1][n];
  double weight[n_q];

  Element() {
    const dealii::FE_Q<dim> fe(degree);
    const dealii::QGauss<dim> rule(degree + 1);
    for (int q = 0; q < n_q; ++q) {
      weight[q] = rule.weight(q);
      for (int i = 0; i < n; ++i) {
        test[q][0][i] = fe.shape_value(i, rule.point(q));
        const auto gradient = fe.shape_grad(i, rule.point(q));
        for (int d = 0; d < dim; ++d) test[q][1 + d][i] = gradient[d];
      }
    }
  }

  /// sum_i test[q][e][i] x[i]
  SEEDFLOW_INLINE Lanes interpolate(int q, int e, const Lanes* x) const {
    Lanes s = test[q][e][0] * x[0];
    for (int i = 1; i < n; ++i) s += test[q][e][i] * x[i];
    return s;
  }

  /// r[i] += sum_{q,e} test[q][e][i] f[q][e]
  SEEDFLOW_INLINE void integrate(const Lanes (&f)[n_q][dim + 1], Lanes* r) const {
    constexpr int block = n % 8 == 0 ? 8 : (n % 9 == 0 ? 9 : n);
    for (int i0 = 0; i0 < n; i0 += block) {
      Lanes s[block];
      for (int i = 0; i < block; ++i) s[i] = r[i0 + i];
      for (int q = 0; q < n_q; ++q)
        for (int e = 0; e <= dim; ++e)
          for (int i = 0; i < block; ++i) s[i] += test[q][e][i0 + i] * f[q][e];
      for (int i = 0; i < block; ++i) r[i0 + i] = s[i];
    }
  }
};

}  // namespace seedflow
