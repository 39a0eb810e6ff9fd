#include "seedflow/fluid/fluid.h"

#include "cell_point.h"
#include "fluid_state.h"

namespace seedflow {

template <int dim, int degree>
Fluid<dim, degree>::Implementation::Implementation(const FluidParameters& p, Domain<dim>& d,
                                                   const BoundaryConditions<dim>& c)
    : parameters(p), domain(d), conditions(c) {
  check_boundary_conditions(conditions, domain);
  domain.require_cells_for_all_ranks();
  coefficients.density = p.density;
  coefficients.viscosity = p.viscosity;
  coefficients.model_a = p.formulation == "A";
  coefficients.dynamic_subscales = p.subscales == "dynamic";
  coefficients.full_stress = p.viscous_stress == "full";
  coefficients.stabilization = p.pressure_stabilization;
  coefficients.upwinding = p.streamline_upwinding;
  coefficients.eddy_viscosity = p.eddy_viscosity * p.eddy_constant * p.eddy_constant;
  coefficients.degree = degree;
  if (domain.rotor()) {
    if (coefficients.full_stress)
      throw InputError("Air/Viscous stress: full is not available with a rotor. Use laplacian.");
    angle = domain.angle();
    domain.turn_to(0);
  }
  space = std::make_unique<NodalSpace<dim, degree>>(domain);
  set_up();
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::set_up() {
  boundary = std::make_unique<BoundaryData<dim, degree>>(*space, domain, conditions);
  for (int d = 0; d < dim; ++d)
    for (NodalVector* v : {&fields.u[d], &fields.y[d], &u_before[d], &rhs[d]}) space->initialize(*v);
  if (coefficients.dynamic_subscales)
    for (NodalVector& z : fields.z) space->initialize(z);
  for (NodalVector* v : {&fields.p, &fields.phi, &phi_before, &scalar_rhs, &mass_defect})
    space->initialize(*v);
  for (PointField* f : {&fields.eps, &fields.eps_old, &fields.eps_older}) f->set_uniform(1.0);
  for (PointField* f : {&fields.beta, &fields.source}) f->set_uniform(0.0);
  const std::size_t points = space->n_groups * n_q;
  fields.u_old.resize(points * dim, 0.0);
  fields.u_older.resize(points * dim, 0.0);
  fields.theta.resize(points, 0.0);
  domain_volume = domain.volume();
  momentum_matrix = std::make_unique<SparseMatrix>(space->structure);
  pressure_matrix = std::make_unique<SparseMatrix>(space->structure);
  momentum_preconditioner = make_component_preconditioner(parameters.momentum_preconditioner);
  pressure_preconditioner = make_multigrid(parameters.backend);
  preconditioned_values.clear();
  pressure_matrix_valid = multigrid_valid = false;
  multigrid_wanted = true;
  steps_since_start = 0;
  sliding.reset();
  if (!domain.rotor()) return;
  for (PointField* f : {&fields.jump_p, &fields.jump_phi, &fields.mesh_velocity, &fields.predicted})
    f->resize(points * dim, 0.0);
  fields.viscosity.resize(points, 0.0);
  sliding = std::make_unique<SlidingCoupling<dim, degree>>(*space, domain);
  turn_to(angle);
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::restart_from_nodal_velocity() {
  for (std::size_t group = 0; group < space->n_groups; ++group)
    for (int d = 0; d < dim; ++d) {
      Lanes u[n];
      space->gather(fields.u[d], group, u);
      for (int q = 0; q < n_q; ++q) {
        const std::size_t k = (group * n_q + q) * dim + d;
        fields.u_old.at(k) = fields.u_older.at(k) = space->shape.interpolate(q, 0, u);
      }
    }
  steps_since_start = 0;
}

template <int dim, int degree>
std::pair<dealii::Tensor<1, dim>, double> Fluid<dim, degree>::Implementation::momentum_and_flow() const {
  Lanes sum[dim + 1] = {};
  for (std::size_t group = 0; group < space->n_groups; ++group)
    for (int q = 0; q < n_q; ++q) {
      const std::size_t k = group * n_q + q;
      const Lanes mass = coefficients.density * fields.eps_old[k] * space->weight(group, q);
      const Lanes* u = &fields.u_old[k * dim];
      for (int d = 0; d < dim; ++d) sum[d] += mass * u[d];
      sum[dim] += mass * length<dim>(u);
    }
  double total[dim + 1];
  for (int d = 0; d <= dim; ++d) total[d] = lane_sum(sum[d]);
  MPI_Allreduce(MPI_IN_PLACE, total, dim + 1, MPI_DOUBLE, MPI_SUM, domain.communicator());
  Vector momentum;
  for (int d = 0; d < dim; ++d) momentum[d] = total[d];
  return {momentum, total[dim]};
}

template <int dim, int degree>
bool Fluid<dim, degree>::Implementation::load(const std::vector<double>& values, double when_empty,
                                              PointField& field, const PointField& present) {
  if (values.empty()) {
    const bool same = present.is_uniform() && present[0][0] == when_empty;
    field.set_uniform(when_empty);
    return !same;
  }
  if (values.size() != space->layout.size())
    throw RunError("Air: " + std::to_string(values.size()) + " values given for " +
                   std::to_string(space->layout.size()) + " quadrature points; use Fluid::layout().");
  bool changed = field.is_uniform() && &field == &present;
  if (field.is_uniform()) field.resize(space->n_groups * n_q);
  for (std::size_t group = 0; group < space->n_groups; ++group)
    for (int l = 0; l < W; ++l) {
      const double* from = values.data() + std::size_t(space->cell[group * W + l]) * n_q;
      for (int q = 0; q < n_q; ++q) {
        const std::size_t k = group * n_q + q;
        changed = changed || present[k][l] != from[q];
        field.at(k)[l] = from[q];
      }
    }
  return changed;
}

template <int dim, int degree>
std::vector<dealii::Tensor<1, dim>> Fluid<dim, degree>::Implementation::points(
    const PointField& field) const {
  std::vector<Vector> result(space->layout.size());
  for (std::size_t c = 0; c < space->place.size(); ++c) {
    const std::size_t group = space->place[c] / W, l = space->place[c] % W;
    for (int q = 0; q < n_q; ++q)
      for (int d = 0; d < dim; ++d) result[c * n_q + q][d] = field[(group * n_q + q) * dim + d][l];
  }
  return result;
}

template <int dim, int degree>
Fluid<dim, degree>::Fluid(const FluidParameters& p, Domain<dim>& domain)
    : Fluid(p, domain, parse_boundary_conditions(p.boundary_conditions, domain)) {}

template <int dim, int degree>
Fluid<dim, degree>::Fluid(const FluidParameters& p, Domain<dim>& domain,
                          const BoundaryConditions<dim>& conditions)
    : implementation(std::make_unique<Implementation>(p, domain, conditions)) {}

template <int dim, int degree>
Fluid<dim, degree>::~Fluid() = default;
template <int dim, int degree>
Fluid<dim, degree>::Fluid(Fluid&&) noexcept = default;

template <int dim, int degree>
const QuadratureLayout<dim>& Fluid<dim, degree>::layout() const {
  return implementation->space->layout;
}

template <int dim, int degree>
void Fluid<dim, degree>::set_initial(double time,
                                     const std::function<Vector(const dealii::Point<dim>&)>& velocity,
                                     const std::function<double(const dealii::Point<dim>&)>& pressure,
                                     const std::vector<double>& void_fraction) {
  auto& s = *implementation;
  s.time = time;
  const auto& support = s.space->fe.get_unit_support_points();
  const auto& partitioner = *s.space->structure->partitioner;
  std::vector<dealii::types::global_dof_index> ids(s.n);
  for (const auto& cell : s.space->dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell->get_dof_indices(ids);
    for (int i = 0; i < s.n; ++i) {
      if (!partitioner.in_local_range(ids[i])) continue;
      const auto node = partitioner.global_to_local(ids[i]);
      const auto x = s.domain.mapping().transform_unit_to_real_cell(cell, support[i]);
      const Vector u = velocity(x);
      for (int d = 0; d < dim; ++d) s.fields.u[d].local_element(node) = u[d];
      s.fields.p.local_element(node) = pressure(x);
    }
  }
  const auto consistent = [&](NodalVector& v) {
    v.update_ghost_values();
    s.space->set_constrained(v);
  };
  for (auto& u : s.fields.u) consistent(u);
  consistent(s.fields.p);
  s.restart_from_nodal_velocity();
  // At the points the given velocity itself, not its interpolant.
  for (std::size_t c = 0; c < s.space->place.size(); ++c)
    for (int q = 0; q < s.n_q; ++q) {
      const Vector u = velocity(s.space->layout.position[c * s.n_q + q]);
      for (int d = 0; d < dim; ++d)
        s.fields.u_old.at((s.space->place[c] / s.W * s.n_q + q) * dim + d)[s.space->place[c] % s.W] = u[d];
    }
  s.load(void_fraction, 1.0, s.fields.eps_old, s.fields.eps_old);
  s.fields.eps_older = s.fields.eps_old;
  s.pressure_matrix_valid = false;
}

template <int dim, int degree>
void Fluid<dim, degree>::advance(double dt, const Exchange<dim>& exchange) {
  implementation->advance(dt, exchange);
}
template <int dim, int degree>
double Fluid<dim, degree>::time() const {
  return implementation->time;
}
template <int dim, int degree>
const MassBalance& Fluid<dim, degree>::mass_balance() const {
  return implementation->mass;
}
template <int dim, int degree>
const MomentumBalance<dim>& Fluid<dim, degree>::momentum_balance() const {
  return implementation->momentum_balance;
}
template <int dim, int degree>
typename Fluid<dim, degree>::Vector Fluid<dim, degree>::momentum() const {
  return implementation->momentum;
}
template <int dim, int degree>
const FluidStatistics& Fluid<dim, degree>::statistics() const {
  return implementation->statistics;
}

template class Fluid<2, 1>;
template class Fluid<3, 1>;
template class Fluid<2, 2>;
template class Fluid<3, 2>;

}  // namespace seedflow
