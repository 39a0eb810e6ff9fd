#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/numerics/data_out.h>

#include <istream>
#include <ostream>

#include "cell_point.h"
#include "fluid_state.h"

namespace seedflow {

namespace {

template <typename T>
void put(std::ostream& out, const T& a) {
  out.write(reinterpret_cast<const char*>(&a), sizeof(T));
}
template <typename T>
void put_array(std::ostream& out, const T* a, std::size_t n) {
  put(out, n);
  out.write(reinterpret_cast<const char*>(a), n * sizeof(T));
}
template <typename T>
void get(std::istream& in, T& a) {
  in.read(reinterpret_cast<char*>(&a), sizeof(T));
  if (!in) throw RunError("Air: the saved state ends too early. Resume from another checkpoint.");
}
std::size_t get_size(std::istream& in, std::size_t expected, const char* what) {
  std::size_t n = 0;
  get(in, n);
  if (n != expected)
    throw RunError(std::string("Air: the saved state does not fit the mesh (") + what + " has " +
                   std::to_string(n) + " values, " + std::to_string(expected) +
                   " expected). Resume with the saved mesh and rank count.");
  return n;
}
template <typename T>
void get_array(std::istream& in, T* a, std::size_t expected, const char* what) {
  get_size(in, expected, what);
  in.read(reinterpret_cast<char*>(a), expected * sizeof(T));
  if (!in) throw RunError("Air: the saved state ends too early. Resume from another checkpoint.");
}

void put(std::ostream& out, const PointField& f) {
  put(out, f.is_uniform());
  put_array(out, f.raw().data(), f.raw().size());
}
void get(std::istream& in, PointField& f, std::size_t size) {
  bool uniform = false;
  get(in, uniform);
  std::vector<Lanes> values(uniform ? 1 : size);
  get_array(in, values.data(), values.size(), "a field at the quadrature points");
  f.assign_raw(std::move(values), uniform);
}

}  // namespace

template <int dim, int degree>
void Fluid<dim, degree>::refine(
    const std::function<std::vector<double>(const QuadratureLayout<dim>&)>& void_fraction_on) {
  auto& s = *implementation;
  auto& mesh = s.domain.triangulation();
  const auto before = s.momentum_and_flow();
  mesh.prepare_coarsening_and_refinement();
  std::vector<const NodalVector*> moved;
  for (auto& u : s.fields.u) moved.push_back(&u);
  moved.push_back(&s.fields.p);
  for (const NodalVector* v : moved) v->update_ghost_values();
  dealii::parallel::distributed::SolutionTransfer<dim, NodalVector> transfer(s.space->dofs);
  transfer.prepare_for_coarsening_and_refinement(moved);
  if (s.sliding) s.domain.turn_to(0);
  mesh.execute_coarsening_and_refinement();
  s.domain.require_cells_for_all_ranks();
  s.space->rebuild(s.domain);
  s.set_up();
  std::vector<NodalVector*> target;
  for (auto& u : s.fields.u) target.push_back(&u);
  target.push_back(&s.fields.p);
  transfer.interpolate(target);
  for (NodalVector* v : target) {
    v->update_ghost_values();
    s.space->set_constrained(*v);
  }
  s.restart_from_nodal_velocity();
  s.load(void_fraction_on ? void_fraction_on(s.space->layout) : std::vector<double>(), 1.0, s.fields.eps_old,
         s.fields.eps_old);
  s.fields.eps_older = s.fields.eps_old;

  // Interpolation changes the momentum a little. What is missing is given back to the air in proportion to
  // its speed; the next projection makes mass exact again.
  const auto after = s.momentum_and_flow();
  if (!(after.second > 0)) return;
  for (std::size_t k = 0; k < s.space->n_groups * s.n_q; ++k) {
    Lanes u[dim];
    for (int d = 0; d < dim; ++d) u[d] = s.fields.u_old[k * dim + d];
    const Lanes speed = length<dim>(u);
    for (int d = 0; d < dim; ++d)
      s.fields.u_older.at(k * dim + d) = s.fields.u_old.at(k * dim + d) =
          u[d] + (before.first[d] - after.first[d]) / after.second * speed;
  }
}

template <int dim, int degree>
void Fluid<dim, degree>::save(std::ostream& out) const {
  const auto& s = *implementation;
  put(out, s.time);
  put(out, s.dt_old);
  put(out, s.steps_since_start);
  put(out, s.inertia_factor);
  put(out, s.pressure_matrix_valid);
  put(out, s.multigrid_valid);
  put(out, s.multigrid_wanted);
  put(out, s.iterations_when_built);
  put(out, s.angle);
  put(out, s.motion);
  const auto vector = [&](const NodalVector& v) { put_array(out, v.begin(), v.locally_owned_size()); };
  for (int d = 0; d < dim; ++d) {
    vector(s.fields.u[d]);
    vector(s.u_before[d]);
  }
  vector(s.fields.p);
  vector(s.fields.phi);
  vector(s.phi_before);
  for (const PointField* f : {&s.fields.eps_old, &s.fields.eps_older, &s.fields.beta}) put(out, *f);
  for (const PointField* f : {&s.fields.u_old, &s.fields.u_older}) put(out, *f);
  put_array(out, s.pressure_matrix->value.data(), s.pressure_matrix->value.size());
  put(out, s.preconditioned_values.empty());
  if (!s.preconditioned_values.empty())
    put_array(out, s.preconditioned_values.data(), s.preconditioned_values.size());
}

template <int dim, int degree>
void Fluid<dim, degree>::load(std::istream& in) {
  auto& s = *implementation;
  get(in, s.time);
  get(in, s.dt_old);
  get(in, s.steps_since_start);
  get(in, s.inertia_factor);
  get(in, s.pressure_matrix_valid);
  get(in, s.multigrid_valid);
  get(in, s.multigrid_wanted);
  get(in, s.iterations_when_built);
  double angle = 0;
  get(in, angle);
  get(in, s.motion);
  if (s.sliding) {
    s.turn_to(angle);
    s.multigrid_valid = false;  // its matrix, at another angle, is not kept: it is built anew
  }
  const auto vector = [&](NodalVector& v, bool constrain) {
    v.zero_out_ghost_values();
    get_array(in, v.begin(), v.locally_owned_size(), "a nodal field");
    v.update_ghost_values();
    if (constrain) s.space->set_constrained(v);
  };
  for (int d = 0; d < dim; ++d) {
    vector(s.fields.u[d], true);
    vector(s.u_before[d], true);
  }
  vector(s.fields.p, true);
  vector(s.fields.phi, true);
  vector(s.phi_before, true);
  const std::size_t points = s.space->n_groups * s.n_q;
  for (PointField* f : {&s.fields.eps_old, &s.fields.eps_older, &s.fields.beta}) get(in, *f, points);
  for (PointField* f : {&s.fields.u_old, &s.fields.u_older}) get(in, *f, points * dim);
  auto& value = s.pressure_matrix->value;
  get_array(in, value.data(), value.size(), "the pressure matrix");
  bool current = true;
  get(in, current);
  s.preconditioned_values.clear();
  if (!current) {
    s.preconditioned_values.resize(value.size());
    get_array(in, s.preconditioned_values.data(), value.size(), "the multigrid's matrix");
  }
  if (s.multigrid_valid) {
    // The same multigrid as before: of the matrix it was built from then.
    if (!current) value.swap(s.preconditioned_values);
    s.pressure_preconditioner->build(*s.pressure_matrix, s.boundary->pressure_fixed,
                                     !s.boundary->has_open_side);
    if (!current) value.swap(s.preconditioned_values);
  }
}

template <int dim, int degree>
std::string Fluid<dim, degree>::write(const std::string& directory, const std::string& name,
                                      unsigned int counter) const {
  const auto& s = *implementation;
  // DataOut wants a vector in one finite element function.
  const dealii::FESystem<dim> fe(s.space->fe, dim + 1);
  dealii::DoFHandler<dim> dofs(s.domain.triangulation());
  dofs.distribute_dofs(fe);
  NodalVector solution(dofs.locally_owned_dofs(), dealii::DoFTools::extract_locally_relevant_dofs(dofs),
                       s.domain.communicator());
  std::vector<dealii::types::global_dof_index> ids(fe.n_dofs_per_cell());
  dealii::Vector<float> void_fraction(s.domain.triangulation().n_active_cells());
  std::size_t c = 0;
  for (const auto& cell : dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    const std::size_t group = s.space->place[c] / s.W, l = s.space->place[c] % s.W;
    cell->get_dof_indices(ids);
    for (unsigned int k = 0; k < ids.size(); ++k) {
      if (!dofs.locally_owned_dofs().is_element(ids[k])) continue;
      const auto [component, i] = fe.system_to_component_index(k);
      const NodalVector& from = component < dim ? s.fields.u[component] : s.fields.p;
      solution(ids[k]) = from.local_element(s.space->node[(group * s.n + i) * s.W + l]);
    }
    double mean = 0;
    for (int q = 0; q < s.n_q; ++q)
      mean += s.fields.eps_old[group * s.n_q + q][l] * s.space->layout.JxW[c * s.n_q + q];
    void_fraction[cell->active_cell_index()] = mean / s.space->layout.cell_volume[c];
    ++c;
  }
  solution.update_ghost_values();
  using Interpretation = dealii::DataComponentInterpretation::DataComponentInterpretation;
  std::vector<std::string> names(dim, "velocity");
  std::vector<Interpretation> kinds(dim, dealii::DataComponentInterpretation::component_is_part_of_vector);
  names.push_back("pressure");
  kinds.push_back(dealii::DataComponentInterpretation::component_is_scalar);
  dealii::DataOut<dim> out;
  out.attach_dof_handler(dofs);
  out.add_data_vector(solution, names, dealii::DataOut<dim>::type_dof_data, kinds);
  out.add_data_vector(void_fraction, "void_fraction", dealii::DataOut<dim>::type_cell_data);
  out.build_patches(s.domain.mapping(), degree);
  return out.write_vtu_with_pvtu_record(directory.back() == '/' ? directory : directory + "/", name, counter,
                                        s.domain.communicator(), 5);
}

#define SEEDFLOW_STORAGE(dim, degree)                                           \
  template void Fluid<dim, degree>::refine(                                     \
      const std::function<std::vector<double>(const QuadratureLayout<dim>&)>&); \
  template void Fluid<dim, degree>::save(std::ostream&) const;                  \
  template void Fluid<dim, degree>::load(std::istream&);                        \
  template std::string Fluid<dim, degree>::write(const std::string&, const std::string&, unsigned int) const;
SEEDFLOW_STORAGE(2, 1)
SEEDFLOW_STORAGE(3, 1)
SEEDFLOW_STORAGE(2, 2)
SEEDFLOW_STORAGE(3, 2)

}  // namespace seedflow
