#include "cell_point.h"
#include "seedflow/fluid/eddy_viscosity.h"

namespace seedflow {

namespace {

/// Dynamic viscosity with that of the eddies of the velocity `u` (nodal values of the cells) [Pa s].
template <int dim, int degree>
Lanes viscosity_at(const NodalSpace<dim, degree>& space, const StepCoefficients& c, const CellPoint<dim>& at,
                   int q, const Lanes (&u)[dim][NodalSpace<dim, degree>::n]) {
  if (c.eddy_viscosity == 0) return broadcast(c.viscosity);
  Lanes g[dim][dim];
  for (int d = 0; d < dim; ++d) gradient(space, at, q, u[d], g[d]);
  // Delta = volume^(1/dim)/k; unused lanes have no volume.
  const Lanes volume = at.weight / space.shape.weight[q];
  const Lanes edge = dim == 3 ? lane_cbrt(volume) : lane_sqrt(volume);
  const Lanes width2 = edge * edge / double(degree * degree);
  return c.viscosity + c.density * c.eddy_viscosity * width2 * wale_rate<dim>(g);
}

template <int dim, int degree, bool dynamic>
void project_terms(const NodalSpace<dim, degree>& space, const StepCoefficients& c, FlowFields<dim>& fields) {
  constexpr int n_values = dynamic ? 2 * dim : dim;
  const double rate = c.density / c.time.dt;
  constexpr int n = NodalSpace<dim, degree>::n, n_q = NodalSpace<dim, degree>::n_q;
  NodalVector denominator(fields.p);
  denominator = 0;
  std::vector<NodalVector*> results;
  for (int d = 0; d < dim; ++d) results.push_back(&fields.y[d]);
  if (dynamic)
    for (int d = 0; d < dim; ++d) results.push_back(&fields.z[d]);
  for (NodalVector* v : results) {
    v->zero_out_ghost_values();
    *v = 0;
  }
  fields.p.update_ghost_values();
  for (std::size_t group = 0; group < space.n_groups; ++group) {
    Lanes p[n];
    space.gather(fields.p, group, p);
    Lanes m[n_q], mean{}, volume{};
    for (int q = 0; q < n_q; ++q) {
      const std::size_t k = group * n_q + q;
      m[q] = c.inertia(fields.eps[k], fields.beta[k]);
      const Lanes w = space.weight(group, q);
      mean += m[q] * w;
      volume += w;
    }
    // Unused lanes repeat a cell with weight zero; they must not divide by it.
    mean = volume > broadcast(0.0) ? mean / volume : m[0];
    Lanes load[n_values][n] = {}, mass[n] = {};
    for (int q = 0; q < n_q; ++q) {
      const CellPoint<dim> at(space, group, q);
      const std::size_t k = group * n_q + q;
      Lanes g[dim], value[n_values];
      gradient(space, at, q, p, g);
      for (int d = 0; d < dim; ++d) g[d] += fields.jump_p[k * dim + d];
      const Lanes weight_m = (degree == 1 ? m[q] : mean) * at.weight, weight = weight_m / m[q];
      for (int d = 0; d < dim; ++d) {
        value[d] = weight * c.share(fields.eps[k]) * g[d];
        if constexpr (dynamic) {
          value[d] -= weight * fields.source[k * dim + d];
          value[dim + d] = weight * past_momentum(fields, k, d, rate, c.time.old * fields.eps_old[k],
                                                  c.time.older * fields.eps_older[k]);
        }
      }
      for (int i = 0; i < n; ++i) {
        mass[i] += space.shape.test[q][0][i] * weight_m;
        for (int v = 0; v < n_values; ++v) load[v][i] += space.shape.test[q][0][i] * value[v];
      }
    }
    space.scatter(mass, group, denominator);
    for (std::size_t v = 0; v < results.size(); ++v) space.scatter(load[v], group, *results[v]);
  }
  denominator.compress(dealii::VectorOperation::add);
  for (NodalVector* v : results) {
    v->compress(dealii::VectorOperation::add);
    for (std::uint32_t i = 0; i < space.structure->n_owned(); ++i)
      if (!space.constrained[i]) v->local_element(i) /= denominator.local_element(i);
    v->update_ghost_values();
    space.set_constrained(*v);
  }
}

}  // namespace

template <int dim, int degree>
void project_explicit_terms(const NodalSpace<dim, degree>& space, const StepCoefficients& c,
                            FlowFields<dim>& fields) {
  if (c.dynamic_subscales)
    project_terms<dim, degree, true>(space, c, fields);
  else
    project_terms<dim, degree, false>(space, c, fields);
}

template <int dim, int degree>
void assemble_momentum(const NodalSpace<dim, degree>& space, const StepCoefficients& c,
                       FlowFields<dim>& fields, SparseMatrix& matrix,
                       typename FlowFields<dim>::Components& rhs, NodalVector* mass_defect) {
  constexpr int n = NodalSpace<dim, degree>::n, n_q = NodalSpace<dim, degree>::n_q;
  const auto& shape = space.shape;
  const TimeScheme& time = c.time;
  const double rate = c.density / time.dt;
  if (fields.theta.raw().size() != space.n_groups * n_q) fields.theta.resize(space.n_groups * n_q);
  matrix.set_zero();
  for (auto& r : rhs) r = 0;
  if (mass_defect) *mass_defect = 0;

  for (std::size_t group = 0; group < space.n_groups; ++group) {
    Lanes p[n], y[dim][n];
    space.gather(fields.p, group, p);
    for (int d = 0; d < dim; ++d) gather_projected(space, c, fields, group, d, y[d]);
    Lanes u[dim][n];
    if (c.full_stress || c.eddy_viscosity > 0)
      for (int d = 0; d < dim; ++d) space.gather(fields.u[d], group, u[d]);

    Lanes mass[n_q], carry[n_q], react[n_q], upwind[n_q], viscous[n_q][dim][dim], w_ref[n_q][dim];
    Lanes load[dim][n_q][dim + 1], outflow[n_q][dim + 1];
    for (int q = 0; q < n_q; ++q) {
      const CellPoint<dim> at(space, group, q);
      const std::size_t k = group * n_q + q;
      const Lanes eps = fields.eps[k], beta = fields.beta[k];
      const Lanes old = time.old * fields.eps_old[k], older = time.older * fields.eps_older[k];
      Lanes w[dim];
      for (int d = 0; d < dim; ++d)
        w[d] = time.extrapolate_old * fields.u_old[k * dim + d] +
               time.extrapolate_older * fields.u_older[k * dim + d] - fields.mesh_velocity[k * dim + d];
      at.to_reference(w, w_ref[q]);
      const Lanes speed_by_h = length<dim>(w_ref[q]), inverse_h2 = at.inverse_h2();
      const Lanes m = c.inertia(eps, beta), share = c.share(eps);
      const Lanes mu = viscosity_at<dim, degree>(space, c, at, q, u);
      const Lanes theta = c.theta(m, eps, mu, speed_by_h, inverse_h2);
      fields.theta.at(k) = theta;
      if (!fields.viscosity.is_uniform()) fields.viscosity.at(k) = mu;
      upwind[q] = c.upwind_time(eps, beta, mu, speed_by_h, inverse_h2);

      mass[q] = m * at.weight;
      carry[q] = c.density * eps * at.weight;
      react[q] = (beta - rate * (old + older)) * at.weight;
      at.metric(viscous[q]);
      for (int e = 0; e < dim; ++e)
        for (int f = 0; f < dim; ++f) viscous[q][e][f] *= mu * eps * at.weight;

      Lanes g[dim];
      gradient(space, at, q, p, g);
      for (int d = 0; d < dim; ++d) {
        g[d] += fields.jump_p[k * dim + d];
        const Lanes projected = shape.interpolate(q, 0, y[d]);
        const Lanes terms = subscale_terms(c.dynamic_subscales, fields, k, d, share * g[d], rate, old, older);
        Lanes f = -(terms * (1.0 - theta) + m * theta * projected);
        if (!c.dynamic_subscales)
          f += fields.source[k * dim + d] - past_momentum(fields, k, d, rate, old, older);
        f *= at.weight;
        load[d][q][0] = f;
        for (int e = 0; e < dim; ++e) load[d][q][1 + e] = upwind[q] * w_ref[q][e] * f;
      }
      if (c.full_stress) {
        Lanes slope[dim][dim], divergence{};
        for (int d = 0; d < dim; ++d) {
          gradient(space, at, q, u[d], slope[d]);
          divergence += slope[d][d];
        }
        for (int d = 0; d < dim; ++d) {
          Lanes stress[dim], reference[dim];
          for (int a = 0; a < dim; ++a)
            stress[a] = -mu * eps * at.weight * (slope[a][d] - (a == d ? 2.0 / 3.0 : 0.0) * divergence);
          at.to_reference(stress, reference);
          for (int e = 0; e < dim; ++e) load[d][q][1 + e] += reference[e];
        }
      }
      outflow[q][0] = -at.weight * (time.now * eps + old + older) / time.dt;
      for (int e = 0; e < dim; ++e) outflow[q][1 + e] = at.weight * eps * w_ref[q][e];
    }

    Lanes cell_matrix[n * n];
    for (int j = 0; j < n; ++j) {
      Lanes trial[n_q][dim + 1];
      for (int q = 0; q < n_q; ++q) {
        const double value = shape.test[q][0][j];
        Lanes along = w_ref[q][0] * shape.test[q][1][j];
        for (int e = 1; e < dim; ++e) along += w_ref[q][e] * shape.test[q][1 + e][j];
        const Lanes s = upwind[q] * (react[q] * value + carry[q] * along) - carry[q] * value;
        trial[q][0] = mass[q] * value;
        for (int e = 0; e < dim; ++e) {
          Lanes t = w_ref[q][e] * s;
          for (int f = 0; f < dim; ++f) t += viscous[q][e][f] * shape.test[q][1 + f][j];
          trial[q][1 + e] = t;
        }
      }
      Lanes column[n] = {};
      shape.integrate(trial, column);
      for (int i = 0; i < n; ++i) cell_matrix[i * n + j] = column[i];
    }
    space.scatter(cell_matrix, group, matrix);
    for (int d = 0; d < dim; ++d) {
      Lanes r[n] = {};
      shape.integrate(load[d], r);
      space.scatter(r, group, rhs[d]);
    }
    if (mass_defect) {
      Lanes r[n] = {};
      shape.integrate(outflow, r);
      space.scatter(r, group, *mass_defect);
    }
  }
  matrix.compress();
  for (auto& r : rhs) r.compress(dealii::VectorOperation::add);
  if (mass_defect) mass_defect->compress(dealii::VectorOperation::add);
}

#define SEEDFLOW_MOMENTUM(dim, degree)                                                                       \
  template void project_explicit_terms(const NodalSpace<dim, degree>&, const StepCoefficients&,              \
                                       FlowFields<dim>&);                                                    \
  template void assemble_momentum(const NodalSpace<dim, degree>&, const StepCoefficients&, FlowFields<dim>&, \
                                  SparseMatrix&, FlowFields<dim>::Components&, NodalVector*);
SEEDFLOW_MOMENTUM(2, 1)
SEEDFLOW_MOMENTUM(3, 1)
SEEDFLOW_MOMENTUM(2, 2)
SEEDFLOW_MOMENTUM(3, 2)

}  // namespace seedflow
