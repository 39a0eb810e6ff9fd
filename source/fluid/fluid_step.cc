#include <algorithm>
#include <cmath>
#include <sstream>

#include "fluid_state.h"

namespace seedflow {

namespace {

/// Largest factor between an entry of the diagonal and its older value; 1 without older values.
double largest_change(const SparseMatrix& matrix, const std::vector<double>& older) {
  double factor = 1;
  if (older.empty()) return factor;
  for (const std::uint32_t k : matrix.structure().diagonal) {
    const double a = matrix.value[k], b = older[k];
    if (a > 0 && b > 0) factor = std::max({factor, a / b, b / a});
  }
  return factor;
}

}  // namespace

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::fail(const std::string& what, const std::string& remedy) const {
  std::ostringstream message;
  message << "Air, step from t = " << time << " s with dt = " << coefficients.time.dt << " s: " << what << " "
          << remedy;
  throw RunError(message.str());
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::advance(double dt, const Exchange<dim>& exchange) {
  coefficients.time = TimeScheme::bdf1(dt);
  if (!(dt > 0) || !std::isfinite(dt)) fail("the time step is not a positive number.", "Give dt > 0.");
  if (steps_since_start > 0) coefficients.time = TimeScheme::bdf2(dt, dt_old);
  if (steps_since_start > 0 && parameters.convecting_velocity == "averaged")
    coefficients.time = coefficients.time.averaged();
  take(exchange);
  prepare_rotor();
  solve_momentum();
  solve_pressure();
  finish_step();
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::take(const Exchange<dim>& exchange) {
  const CpuTimer timer(statistics.update);
  bool changed = load(exchange.void_fraction, 1.0, fields.eps, fields.eps_old);
  // beta is overwritten in place: compared with itself before.
  changed = load(exchange.drag_coefficient, 0.0, fields.beta, fields.beta) || changed;
  const std::size_t points = space->n_groups * n_q;
  const bool forced = !exchange.drag_source.empty() || !exchange.force.empty();
  if (!forced) {
    fields.source.set_uniform(0.0);
  } else {
    for (const auto* given : {&exchange.drag_source, &exchange.force})
      if (!given->empty() && given->size() != space->layout.size())
        throw RunError("Air: forces are given for " + std::to_string(given->size()) +
                       " quadrature points of " + std::to_string(space->layout.size()) +
                       "; use Fluid::layout().");
    if (fields.source.is_uniform()) fields.source.resize(points * dim, 0.0);
    for (std::size_t group = 0; group < space->n_groups; ++group)
      for (int l = 0; l < W; ++l)
        for (int q = 0; q < n_q; ++q) {
          const std::size_t from = std::size_t(space->cell[group * W + l]) * n_q + q;
          for (int d = 0; d < dim; ++d)
            fields.source.at((group * n_q + q) * dim + d)[l] =
                (exchange.drag_source.empty() ? 0.0 : exchange.drag_source[from][d]) +
                (exchange.force.empty() ? 0.0 : exchange.force[from][d]);
        }
  }
  // What could not be used is found before it spreads; all ranks learn of it.
  double bad[3] = {};
  for (const double e : exchange.void_fraction) bad[0] += !(e > 0 && e <= 1 + 1e-12);
  for (const double b : exchange.drag_coefficient) bad[1] += !(b >= 0 && std::isfinite(b));
  for (const Lanes& f : fields.source.raw())
    for (int l = 0; l < W; ++l) bad[2] += !std::isfinite(f[l]);
  MPI_Allreduce(MPI_IN_PLACE, bad, 3, MPI_DOUBLE, MPI_SUM, domain.communicator());
  if (bad[0] > 0)
    fail("the void fraction is outside (0, 1] at " + std::to_string(int(bad[0])) + " quadrature points.",
         "Widen the kernel of the void fraction or coarsen the air mesh.");
  if (bad[1] > 0)
    fail("the drag coefficient is negative or not finite at " + std::to_string(int(bad[1])) +
             " quadrature points.",
         "Check the drag law.");
  if (bad[2] > 0) fail("a force on the air is not finite.", "Check the effects that act on the seeds.");

  const double factor = coefficients.density * coefficients.time.now / coefficients.time.dt;
  if (changed || factor != inertia_factor) pressure_matrix_valid = false;
  inertia_factor = factor;
  pressure_matrix_valid = -max(-double(pressure_matrix_valid)) > 0;  // the same decision on all ranks
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::solve_momentum() {
  {
    const CpuTimer timer(statistics.momentum_assembly);
    for (int d = 0; d < dim; ++d) {
      // First guess: extrapolated. Its ghosts are dropped while it is written.
      fields.u[d].zero_out_ghost_values();
      u_before[d].zero_out_ghost_values();
      if (steps_since_start > 1) {
        u_before[d].sadd(coefficients.time.extrapolate_older, coefficients.time.extrapolate_old, fields.u[d]);
        u_before[d].swap(fields.u[d]);
      } else {
        u_before[d] = fields.u[d];
      }
    }
    boundary->set_velocity(time + coefficients.time.dt, fields.u);
    if (coefficients.full_stress || coefficients.eddy_viscosity > 0)
      for (auto& u : fields.u) {
        u.update_ghost_values();
        space->set_constrained(u);
      }
    project_explicit_terms(*space, coefficients, fields);
    if (coefficients.dynamic_subscales) {
      // The past is of the kind -M u: where the velocity is given, so is its projection.
      boundary->set_velocity(time + coefficients.time.dt, fields.z, -1.0);
      for (auto& z : fields.z) {
        z.update_ghost_values();
        space->set_constrained(z);
      }
    }
    assemble_momentum(*space, coefficients, fields, *momentum_matrix, rhs,
                      boundary->has_open_side ? &mass_defect : nullptr);
    couple_momentum();
    // Momentum carried through open sides: the outflow of each node times its velocity.
    for (const auto& node : boundary->fixed_pressure) {
      double& out = mass_defect.local_element(node.node);
      out *= coefficients.density;
      if (!boundary->is_inlet(node.side)) out = std::max(out, 0.0);
      momentum_matrix->value[space->structure->diagonal[node.node]] += out;
    }
  }
  const CpuTimer timer(statistics.momentum_solve);
  NodalVector* x[dim];
  const NodalVector* b[dim];
  const std::vector<char>* fixed[dim];
  for (int d = 0; d < dim; ++d) {
    x[d] = &fields.u[d];
    b[d] = &rhs[d];
    fixed[d] = &boundary->velocity_fixed[d];
  }
  momentum_preconditioner->build(*momentum_matrix);
  statistics.momentum_iterations =
      stabilized_biconjugate_gradients(*momentum_matrix, *momentum_preconditioner, dim, fixed, x, b,
                                       parameters.momentum_tolerance, parameters.max_iterations);
  if (statistics.momentum_iterations < 0) {
    double bad = 0;
    for (const auto& u : fields.u) bad += !std::isfinite(u.l1_norm());
    if (bad > 0)
      fail("the velocity is not finite.",
           "Check that the boundary conditions give numbers at this time; reduce the time step.");
    fail("the momentum equation was not solved in " + std::to_string(parameters.max_iterations) +
             " iterations.",
         "Reduce the time step, or set Air/Linear solver/Momentum preconditioner to ilu.");
  }
  for (auto& u : fields.u) {
    u.update_ghost_values();
    space->set_constrained(u);
  }
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::solve_pressure() {
  const bool singular = !boundary->has_open_side;
  double scale = 0, inflow = 0;
  {
    const CpuTimer timer(statistics.pressure_assembly);
    if (!pressure_matrix_valid) {
      if (multigrid_valid && preconditioned_values.empty()) preconditioned_values = pressure_matrix->value;
      assemble_pressure_matrix(*space, coefficients, fields, *pressure_matrix);
      pressure_matrix_valid = true;
      patch_valid = false;
    }
    couple_pressure();
    scale = std::sqrt(sum(assemble_pressure_rhs(*space, coefficients, fields, scalar_rhs)));
    subtract_interface_flux(fields.predicted, scalar_rhs);
    inflow = sum(boundary->subtract_flux(fields.u, fields.eps, scalar_rhs));
    scalar_rhs.compress(dealii::VectorOperation::add);
  }
  if (singular) {
    double imbalance = 0;
    for (std::uint32_t i = 0; i < space->structure->n_owned(); ++i) imbalance += scalar_rhs.local_element(i);
    imbalance = sum(imbalance);
    if (std::abs(imbalance) > 1e-8 * std::max({inflow, scale, smallest_flow()})) {
      std::ostringstream what;
      what << "the domain is closed, but inflow and change of void volume differ by " << imbalance
           << " m3/s.";
      fail(what.str(), "Give one side a pressure outlet.");
    }
  }
  {
    const CpuTimer timer(statistics.pressure_setup);
    // A solid body that moves to other cells makes the multigrid useless there at once.
    if (!multigrid_valid || multigrid_wanted ||
        max(largest_change(*pressure_matrix, preconditioned_values)) > 10) {
      pressure_preconditioner->build(*pressure_matrix, boundary->pressure_fixed, singular);
      preconditioned_values.clear();
      multigrid_valid = true;
      ++statistics.preconditioners_built;
      iterations_when_built = -1;
      multigrid_wanted = false;
    }
  }
  const CpuTimer timer(statistics.pressure_solve);
  fields.phi.zero_out_ghost_values();
  phi_before.zero_out_ghost_values();
  const auto& fixed = boundary->pressure_fixed;
  if (steps_since_start > 2) {
    phi_before.sadd(-1.0, 2.0, fields.phi);
    phi_before.swap(fields.phi);
  } else {
    phi_before = fields.phi;
  }
  if (steps_since_start == 0) fields.phi = 0;
  boundary->set_pressure(time + coefficients.time.dt, fields.phi);
  for (const auto& node : boundary->fixed_pressure)
    fields.phi.local_element(node.node) -= fields.p.local_element(node.node);
  // Relative to the right-hand side of the equation for the whole pressure, |b + A p_old|, and to the flow
  // through the cells, whichever is less, both with the flow that a change of the given pressures drives (all
  // there is when air at rest starts to move); not below round-off.
  NodalVector given(fields.phi);
  for (std::uint32_t i = 0; i < space->structure->n_owned(); ++i)
    if (!fixed[i] || space->constrained[i]) given.local_element(i) = 0;
  given.update_ghost_values();
  double squares[2] = {};
  for (std::uint32_t i = 0; i < space->structure->n_owned(); ++i)
    if (!fixed[i]) {
      const double driven = pressure_matrix->row_times(i, given);
      squares[0] += std::pow(scalar_rhs.local_element(i) + pressure_matrix->row_times(i, fields.p), 2);
      squares[1] += driven * driven;
    }
  const double whole = std::sqrt(sum(squares[0])), driven = std::sqrt(sum(squares[1]));
  const double least = 1e-15 * std::max(scale, driven);
  const double tolerance = std::max(
      parameters.pressure_tolerance * std::min(std::max(whole, driven), std::max(scale, driven)), least);
  pressure_target = std::max(2 * tolerance, 100 * least);
  const auto solve = [&] {
    return conjugate_gradients(*pressure_matrix, *pressure_preconditioner, fixed, singular, fields.phi,
                               scalar_rhs, tolerance, parameters.max_iterations);
  };
  int iterations = solve();
  if (iterations < 0 && !preconditioned_values.empty()) {  // the preconditioner belongs to an older matrix
    pressure_preconditioner->build(*pressure_matrix, fixed, singular);
    preconditioned_values.clear();
    ++statistics.preconditioners_built;
    fields.phi = phi_before;
    boundary->set_pressure(time + coefficients.time.dt, fields.phi);
    for (const auto& node : boundary->fixed_pressure)
      fields.phi.local_element(node.node) -= fields.p.local_element(node.node);
    iterations = solve();
    iterations_when_built = -1;
  }
  if (iterations < 0)
    fail("the pressure equation was not solved in " + std::to_string(parameters.max_iterations) +
             " iterations.",
         "Check the void fraction for values near 0, reduce the time step, or try the other backend.");
  statistics.pressure_iterations = iterations;
  if (iterations_when_built < 0) iterations_when_built = iterations;
  multigrid_wanted = !preconditioned_values.empty() && iterations > iterations_when_built * 3 / 2 + 3;
  fields.phi.update_ghost_values();
  space->set_constrained(fields.phi);
}

template <int dim, int degree>
std::pair<StepIntegrals<dim>, double> Fluid<dim, degree>::Implementation::correct() {
  lift(fields.phi, fields.jump_phi);
  StepIntegrals<dim> integrals = correct_velocity(*space, coefficients, fields, scalar_rhs);
  const auto subtract_flux = [&] {
    side_outflow.assign(boundary->names.size(), 0.0);
    const double inflow = boundary->subtract_flux(fields.u, fields.eps, scalar_rhs, &side_outflow);
    subtract_interface_flux(fields.u_older, scalar_rhs);
    scalar_rhs.compress(dealii::VectorOperation::add);
    return inflow;
  };
  const double inflow = subtract_flux();
  const auto residual = [&] {
    double square = 0;
    for (std::uint32_t i = 0; i < space->structure->n_owned(); ++i)
      if (!boundary->pressure_fixed[i]) square += std::pow(scalar_rhs.local_element(i), 2);
    return std::sqrt(sum(square));
  };
  // Where a large pressure meets freely moving air (the front of a bed with strong drag), the round-off of
  // the pressure alone moves that air. Its effect is seen in the velocity, which is known to full precision,
  // and taken out by a further, small pressure, whose own round-off does not matter.
  NodalVector psi;
  double left = residual();
  for (int pass = 0; pass < 3 && left > pressure_target; ++pass) {
    space->initialize(psi);
    statistics.pressure_iterations +=
        std::max(0, conjugate_gradients(*pressure_matrix, *pressure_preconditioner, boundary->pressure_fixed,
                                        !boundary->has_open_side, psi, scalar_rhs, 0.5 * pressure_target,
                                        parameters.max_iterations));
    psi.update_ghost_values();
    space->set_constrained(psi);
    lift(psi, fields.jump_phi);
    refine_velocity(*space, coefficients, fields, psi, integrals, scalar_rhs);
    subtract_flux();
    fields.phi.zero_out_ghost_values();
    psi.zero_out_ghost_values();
    fields.phi += psi;
    const double before = left;
    left = residual();
    if (left > 0.5 * before) break;  // as far as the velocity's own round-off allows
  }
  return {integrals, inflow};
}

template <int dim, int degree>
void Fluid<dim, degree>::Implementation::finish_step() {
  const CpuTimer timer(statistics.update);
  const auto [integrals, inflow] = correct();
  fields.p.zero_out_ghost_values();
  fields.phi.zero_out_ghost_values();
  fields.p += fields.phi;
  fields.p.update_ghost_values();
  book_mass(integrals, inflow);
  book_momentum(integrals);
  if (sliding) interface_flow = sliding->flow(fields.eps, fields.u_older);
  centre_pressure();
  space->set_constrained(fields.p);

  std::swap(fields.u_older, fields.u_old);
  std::swap(fields.eps_older, fields.eps_old);
  std::swap(fields.eps_old, fields.eps);
  time += coefficients.time.dt;
  dt_old = coefficients.time.dt;
  ++steps_since_start;
}

template struct Fluid<2, 1>::Implementation;
template struct Fluid<3, 1>::Implementation;
template struct Fluid<2, 2>::Implementation;
template struct Fluid<3, 2>::Implementation;

}  // namespace seedflow
