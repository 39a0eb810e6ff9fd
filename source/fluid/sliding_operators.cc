#include <algorithm>
#include <cmath>

#include "seedflow/fluid/sliding_coupling.h"

namespace seedflow {

template <int dim, int degree>
void SlidingCoupling<dim, degree>::jump_gradient(const NodalVector& p, PointField& jump) const {
  for (const Cell& cell : cells) {
    if (cell.place < 0) continue;
    const std::size_t m = cell.slot.size(), group = cell.place / Space::W, lane = cell.place % Space::W;
    std::vector<double> value(m);
    for (std::size_t s = 0; s < m; ++s) value[s] = p.local_element(cell.slot[s]);
    for (int q = 0; q < n_q; ++q)
      for (int d = 0; d < dim; ++d) {
        const double* lift = cell.lift.data() + (q * dim + d) * m;
        double sum = 0;
        for (std::size_t s = 0; s < m; ++s) sum += lift[s] * value[s];
        jump.at((group * n_q + q) * dim + d)[lane] = -sum / cell.JxW[q];
      }
  }
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::subtract_flux(const PointField& eps, const PointField& v,
                                                 NodalVector& y) const {
  std::vector<double> sum;
  for (const Cell& cell : cells) {
    if (cell.place < 0) continue;
    const std::size_t m = cell.slot.size(), group = cell.place / Space::W, lane = cell.place % Space::W;
    sum.assign(m, 0.0);
    for (int q = 0; q < n_q; ++q)
      for (int d = 0; d < dim; ++d) {
        const double flux = eps[group * n_q + q][lane] * v[(group * n_q + q) * dim + d][lane];
        const double* lift = cell.lift.data() + (q * dim + d) * m;
        for (std::size_t s = 0; s < m; ++s) sum[s] += flux * lift[s];
      }
    for (std::size_t s = 0; s < m; ++s) y.local_element(cell.slot[s]) -= sum[s];
  }
}

template <int dim, int degree>
std::array<double, 2> SlidingCoupling<dim, degree>::flow(const PointField& eps, const PointField& v) const {
  std::array<double, 2> sum{};
  for (const Cell& cell : cells) {
    if (cell.place < 0) continue;
    const std::size_t m = cell.slot.size(), group = cell.place / Space::W, lane = cell.place % Space::W;
    const std::size_t n_own = *std::max_element(cell.own_slot.begin(), cell.own_slot.end()) + 1;
    for (int q = 0; q < n_q; ++q)
      for (int d = 0; d < dim; ++d) {
        const double flux = eps[group * n_q + q][lane] * v[(group * n_q + q) * dim + d][lane];
        const double* lift = cell.lift.data() + (q * dim + d) * m;
        // Own test functions and those of the other side.
        for (std::size_t s = 0; s < m; ++s) {
          if ((s < n_own) == cell.turns)
            sum[0] += flux * lift[s];
          else
            sum[1] -= flux * lift[s];
        }
      }
  }
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 2, MPI_DOUBLE, MPI_SUM,
                space.structure->partitioner->get_mpi_communicator());
  return sum;
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::gradient_on_slots(const Cell& cell, int q, int d,
                                                     std::vector<double>& g) const {
  g.assign(cell.slot.size(), 0.0);
  for (int i = 0; i < n; ++i) {
    double value = 0;
    if (cell.turns)
      for (int e = 0; e < dim; ++e) value += rotation[d][e] * cell.gradient[(q * dim + e) * n + i];
    else
      value = cell.gradient[(q * dim + d) * n + i];
    for (std::uint32_t k = cell.first[i]; k < cell.first[i + 1]; ++k)
      g[cell.own_slot[k]] += cell.weight[k] * value;
  }
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::diffusion_of(std::uint32_t c, const double* coefficient, bool walls,
                                                std::vector<double>& local) const {
  const Cell& cell = cells[c];
  const std::size_t m = cell.slot.size();
  std::vector<double> g, lift(m), mean(m);
  local.assign(m * m, 0.0);
  // G.G' - g.g' = L h' + h L' with L = G - g and h = g + L/2
  for (int d = 0; d < dim; ++d) {
    if (!cell.lifts[d]) continue;
    for (int q = 0; q < n_q; ++q) {
      gradient_on_slots(cell, q, d, g);
      const double* from = cell.lift.data() + (q * dim + d) * m;
      for (std::size_t s = 0; s < m; ++s) lift[s] = -from[s] / cell.JxW[q];
      if (walls && !cell.wall.empty())
        for (std::size_t s = 0; s < m; ++s) lift[s] -= cell.wall[(q * dim + d) * m + s] / cell.JxW[q];
      for (std::size_t s = 0; s < m; ++s) mean[s] = g[s] + 0.5 * lift[s];
      const double factor = coefficient[q] * cell.JxW[q];
      for (std::size_t a = 0; a < m; ++a) {
        const double l = factor * lift[a];
        if (l == 0) continue;
        double* row = local.data() + a * m;
        for (std::size_t b = 0; b < m; ++b) row[b] += l * mean[b];
      }
    }
  }
  for (std::size_t a = 0; a < m; ++a)
    for (std::size_t b = 0; b <= a; ++b)
      local[a * m + b] = local[b * m + a] = local[a * m + b] + local[b * m + a];
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::add_to_patch(std::uint32_t c, const std::vector<double>& local,
                                                SparseMatrix& matrix) const {
  const Cell& cell = cells[c];
  const std::size_t m = cell.slot.size();
  const std::uint32_t n_owned = space.structure->n_owned();
  for (std::size_t a = 0; a < m; ++a) {
    if (cell.slot[a] >= n_owned) continue;
    for (std::size_t b = 0; b < m; ++b) matrix.patch_value[cell.position[a * m + b]] += local[a * m + b];
  }
}

template <int dim, int degree>
void SlidingCoupling<dim, degree>::add_diffusion(const std::vector<double>& coefficient, bool walls,
                                                 SparseMatrix& matrix) const {
  std::vector<double> local;
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    if (!cells[c].needed) continue;
    diffusion_of(c, coefficient.data() + c * n_q, walls, local);
    add_to_patch(c, local, matrix);
  }
}

#define SEEDFLOW_SLIDING(dim, degree)                                                                        \
  template void SlidingCoupling<dim, degree>::gradient_on_slots(const Cell&, int, int, std::vector<double>&) \
      const;                                                                                                 \
  template void SlidingCoupling<dim, degree>::jump_gradient(const NodalVector&, PointField&) const;          \
  template void SlidingCoupling<dim, degree>::subtract_flux(const PointField&, const PointField&,            \
                                                            NodalVector&) const;                             \
  template std::array<double, 2> SlidingCoupling<dim, degree>::flow(const PointField&, const PointField&)    \
      const;                                                                                                 \
  template void SlidingCoupling<dim, degree>::diffusion_of(std::uint32_t, const double*, bool,               \
                                                           std::vector<double>&) const;                      \
  template void SlidingCoupling<dim, degree>::add_to_patch(std::uint32_t, const std::vector<double>&,        \
                                                           SparseMatrix&) const;                             \
  template void SlidingCoupling<dim, degree>::add_diffusion(const std::vector<double>&, bool, SparseMatrix&) \
      const;
SEEDFLOW_SLIDING(2, 1)
SEEDFLOW_SLIDING(3, 1)
SEEDFLOW_SLIDING(2, 2)
SEEDFLOW_SLIDING(3, 2)

}  // namespace seedflow
