#include "seedflow/fluid/krylov.h"

#include <cmath>

namespace seedflow {

namespace {

void sum_ranks(double* a, int n, const NodalVector& v) {
  MPI_Allreduce(MPI_IN_PLACE, a, n, MPI_DOUBLE, MPI_SUM, v.get_mpi_communicator());
}

}  // namespace

int conjugate_gradients(const SparseMatrix& matrix, Preconditioner& preconditioner, const std::vector<char>& fixed,
                        bool singular, NodalVector& x, const NodalVector& b, double tolerance, int max_iterations) {
  const std::uint32_t n = matrix.structure().n_owned();
  NodalVector r(x), z(x), p(x), q(x);
  double n_free = 0;
  for (std::uint32_t i = 0; i < n; ++i) n_free += !fixed[i];
  sum_ranks(&n_free, 1, x);
  // Sets fixed nodes to zero and, for a singular matrix, removes the mean of the free ones.
  const auto admit = [&](NodalVector& v) {
    double* a = v.begin();
    double mean = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (fixed[i]) a[i] = 0;
      mean += a[i];
    }
    if (!singular) return;
    sum_ranks(&mean, 1, v);
    mean /= n_free;
    for (std::uint32_t i = 0; i < n; ++i)
      if (!fixed[i]) a[i] -= mean;
  };
  const auto multiply = [&](NodalVector& y, NodalVector& v) {
    v.update_ghost_values();
    NodalVector* out[] = {&y};
    const NodalVector* in[] = {&v};
    matrix.multiply(1, out, in);
    v.zero_out_ghost_values();
  };
  const auto true_residual = [&] {
    multiply(r, x);
    for (std::uint32_t i = 0; i < n; ++i) r.local_element(i) = b.local_element(i) - r.local_element(i);
    admit(r);
  };
  true_residual();
  double rz_old = 0;
  // The residual of the recurrence drifts from the true one by round-off of the largest intermediate x, which matters
  // when coefficients span many orders of magnitude: the method then starts again from the true one.
  constexpr int most_restarts = 3;
  int restarts = 0, first = 0;
  for (int iteration = 0;; ++iteration) {
    double norm = 0;
    for (std::uint32_t i = 0; i < n; ++i) norm += r.local_element(i) * r.local_element(i);
    sum_ranks(&norm, 1, x);
    if (!std::isfinite(norm)) return -1;
    if (std::sqrt(norm) <= tolerance) {
      if (iteration == first || restarts == most_restarts) return iteration;
      true_residual();
      norm = 0;
      for (std::uint32_t i = 0; i < n; ++i) norm += r.local_element(i) * r.local_element(i);
      sum_ranks(&norm, 1, x);
      if (std::sqrt(norm) <= 1.1 * tolerance) return iteration;
      ++restarts;
      first = iteration;
    }
    if (iteration >= max_iterations) return -1;
    preconditioner.apply(z, r);
    admit(z);
    double rz = 0;
    for (std::uint32_t i = 0; i < n; ++i) rz += r.local_element(i) * z.local_element(i);
    sum_ranks(&rz, 1, x);
    const double beta = iteration == first ? 0 : rz / rz_old;
    rz_old = rz;
    for (std::uint32_t i = 0; i < n; ++i)
      p.local_element(i) = z.local_element(i) + (iteration == first ? 0.0 : beta * p.local_element(i));
    multiply(q, p);
    double pq = 0;
    for (std::uint32_t i = 0; i < n; ++i) pq += fixed[i] ? 0.0 : p.local_element(i) * q.local_element(i);
    sum_ranks(&pq, 1, x);
    const double alpha = rz / pq;
    for (std::uint32_t i = 0; i < n; ++i)
      if (!fixed[i]) {
        x.local_element(i) += alpha * p.local_element(i);
        r.local_element(i) -= alpha * q.local_element(i);
      }
  }
}

int stabilized_biconjugate_gradients(const SparseMatrix& matrix, Preconditioner& preconditioner, int n_systems,
                                     const std::vector<char>* const* fixed, NodalVector* const* x,
                                     const NodalVector* const* b, double relative_tolerance, int max_iterations) {
  constexpr int most = 3;
  const SparsityStructure& s = matrix.structure();
  const std::uint32_t n = s.n_owned();
  const int m = n_systems;
  std::vector<NodalVector> r(m, *x[0]), r0(m, *x[0]), p(m, *x[0]), v(m, *x[0]), t(m, *x[0]), y(m, *x[0]);
  const auto multiply = [&](std::vector<NodalVector>& result, NodalVector* const* in) {
    NodalVector* out[most];
    for (int d = 0; d < m; ++d) {
      in[d]->update_ghost_values();
      out[d] = &result[d];
    }
    matrix.multiply(m, out, in);
    for (int d = 0; d < m; ++d) {
      in[d]->zero_out_ghost_values();
      double* a = result[d].begin();
      for (std::uint32_t i = 0; i < n; ++i)
        if ((*fixed[d])[i]) a[i] = 0;
    }
  };
  const auto precondition = [&](std::vector<NodalVector>& in) {
    for (int d = 0; d < m; ++d) {
      preconditioner.apply(y[d], in[d]);
      double* a = y[d].begin();
      for (std::uint32_t i = 0; i < n; ++i)
        if ((*fixed[d])[i]) a[i] = 0;
    }
  };
  NodalVector* y_pointers[most];
  for (int d = 0; d < m; ++d) y_pointers[d] = &y[d];

  double largest[2];  // residual over diagonal, solution
  const auto measure = [&] {
    largest[0] = largest[1] = 0;
    bool finite = true;
    for (int d = 0; d < m; ++d)
      for (std::uint32_t i = 0; i < n; ++i) {
        const double a = std::abs(r[d].local_element(i) / matrix.value[s.diagonal[i]]);
        if (!(*fixed[d])[i]) {
          finite = finite && std::isfinite(a);
          largest[0] = std::max(largest[0], a);
        }
        largest[1] = std::max(largest[1], std::abs(x[d]->local_element(i)));
      }
    if (!finite) largest[0] = INFINITY;
    MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, x[0]->get_mpi_communicator());
  };

  multiply(r, x);
  for (int d = 0; d < m; ++d)
    for (std::uint32_t i = 0; i < n; ++i) {
      double& a = r[d].local_element(i);
      a = (*fixed[d])[i] ? 0.0 : b[d]->local_element(i) - a;
      r0[d].local_element(i) = a;
    }
  double rho[most] = {1, 1, 1}, alpha[most] = {1, 1, 1}, omega[most] = {1, 1, 1};
  for (int iteration = 0;; ++iteration) {
    measure();
    if (!std::isfinite(largest[0])) return -1;
    if (largest[0] <= relative_tolerance * largest[1]) return iteration;
    if (iteration >= max_iterations) return -1;
    double sums[2 * most] = {};
    for (int d = 0; d < m; ++d)
      for (std::uint32_t i = 0; i < n; ++i) sums[d] += r0[d].local_element(i) * r[d].local_element(i);
    sum_ranks(sums, m, *x[0]);
    for (int d = 0; d < m; ++d) {
      const double beta = iteration == 0 || rho[d] == 0 ? 0 : sums[d] / rho[d] * (alpha[d] / omega[d]);
      rho[d] = sums[d];
      for (std::uint32_t i = 0; i < n; ++i)
        p[d].local_element(i) = r[d].local_element(i) +
                                (iteration == 0 ? 0.0 : beta * (p[d].local_element(i) - omega[d] * v[d].local_element(i)));
    }
    precondition(p);
    multiply(v, y_pointers);
    for (int d = 0; d < m; ++d) {
      sums[d] = 0;
      for (std::uint32_t i = 0; i < n; ++i) sums[d] += r0[d].local_element(i) * v[d].local_element(i);
    }
    sum_ranks(sums, m, *x[0]);
    for (int d = 0; d < m; ++d) {
      alpha[d] = sums[d] != 0 ? rho[d] / sums[d] : 0;  // 0: this system is solved already
      for (std::uint32_t i = 0; i < n; ++i) {
        x[d]->local_element(i) += alpha[d] * y[d].local_element(i);
        r[d].local_element(i) -= alpha[d] * v[d].local_element(i);
      }
    }
    precondition(r);
    multiply(t, y_pointers);
    for (int d = 0; d < m; ++d) {
      sums[d] = sums[most + d] = 0;
      for (std::uint32_t i = 0; i < n; ++i) {
        sums[d] += t[d].local_element(i) * r[d].local_element(i);
        sums[most + d] += t[d].local_element(i) * t[d].local_element(i);
      }
    }
    sum_ranks(sums, 2 * most, *x[0]);
    for (int d = 0; d < m; ++d) {
      omega[d] = sums[most + d] > 0 ? sums[d] / sums[most + d] : 1;
      if (sums[most + d] == 0) continue;
      for (std::uint32_t i = 0; i < n; ++i) {
        x[d]->local_element(i) += omega[d] * y[d].local_element(i);
        r[d].local_element(i) -= omega[d] * t[d].local_element(i);
      }
    }
  }
}

}  // namespace seedflow
