#include "cell_point.h"

namespace seedflow {

template <int dim, int degree>
void assemble_pressure_matrix(const NodalSpace<dim, degree>& space, const StepCoefficients& c,
                              const FlowFields<dim>& fields, SparseMatrix& matrix) {
  constexpr int n = NodalSpace<dim, degree>::n, n_q = NodalSpace<dim, degree>::n_q;
  const auto& shape = space.shape;
  matrix.set_zero();
  for (std::size_t group = 0; group < space.n_groups; ++group) {
    Lanes diffusion[n_q][dim][dim];
    for (int q = 0; q < n_q; ++q) {
      const CellPoint<dim> at(space, group, q);
      const std::size_t k = group * n_q + q;
      const Lanes eps = fields.eps[k];
      const Lanes factor = at.weight * eps * c.share(eps) / c.inertia(eps, fields.beta[k]);
      at.metric(diffusion[q]);
      for (int e = 0; e < dim; ++e)
        for (int f = 0; f < dim; ++f) diffusion[q][e][f] *= factor;
    }
    Lanes cell_matrix[n * n];
    for (int j = 0; j < n; ++j) {
      Lanes trial[n_q][dim + 1];
      for (int q = 0; q < n_q; ++q) {
        trial[q][0] = broadcast(0.0);
        for (int e = 0; e < dim; ++e) {
          trial[q][1 + e] = diffusion[q][e][0] * shape.test[q][1][j];
          for (int f = 1; f < dim; ++f) trial[q][1 + e] += diffusion[q][e][f] * shape.test[q][1 + f][j];
        }
      }
      Lanes column[n] = {};
      shape.integrate(trial, column);
      for (int i = 0; i < n; ++i) cell_matrix[i * n + j] = column[i];
    }
    space.scatter(cell_matrix, group, matrix);
  }
  matrix.compress();
}

template <int dim, int degree>
double assemble_pressure_rhs(const NodalSpace<dim, degree>& space, const StepCoefficients& c,
                             FlowFields<dim>& fields, NodalVector& rhs) {
  constexpr int n = NodalSpace<dim, degree>::n, n_q = NodalSpace<dim, degree>::n_q;
  const auto& shape = space.shape;
  const double rate = c.density / c.time.dt;
  const bool dynamic = c.dynamic_subscales;
  rhs = 0;
  Lanes scale{};
  for (std::size_t group = 0; group < space.n_groups; ++group) {
    Lanes p[n], y[dim][n], u[dim][n];
    space.gather(fields.p, group, p);
    for (int d = 0; d < dim; ++d) {
      gather_projected(space, c, fields, group, d, y[d]);
      space.gather(fields.u[d], group, u[d]);
    }
    Lanes load[n_q][dim + 1], flow{}, growth{};
    for (int q = 0; q < n_q; ++q) {
      const CellPoint<dim> at(space, group, q);
      const std::size_t k = group * n_q + q;
      const Lanes eps = fields.eps[k], theta = fields.theta[k];
      const Lanes inverse = 1.0 / c.inertia(eps, fields.beta[k]), share = c.share(eps);
      const Lanes old = c.time.old * fields.eps_old[k], older = c.time.older * fields.eps_older[k];
      Lanes g[dim], velocity[dim];
      gradient(space, at, q, p, g);
      for (int d = 0; d < dim; ++d) {
        g[d] += fields.jump_p[k * dim + d];
        velocity[d] =
            shape.interpolate(q, 0, u[d]) -
            theta * (subscale_terms(dynamic, fields, k, d, share * g[d], rate, old, older) * inverse -
                     shape.interpolate(q, 0, y[d]));
        if (!fields.predicted.is_uniform()) fields.predicted.at(k * dim + d) = velocity[d];
        velocity[d] -= fields.mesh_velocity[k * dim + d];
      }
      load[q][0] = -at.weight * (c.time.now * eps + old + older) / c.time.dt;
      at.to_reference(velocity, load[q] + 1);
      flow += at.weight * eps * length<dim>(load[q] + 1);
      growth += load[q][0];
      for (int e = 0; e < dim; ++e) load[q][1 + e] *= at.weight * eps;
    }
    scale += flow * flow + growth * growth;
    Lanes r[n] = {};
    shape.integrate(load, r);
    space.scatter(r, group, rhs);
  }
  rhs.compress(dealii::VectorOperation::add);
  return lane_sum(scale);
}

template <int dim, int degree>
StepIntegrals<dim> correct_velocity(const NodalSpace<dim, degree>& space, const StepCoefficients& c,
                                    FlowFields<dim>& fields, NodalVector& mass_residual) {
  constexpr int n = NodalSpace<dim, degree>::n, n_q = NodalSpace<dim, degree>::n_q;
  const auto& shape = space.shape;
  const double rate = c.density / c.time.dt;
  const bool dynamic = c.dynamic_subscales;
  mass_residual = 0;
  Lanes change[dim] = {}, exchange[dim] = {}, pressure[dim] = {}, share_sum[dim] = {}, momentum[dim] = {};
  Lanes circulation{}, growth{};
  for (std::size_t group = 0; group < space.n_groups; ++group) {
    Lanes p[n], phi[n], y[dim][n], u[dim][n];
    space.gather(fields.p, group, p);
    space.gather(fields.phi, group, phi);
    for (int d = 0; d < dim; ++d) {
      gather_projected(space, c, fields, group, d, y[d]);
      space.gather(fields.u[d], group, u[d]);
    }
    Lanes load[n_q][dim + 1], cell_growth{};
    for (int q = 0; q < n_q; ++q) {
      const CellPoint<dim> at(space, group, q);
      const std::size_t k = group * n_q + q;
      const Lanes eps = fields.eps[k], theta = fields.theta[k], beta = fields.beta[k], w = at.weight;
      const Lanes share = c.share(eps), inverse = 1.0 / c.inertia(eps, beta), kappa = share * inverse;
      const Lanes old = c.time.old * fields.eps_old[k], older = c.time.older * fields.eps_older[k];
      Lanes g[dim], g_phi[dim], velocity[dim];
      gradient(space, at, q, p, g);
      gradient(space, at, q, phi, g_phi);
      for (int d = 0; d < dim; ++d) {
        g[d] += fields.jump_p[k * dim + d];
        g_phi[d] += fields.jump_phi[k * dim + d];
        velocity[d] =
            shape.interpolate(q, 0, u[d]) - kappa * g_phi[d] -
            theta * (subscale_terms(dynamic, fields, k, d, share * g[d], rate, old, older) * inverse -
                     shape.interpolate(q, 0, y[d]));
        const Lanes u_old = fields.u_old[k * dim + d], u_older = fields.u_older[k * dim + d];
        change[d] += w * rate * (c.time.now * eps * velocity[d] + old * u_old + older * u_older);
        exchange[d] += w * (fields.source[k * dim + d] - beta * velocity[d]);
        pressure[d] -= w * share * (g[d] + g_phi[d]);
        share_sum[d] += w * (1.0 - share) * (g[d] + g_phi[d]);
        momentum[d] += w * c.density * eps * velocity[d];
        fields.u_older.at(k * dim + d) = velocity[d];
      }
      circulation += w * eps * length<dim>(velocity);
      load[q][0] = -w * (c.time.now * eps + old + older) / c.time.dt;
      cell_growth += load[q][0];
      for (int d = 0; d < dim; ++d) velocity[d] -= fields.mesh_velocity[k * dim + d];
      at.to_reference(velocity, load[q] + 1);
      for (int e = 0; e < dim; ++e) load[q][1 + e] *= w * eps;
    }
    growth += lane_max(cell_growth, -cell_growth);
    Lanes r[n] = {};
    shape.integrate(load, r);
    space.scatter(r, group, mass_residual);
  }
  mass_residual.compress(dealii::VectorOperation::add);
  StepIntegrals<dim> result;
  for (int d = 0; d < dim; ++d) {
    result.change[d] = lane_sum(change[d]);
    result.exchange[d] = lane_sum(exchange[d]);
    result.pressure[d] = lane_sum(pressure[d]);
    result.share[d] = lane_sum(share_sum[d]);
    result.momentum[d] = lane_sum(momentum[d]);
  }
  result.circulation = lane_sum(circulation);
  result.growth = lane_sum(growth);
  return result;
}

template <int dim, int degree>
void refine_velocity(const NodalSpace<dim, degree>& space, const StepCoefficients& c, FlowFields<dim>& fields,
                     const NodalVector& psi, StepIntegrals<dim>& integrals, NodalVector& mass_residual) {
  constexpr int n = NodalSpace<dim, degree>::n, n_q = NodalSpace<dim, degree>::n_q;
  const auto& shape = space.shape;
  mass_residual = 0;
  Lanes change[dim] = {}, exchange[dim] = {}, pressure[dim] = {}, share_sum[dim] = {}, momentum[dim] = {};
  for (std::size_t group = 0; group < space.n_groups; ++group) {
    Lanes nodal[n], load[n_q][dim + 1];
    space.gather(psi, group, nodal);
    for (int q = 0; q < n_q; ++q) {
      const CellPoint<dim> at(space, group, q);
      const std::size_t k = group * n_q + q;
      const Lanes eps = fields.eps[k], beta = fields.beta[k], w = at.weight, share = c.share(eps);
      const Lanes inertia = c.inertia(eps, beta);
      Lanes g[dim], velocity[dim];
      gradient(space, at, q, nodal, g);
      for (int d = 0; d < dim; ++d) {
        g[d] += fields.jump_phi[k * dim + d];
        const Lanes more = -share / inertia * g[d];
        velocity[d] = fields.u_older[k * dim + d] + more;
        change[d] += w * (inertia - beta) * more;
        exchange[d] -= w * beta * more;
        pressure[d] -= w * share * g[d];
        share_sum[d] += w * (1.0 - share) * g[d];
        momentum[d] += w * c.density * eps * more;
        fields.u_older.at(k * dim + d) = velocity[d];
        velocity[d] -= fields.mesh_velocity[k * dim + d];
      }
      load[q][0] = -w *
                   (c.time.now * eps + c.time.old * fields.eps_old[k] + c.time.older * fields.eps_older[k]) /
                   c.time.dt;
      at.to_reference(velocity, load[q] + 1);
      for (int e = 0; e < dim; ++e) load[q][1 + e] *= w * eps;
    }
    Lanes r[n] = {};
    shape.integrate(load, r);
    space.scatter(r, group, mass_residual);
  }
  mass_residual.compress(dealii::VectorOperation::add);
  for (int d = 0; d < dim; ++d) {
    integrals.change[d] += lane_sum(change[d]);
    integrals.exchange[d] += lane_sum(exchange[d]);
    integrals.pressure[d] += lane_sum(pressure[d]);
    integrals.share[d] += lane_sum(share_sum[d]);
    integrals.momentum[d] += lane_sum(momentum[d]);
  }
}

#define SEEDFLOW_PRESSURE(dim, degree)                                                                     \
  template void assemble_pressure_matrix(const NodalSpace<dim, degree>&, const StepCoefficients&,          \
                                         const FlowFields<dim>&, SparseMatrix&);                           \
  template double assemble_pressure_rhs(const NodalSpace<dim, degree>&, const StepCoefficients&,           \
                                        FlowFields<dim>&, NodalVector&);                                   \
  template StepIntegrals<dim> correct_velocity(const NodalSpace<dim, degree>&, const StepCoefficients&,    \
                                               FlowFields<dim>&, NodalVector&);                            \
  template void refine_velocity(const NodalSpace<dim, degree>&, const StepCoefficients&, FlowFields<dim>&, \
                                const NodalVector&, StepIntegrals<dim>&, NodalVector&);
SEEDFLOW_PRESSURE(2, 1)
SEEDFLOW_PRESSURE(3, 1)
SEEDFLOW_PRESSURE(2, 2)
SEEDFLOW_PRESSURE(3, 2)

}  // namespace seedflow
