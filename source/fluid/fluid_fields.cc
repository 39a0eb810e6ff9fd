#include <cmath>

#include "cell_point.h"
#include "fluid_state.h"

namespace seedflow {

namespace {

/// Calls f(index in layout, lane, point, values) with nodal gradients evaluated at every quadrature point:
/// values[c] is the gradient of component c.
template <int dim, int degree, std::size_t n_components, typename F>
void for_each_gradient(const NodalSpace<dim, degree>& space,
                       const std::array<const NodalVector*, n_components>& fields, const F& f) {
  constexpr int n = NodalSpace<dim, degree>::n, n_q = NodalSpace<dim, degree>::n_q;
  for (std::size_t group = 0; group < space.n_groups; ++group) {
    Lanes x[n_components][n];
    for (std::size_t c = 0; c < n_components; ++c) space.gather(*fields[c], group, x[c]);
    for (int q = 0; q < n_q; ++q) {
      const CellPoint<dim> at(space, group, q);
      Lanes g[n_components][dim];
      for (std::size_t c = 0; c < n_components; ++c) gradient(space, at, q, x[c], g[c]);
      for (int l = 0; l < space.used[group]; ++l) {
        std::array<dealii::Tensor<1, dim>, n_components> values;
        for (std::size_t c = 0; c < n_components; ++c)
          for (int d = 0; d < dim; ++d) values[c][d] = g[c][d][l];
        f(std::size_t(space.cell[group * lane_width + l]) * n_q + q, l, group * n_q + q, values);
      }
    }
  }
}

template <int dim>
std::array<const NodalVector*, std::size_t(dim)> pointers(
    const std::array<NodalVector, std::size_t(dim)>& v) {
  std::array<const NodalVector*, std::size_t(dim)> p;
  for (int d = 0; d < dim; ++d) p[d] = &v[d];
  return p;
}

}  // namespace

template <int dim, int degree>
std::vector<typename Fluid<dim, degree>::Vector> Fluid<dim, degree>::velocity() const {
  return implementation->points(implementation->fields.u_old);
}

template <int dim, int degree>
std::vector<typename Fluid<dim, degree>::Vector> Fluid<dim, degree>::pressure_gradient() const {
  const auto& s = *implementation;
  std::vector<Vector> result(s.space->layout.size());
  for_each_gradient(*s.space, std::array<const NodalVector*, 1>{&s.fields.p},
                    [&](std::size_t i, int, std::size_t, const auto& g) { result[i] = g[0]; });
  return result;
}

template <int dim, int degree>
std::vector<Vec3> Fluid<dim, degree>::vorticity() const {
  const auto& s = *implementation;
  std::vector<Vec3> result(s.space->layout.size());
  for_each_gradient(*s.space, pointers<dim>(s.fields.u), [&](std::size_t i, int, std::size_t, const auto& g) {
    if constexpr (dim == 3)
      result[i] = {g[2][1] - g[1][2], g[0][2] - g[2][0], g[1][0] - g[0][1]};
    else
      result[i] = {0, 0, g[1][0] - g[0][1]};
  });
  return result;
}

template <int dim, int degree>
std::vector<typename Fluid<dim, degree>::Vector> Fluid<dim, degree>::acceleration() const {
  const auto& s = *implementation;
  std::vector<Vector> result(s.space->layout.size());
  const double rate = s.steps_since_start > 0 ? 1 / s.dt_old : 0;
  for_each_gradient(*s.space, pointers<dim>(s.fields.u),
                    [&](std::size_t i, int l, std::size_t k, const auto& g) {
                      Vector u;
                      for (int d = 0; d < dim; ++d) u[d] = s.fields.u_old[k * dim + d][l];
                      // Relative to the mesh; in a frozen rotor d/dt is that of the turning frame.
                      Vector relative = u;
                      for (int d = 0; d < dim; ++d) relative[d] -= s.fields.mesh_velocity[k * dim + d][l];
                      for (int d = 0; d < dim; ++d)
                        result[i][d] = (u[d] - s.fields.u_older[k * dim + d][l]) * rate + relative * g[d];
                      if (s.sliding && s.motion.mode == RotorMotion::Mode::frozen && relative != u)
                        result[i] += s.motion.speed * s.domain.rotor()->across(u);
                    });
  return result;
}

template <int dim, int degree>
double Fluid<dim, degree>::courant_number(double dt) const {
  const auto& s = *implementation;
  Lanes largest{};
  for (std::size_t group = 0; group < s.space->n_groups; ++group)
    for (int q = 0; q < s.n_q; ++q) {
      const CellPoint<dim> at(*s.space, group, q);
      Lanes r[dim];
      Lanes relative[dim];
      for (int d = 0; d < dim; ++d) {
        const std::size_t k = (group * s.n_q + q) * dim + d;
        relative[d] = s.fields.u_old[k] - s.fields.mesh_velocity[k];
      }
      at.to_reference(relative, r);
      largest = lane_max(largest, length<dim>(r));
    }
  double result = 0;
  for (int l = 0; l < lane_width; ++l) result = std::max(result, largest[l]);
  return s.max(result) * dt * degree;
}

template <int dim, int degree>
double Fluid<dim, degree>::bytes_per_cell() const {
  const auto& s = *implementation;
  const auto& f = s.fields;
  double sum =
      s.space->bytes() + (s.momentum_matrix->value.size() * 2 + s.preconditioned_values.size()) * 8.0;
  for (const PointField* p :
       {&f.eps, &f.eps_old, &f.eps_older, &f.beta, &f.source, &f.u_old, &f.u_older, &f.theta})
    sum += p->bytes();
  sum += (4 * dim + 5) * 8.0 * s.space->constrained.size();
  // The backend's copy of the pressure matrix; its coarse levels add about a third.
  sum += s.pressure_matrix->value.size() * 12.0 * 4 / 3;
  return s.sum(sum) / s.domain.triangulation().n_global_active_cells();
}

template <int dim, int degree>
std::vector<double> Fluid<dim, degree>::velocity_jump() const {
  const auto& s = *implementation;
  std::vector<double> result(s.space->layout.n_cells);
  for (std::size_t c = 0; c < result.size(); ++c) {
    const std::size_t group = s.space->place[c] / s.W, l = s.space->place[c] % s.W;
    std::array<Vector, NodalSpace<dim, degree>::n> u;
    for (int i = 0; i < s.n; ++i)
      for (int d = 0; d < dim; ++d)
        u[i][d] = s.fields.u[d].local_element(s.space->node[(group * s.n + i) * s.W + l]);
    for (int i = 0; i < s.n; ++i)
      for (int j = 0; j < i; ++j) result[c] = std::max(result[c], (u[i] - u[j]).norm());
  }
  return result;
}

template <int dim, int degree>
typename Fluid<dim, degree>::Errors Fluid<dim, degree>::errors(
    const std::function<Vector(const dealii::Point<dim>&)>& velocity,
    const std::function<double(const dealii::Point<dim>&)>& pressure) const {
  const auto& s = *implementation;
  double sums[6] = {};  // velocities, p - exact, its square, volume
  for (std::size_t group = 0; group < s.space->n_groups; ++group) {
    Lanes u[dim][NodalSpace<dim, degree>::n], p[NodalSpace<dim, degree>::n];
    for (int d = 0; d < dim; ++d) s.space->gather(s.fields.u[d], group, u[d]);
    s.space->gather(s.fields.p, group, p);
    for (int q = 0; q < s.n_q; ++q) {
      Lanes value[dim];
      for (int d = 0; d < dim; ++d) value[d] = s.space->shape.interpolate(q, 0, u[d]);
      const Lanes p_value = s.space->shape.interpolate(q, 0, p);
      for (int l = 0; l < s.space->used[group]; ++l) {
        const std::size_t i = std::size_t(s.space->cell[group * s.W + l]) * s.n_q + q;
        const auto& x = s.space->layout.position[i];
        const double w = s.space->layout.JxW[i];
        const Vector exact = velocity(x);
        for (int d = 0; d < dim; ++d) {
          sums[0] += w * std::pow(s.fields.u_old[(group * s.n_q + q) * dim + d][l] - exact[d], 2);
          sums[1] += w * std::pow(value[d][l] - exact[d], 2);
        }
        const double e = p_value[l] - pressure(x);
        sums[2] += w * e;
        sums[3] += w * e * e;
        sums[4] += w;
      }
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, s.domain.communicator());
  const double mean_part = s.boundary->has_open_side ? 0.0 : sums[2] * sums[2] / sums[4];
  return {std::sqrt(sums[0]), std::sqrt(sums[1]), std::sqrt(std::max(0.0, sums[3] - mean_part))};
}

#define SEEDFLOW_FIELDS(dim, degree)                                                          \
  template std::vector<dealii::Tensor<1, dim>> Fluid<dim, degree>::velocity() const;          \
  template std::vector<dealii::Tensor<1, dim>> Fluid<dim, degree>::pressure_gradient() const; \
  template std::vector<Vec3> Fluid<dim, degree>::vorticity() const;                           \
  template std::vector<dealii::Tensor<1, dim>> Fluid<dim, degree>::acceleration() const;      \
  template double Fluid<dim, degree>::courant_number(double) const;                           \
  template double Fluid<dim, degree>::bytes_per_cell() const;                                 \
  template std::vector<double> Fluid<dim, degree>::velocity_jump() const;                     \
  template Fluid<dim, degree>::Errors Fluid<dim, degree>::errors(                             \
      const std::function<dealii::Tensor<1, dim>(const dealii::Point<dim>&)>&,                \
      const std::function<double(const dealii::Point<dim>&)>&) const;
SEEDFLOW_FIELDS(2, 1)
SEEDFLOW_FIELDS(3, 1)
SEEDFLOW_FIELDS(2, 2)
SEEDFLOW_FIELDS(3, 2)

}  // namespace seedflow
