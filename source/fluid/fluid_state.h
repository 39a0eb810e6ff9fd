#pragma once

#include "seedflow/fluid/boundary_data.h"
#include "seedflow/fluid/flow_kernels.h"
#include "seedflow/fluid/fluid.h"
#include "seedflow/fluid/krylov.h"
#include "seedflow/fluid/preconditioner.h"
#include "seedflow/fluid/sliding_coupling.h"

namespace seedflow {

/// Unknowns, history and linear systems of Fluid.
template <int dim, int degree>
struct Fluid<dim, degree>::Implementation {
  using Components = typename FlowFields<dim>::Components;
  static constexpr int n = NodalSpace<dim, degree>::n, n_q = NodalSpace<dim, degree>::n_q, W = lane_width;

  Implementation(const FluidParameters& parameters, Domain<dim>& domain,
                 const BoundaryConditions<dim>& conditions);

  /// Everything that depends on the mesh; fields become zero.
  void set_up();
  /// Sets u_old from the nodal velocity, forgets older history.
  void restart_from_nodal_velocity();
  /// int rho eps u and int rho eps |u| at the present time [N s], all ranks.
  std::pair<Vector, double> momentum_and_flow() const;

  // fluid_step.cc
  void advance(double dt, const Exchange<dim>& exchange);
  void take(const Exchange<dim>& exchange);
  void solve_momentum();
  void solve_pressure();
  /// u of the end of the step with its mass residual in scalar_rhs, boundary fluxes included; returns the
  /// integrals and the inflow.
  std::pair<StepIntegrals<dim>, double> correct();
  void finish_step();

  // fluid_balance.cc: what a step did, from its end velocity and pressure and the mass residual in
  // scalar_rhs.
  void book_mass(const StepIntegrals<dim>& integrals, double inflow);
  /// Shear, momentum carried through and pressure on every side, of this rank.
  void book_reactions();
  void book_momentum(const StepIntegrals<dim>& integrals);
  /// In closed domains only differences of pressure matter: the mean of the nodes becomes zero.
  void centre_pressure();

  // fluid_rotor.cc; all of it does nothing without a rotor.
  void turn_to(double angle);
  /// Velocity of the mesh, the rotating frame's force, and the lifting of the old pressure.
  void prepare_rotor();
  void couple_momentum();
  void couple_pressure();
  /// The flux across the interface of a velocity at the points, and what turning cylinders must not count.
  void subtract_interface_flux(const PointField& velocity, NodalVector& y);
  void lift(const NodalVector& p, PointField& jump);
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;

  double sum(double a) const { return dealii::Utilities::MPI::sum(a, domain.communicator()); }
  double max(double a) const { return dealii::Utilities::MPI::max(a, domain.communicator()); }

  /// One value per quadrature point into the kernels' order. Returns whether anything differs from `present`.
  bool load(const std::vector<double>& values, double when_empty, PointField& field,
            const PointField& present);
  std::vector<Vector> points(const PointField& field) const;

  const FluidParameters parameters;
  Domain<dim>& domain;
  const BoundaryConditions<dim> conditions;
  StepCoefficients coefficients;
  std::unique_ptr<NodalSpace<dim, degree>> space;
  std::unique_ptr<BoundaryData<dim, degree>> boundary;

  FlowFields<dim> fields;
  Components u_before;  ///< u~ of the step before the last, for the first guess
  NodalVector phi_before;
  Components rhs;
  NodalVector scalar_rhs, mass_defect;
  std::unique_ptr<SparseMatrix> momentum_matrix, pressure_matrix;
  std::unique_ptr<ComponentPreconditioner> momentum_preconditioner;
  std::unique_ptr<Preconditioner> pressure_preconditioner;
  std::vector<double> preconditioned_values;  ///< matrix the multigrid was built from; empty: the present one
  int iterations_when_built = 0;
  bool pressure_matrix_valid = false, multigrid_valid = false, multigrid_wanted = true;
  double pressure_target = 0;  ///< residual the pressure of this step is solved to [m^dim/s]
  double inertia_factor = 0;   ///< rho a0/dt the pressure matrix was assembled with

  std::unique_ptr<SlidingCoupling<dim, degree>> sliding;  ///< null without a rotor
  RotorMotion motion;
  double angle = 0;          ///< [rad]
  bool patch_valid = false;  ///< of the pressure matrix
  typename SlidingCoupling<dim, degree>::Momentum interface_terms;
  std::array<double, 2> interface_flow{};

  double domain_volume = 0;  ///< V [m^dim], all ranks
  /// The flow below which no balance can be judged, see MassBalance::flow.
  double smallest_flow() const { return 1e-8 * domain_volume / coefficients.time.dt; }
  double time = 0, dt_old = 0;
  int steps_since_start = 0;
  std::vector<double> side_outflow;  ///< of this rank, while a step ends [m^dim/s]
  MassBalance mass;
  MomentumBalance<dim> momentum_balance;
  Vector momentum;
  FluidStatistics statistics;
};

/// Adds the CPU time of a scope to a counter.
class CpuTimer {
 public:
  explicit CpuTimer(double& sum) : total(sum), start(now()) {}
  ~CpuTimer() { total += now() - start; }

 private:
  static double now() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
  }
  double& total;
  double start;
};

}  // namespace seedflow
