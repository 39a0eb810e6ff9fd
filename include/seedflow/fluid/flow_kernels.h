#pragma once

#include <array>

#include "seedflow/fluid/nodal_space.h"
#include "seedflow/fluid/point_field.h"
#include "seedflow/fluid/sparse_matrix.h"
#include "seedflow/fluid/step_coefficients.h"

namespace seedflow {

/// What the kernels of a step read and write. Vectors at points are stored component by component,
/// [(group n_q + point) dim + component].
template <int dim>
struct FlowFields {
  using Components = std::array<NodalVector, dim>;
  PointField eps{1.0}, eps_old{1.0}, eps_older{1.0};  ///< void fraction at the new time and before
  PointField beta{0.0};                               ///< drag coefficient [kg/(m3 s)]
  PointField source{0.0};                             ///< drag source + force [N/m3]
  PointField u_old{0.0}, u_older{0.0};                ///< velocities that satisfy mass [m/s]
  PointField theta{0.0};                              ///< pressure stabilisation, set by assemble_momentum
  // Zero everywhere unless a part of the mesh turns: what lifting the jumps across the sliding interface adds
  // to grad p and grad phi, the velocity of the mesh, and u~ less stabilisation, kept for its flux there.
  PointField jump_p{0.0}, jump_phi{0.0}, mesh_velocity{0.0}, predicted{0.0};
  PointField viscosity{0.0};  ///< with that of eddies [Pa s], set by assemble_momentum if not uniform
  Components u;               ///< u~; extrapolated before the momentum is solved [m/s]
  Components y;               ///< projection of kappa grad p [m/s], see unresolved()
  Components z;               ///< dynamic subscales only: projection of the past [m/s]
  NodalVector p, phi;         ///< old pressure and its increment [Pa]
};

/// y = (int c grad p q_i) / (int M q_i), and with dynamic subscales
/// y = (int (c grad p - S - f) q_i) / (int M q_i),  z = (int rho (a1 eps u^n + a2 eps u^{n-1})/dt q_i) / (int
/// M q_i). For degree > 1, where shape functions change sign, M is taken as its mean over each cell in all
/// integrals.
template <int dim, int degree>
void project_explicit_terms(const NodalSpace<dim, degree>& space, const StepCoefficients& coefficients,
                            FlowFields<dim>& fields);

/// Gradients of the pressure include the lifting of jumps, and all fluxes are relative to the mesh: eps u
/// stands for eps (u - u_mesh) in what follows.

/// The momentum equation for u~: matrix (one for all components), right-hand sides, and, if `mass_defect` is
/// not null, int eps w.grad q_i - int q_i d(eps)/dt of the extrapolated velocity w, which on open sides is
/// the outflow.
template <int dim, int degree>
void assemble_momentum(const NodalSpace<dim, degree>& space, const StepCoefficients& coefficients,
                       FlowFields<dim>& fields, SparseMatrix& matrix,
                       typename FlowFields<dim>::Components& rhs, NodalVector* mass_defect);

/// int eps kappa grad q_i . grad q_j
template <int dim, int degree>
void assemble_pressure_matrix(const NodalSpace<dim, degree>& space, const StepCoefficients& coefficients,
                              const FlowFields<dim>& fields, SparseMatrix& matrix);

/// int eps (u~ - theta (kappa grad p - y)).grad q_i - int q_i d(eps)/dt. Returns sum over cells of
/// (int eps |J^-1 u~|)^2 + (int |d(eps)/dt|)^2 on this rank: the square of the scale of that vector.
template <int dim, int degree>
double assemble_pressure_rhs(const NodalSpace<dim, degree>& space, const StepCoefficients& coefficients,
                             FlowFields<dim>& fields, NodalVector& rhs);

/// Integrals over this rank's cells after a step.
template <int dim>
struct StepIntegrals {
  double change[dim] = {}, exchange[dim] = {}, pressure[dim] = {}, share[dim] = {}, momentum[dim] = {};
  double circulation = 0;  ///< int eps |u|
  double growth = 0;       ///< sum over cells |int d(eps)/dt|
};

/// The velocity of the end of the step at the points, into fields.u_older (which is no longer needed; the
/// caller swaps it with u_old), and its mass residual without boundary fluxes, int eps u.grad q_i - int q_i
/// d(eps)/dt.
template <int dim, int degree>
StepIntegrals<dim> correct_velocity(const NodalSpace<dim, degree>& space,
                                    const StepCoefficients& coefficients, FlowFields<dim>& fields,
                                    NodalVector& mass_residual);

/// Takes kappa grad(psi), with the lifting of its jumps in fields.jump_phi, from the velocity of the end of
/// the step (in fields.u_older, after correct_velocity), adds what that changes to the integrals (all but
/// circulation and growth), and computes the mass residual of the result, again without boundary fluxes.
template <int dim, int degree>
void refine_velocity(const NodalSpace<dim, degree>& space, const StepCoefficients& coefficients,
                     FlowFields<dim>& fields, const NodalVector& psi, StepIntegrals<dim>& integrals,
                     NodalVector& mass_residual);

}  // namespace seedflow
