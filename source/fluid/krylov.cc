#include "seedflow/fluid/krylov.h"

#include <deal.II/base/mpi.h>

#include <array>
#include <cmath>

#include "row_sum.h"

namespace seedflow {

namespace {

void sum_ranks(double* a, int n, const NodalVector& v) {
  MPI_Allreduce(MPI_IN_PLACE, a, n, MPI_DOUBLE, MPI_SUM, v.get_mpi_communicator());
}

}  // namespace

int conjugate_gradients(const SparseMatrix& matrix, Preconditioner& preconditioner,
                        const std::vector<char>& fixed, bool singular, NodalVector& x, const NodalVector& b,
                        double tolerance, int max_iterations) {
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
  // The residual of the recurrence drifts from the true one by round-off of the largest intermediate x, which
  // matters when coefficients span many orders of magnitude: the method then starts again from the true one.
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

namespace {

using Block = NodeBlock;

Block block_abs(Block a) {
  return a < 0 ? -a : a;
}
Block block_max(Block a, Block b) {
  return a > b ? a : b;
}

class BlockSystem {
 public:
  BlockSystem(const SparseMatrix& a, ComponentPreconditioner& m, int n_components,
              const std::vector<char>* const* fixed, const NodalVector& like)
      : matrix(a),
        preconditioner(m),
        components(n_components),
        n(a.structure().n_owned()),
        n_local(n + a.structure().partitioner->n_ghost_indices()),
        free(n),
        inverse_diagonal(n),
        exchange(like) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double d = a.diagonal(i);
      inverse_diagonal[i] = d != 0 ? 1 / d : 1;
      for (int c = 0; c < components; ++c) free[i][c] = !(*fixed[c])[i];
    }
  }
  /// y = A x on free nodes, 0 elsewhere.
  void multiply(Block* y, Block* x) {
    const SparsityStructure& s = matrix.structure();
    if (dealii::Utilities::MPI::n_mpi_processes(s.partitioner->get_mpi_communicator()) > 1)
      for (int c = 0; c < components; ++c) {
        unpack(x, c, exchange);
        exchange.update_ghost_values();
        for (std::uint32_t i = n; i < n_local; ++i) x[i][c] = exchange.local_element(i);
        exchange.zero_out_ghost_values();
      }
    const double* value = matrix.value.data();
    const std::uint32_t *start = s.row_start.data(), *column = s.column.data();
    for (std::uint32_t row = 0; row < n; ++row) {
      const Block sum = row_sum<Block>(start[row], start[row + 1],
                                       [&](std::uint32_t k) { return value[k] * x[column[k]]; });
      y[row] = sum * free[row];
    }
    const PatchStructure* more = matrix.patch().get();
    for (std::size_t r = 0; more && r < more->row.size(); ++r) {
      Block sum{};
      for (std::uint32_t k = more->start[r]; k < more->start[r + 1]; ++k)
        sum += matrix.patch_value[k] * x[more->column[k]];
      y[more->row[r]] += sum * free[more->row[r]];
    }
  }
  void precondition(Block* z, const Block* r) {
    preconditioner.apply(z, r);
    for (std::uint32_t i = 0; i < n; ++i) z[i] *= free[i];
  }
  Block sum_ranks(Block a) const {
    double s[4] = {a[0], a[1], a[2], a[3]};
    seedflow::sum_ranks(s, 4, exchange);
    return Block{s[0], s[1], s[2], s[3]};
  }
  /// Largest residual over diagonal and largest solution, over nodes, components and ranks.
  std::array<double, 2> measure(const Block* r, const Block* x) const {
    Block residual{}, solution{};
    bool finite = true;
    Block check{};
    for (std::uint32_t i = 0; i < n; ++i) {
      const Block a = inverse_diagonal[i] * r[i];
      residual = block_max(block_abs(a), residual);
      solution = block_max(block_abs(x[i]), solution);
      check += a;  // a maximum ignores NaN, a sum does not
    }
    std::array<double, 2> result{};
    for (int c = 0; c < components; ++c) {
      finite = finite && std::isfinite(check[c]);
      result[0] = std::max(result[0], residual[c]);
      result[1] = std::max(result[1], solution[c]);
    }
    if (!finite) result[0] = INFINITY;
    MPI_Allreduce(MPI_IN_PLACE, result.data(), 2, MPI_DOUBLE, MPI_MAX, exchange.get_mpi_communicator());
    return result;
  }

  const SparseMatrix& matrix;
  ComponentPreconditioner& preconditioner;
  const int components;
  const std::uint32_t n, n_local;
  std::vector<Block> free;  ///< 1 for free nodes, 0 for fixed ones

 private:
  void unpack(const Block* x, int c, NodalVector& v) const {
    for (std::uint32_t i = 0; i < n; ++i) v.local_element(i) = x[i][c];
  }
  std::vector<double> inverse_diagonal;
  NodalVector exchange;  ///< one component, for the other ranks
};

}  // namespace

int stabilized_biconjugate_gradients(const SparseMatrix& matrix, ComponentPreconditioner& preconditioner,
                                     int n_systems, const std::vector<char>* const* fixed,
                                     NodalVector* const* solution, const NodalVector* const* rhs,
                                     double relative_tolerance, int max_iterations) {
  BlockSystem system(matrix, preconditioner, n_systems, fixed, *solution[0]);
  const std::uint32_t n = system.n;
  std::vector<Block> x(system.n_local), y(system.n_local), r(n), r0(n), p(n), v(n), t(n);
  for (std::uint32_t i = 0; i < n; ++i)
    for (int c = 0; c < n_systems; ++c) x[i][c] = solution[c]->local_element(i);
  system.multiply(r.data(), x.data());
  for (std::uint32_t i = 0; i < n; ++i) {
    Block b{};
    for (int c = 0; c < n_systems; ++c) b[c] = rhs[c]->local_element(i);
    r0[i] = r[i] = (b - r[i]) * system.free[i];
  }
  Block rho{}, alpha{}, omega{};
  for (int iteration = 0;; ++iteration) {
    const auto [residual, largest] = system.measure(r.data(), x.data());
    const bool done = residual <= relative_tolerance * largest;
    if (done || !std::isfinite(residual) || iteration >= max_iterations) {
      for (std::uint32_t i = 0; i < n; ++i)
        for (int c = 0; c < n_systems; ++c) solution[c]->local_element(i) = x[i][c];
      return done ? iteration : -1;
    }
    Block a{}, b{};
    for (std::uint32_t i = 0; i < n; ++i) a += r0[i] * r[i];
    const Block rho_new = system.sum_ranks(a);
    // A zero denominator means that this component is solved already.
    const Block denominator = rho * omega;
    const Block beta =
        denominator != 0 ? rho_new * alpha / (denominator != 0 ? denominator : Block{} + 1) : Block{};
    rho = rho_new;
    for (std::uint32_t i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * v[i]);
    system.precondition(y.data(), p.data());
    system.multiply(v.data(), y.data());
    a = Block{};
    for (std::uint32_t i = 0; i < n; ++i) a += r0[i] * v[i];
    a = system.sum_ranks(a);
    alpha = a != 0 ? rho / (a != 0 ? a : Block{} + 1) : Block{};
    for (std::uint32_t i = 0; i < n; ++i) {
      x[i] += alpha * y[i];
      r[i] -= alpha * v[i];
    }
    system.precondition(y.data(), r.data());
    system.multiply(t.data(), y.data());
    a = b = Block{};
    for (std::uint32_t i = 0; i < n; ++i) {
      a += t[i] * r[i];
      b += t[i] * t[i];
    }
    a = system.sum_ranks(a);
    b = system.sum_ranks(b);
    omega = b != 0 ? a / (b != 0 ? b : Block{} + 1) : Block{};
    for (std::uint32_t i = 0; i < n; ++i) {
      x[i] += omega * y[i];
      r[i] -= omega * t[i];
    }
  }
}

}  // namespace seedflow
