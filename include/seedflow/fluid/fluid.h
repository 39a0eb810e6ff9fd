#pragma once

#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "seedflow/fluid/boundary_conditions.h"
#include "seedflow/fluid/exchange.h"
#include "seedflow/fluid/parameters.h"
#include "seedflow/mesh/domain.h"
#include "seedflow/mesh/quadrature_layout.h"

namespace seedflow {

/// Is mass kept? R_i = int eps u.grad q_i - int q_i d(eps)/dt - boundary flux, for every pressure shape
/// function q_i.
struct MassBalance {
  double largest = 0;  ///< max_i |R_i| / flow
  double total = 0;    ///< |sum_i R_i| / flow
  /// The flow through the domain [m^dim/s]: the largest of the inflow through the sides, the change of void
  /// volume sum |int d(eps)/dt|, and the circulation int eps |u| / V^(1/dim). At least 1e-8 of the domain's
  /// volume V per step: eps is known to 1e-16, so of a smaller flow no balance can be known to 1e-8.
  double flow = 0;
  /// Per side that is open or has a given velocity: net volume flow out of it [m^dim/s]; and, of open sides,
  /// the power oint p u.n that leaves with it [W]: what a fan must add is minus their sum.
  std::map<std::string, double> outflow, power;
};

/// Where the momentum goes in one step [N, in 2D N/m]; change = exchange + pressure + sum of reactions +
/// residual.
template <int dim>
struct MomentumBalance {
  using Vector = dealii::Tensor<1, dim>;
  Vector change;  ///< d/dt int rho eps u by the time scheme
  /// int (drag_source - drag_coefficient u + force), u of the end of the step; with a frozen rotor also
  /// - rho eps omega x u
  Vector exchange;
  Vector pressure;  ///< -int c grad p, c = eps (model A) or 1 (model B)
  /// Model A: int (1 - eps) grad p, what the air gains because the seeds bear their share of the pressure
  /// gradient.
  Vector pressure_share;
  /// Per side: what the side does to the air by shear and by momentum carried through it.
  std::map<std::string, Vector> reaction;
  // The parts of sliding sides without partner count as walls, under the first pair's names.
  /// Per side: -oint p n. Their sum plus pressure_share is `pressure`.
  std::map<std::string, Vector> pressure_force;
  double residual = 0;  ///< what is left, relative to the largest term
  /// With a rotor, per side: moment about its axis of the shear forces [N m, in 2D N], on rotor walls with
  /// the part of the stress that the Laplacian form leaves out; not of walls at the sliding interface nor of
  /// pressure.
  std::map<std::string, double> torque;
};

/// How the part of the mesh that turns is treated (Domain::set_rotor).
struct RotorMotion {
  /// frozen: the mesh stands at its angle and the flow is that relative to the turning rotor (multiple
  /// reference frames): convection relative to it, d/dt in its frame, so + rho eps omega x u in its cells.
  /// sliding: the mesh turns (arbitrary Lagrangian-Eulerian); Fluid::turn_to before every step.
  enum class Mode { frozen, sliding };
  Mode mode = Mode::frozen;
  double speed = 0;  ///< angular velocity omega about Rotor::axis [rad/s]
};

struct FluidStatistics {
  int momentum_iterations = 0, pressure_iterations = 0;  ///< of the last step
  int preconditioners_built = 0;
  /// CPU seconds on this rank since construction.
  double momentum_assembly = 0, momentum_solve = 0, pressure_assembly = 0, pressure_setup = 0,
         pressure_solve = 0, update = 0;
  double turning = 0;  ///< of the sliding interface: lookup, couplings and their part of the matrices
};

/// The air: volume-averaged incompressible Navier-Stokes (Anderson & Jackson 1967, doi:10.1021/i160024a007)
///   d(eps)/dt + div(eps u) = 0
///   d(rho eps u)/dt + div(rho eps u u) = -c grad p + div(eps mu grad u) + S - beta u + f,  c = eps (A) or 1
///   (B)
/// (or the full stress, eps mu (grad u + (grad u)^T - 2/3 div u)) on Q_k elements for velocity and pressure,
/// BDF2 with variable step (BDF1 first and after refinement), SUPG, and a projection implicit in the drag.
/// With M = rho a0 eps/dt + beta and w the extrapolated velocity of the past:
///   1. u~ (nodal) from the momentum equation with pressure gradient  g = c grad p_old - M theta (kappa grad
///   p_old - y)
///   2. u = u~ - kappa grad(phi) - theta (kappa grad p_old - y),  kappa = c/M,  phi = p - p_old
///      from  int eps u.grad q - oint eps u.n q - int q d(eps)/dt = 0  for every q of the pressure space.
/// y is the nodal (lumped, M-weighted) projection of kappa grad p_old: theta times the fluctuation is the
/// pressure stabilisation (orthogonal subscales, Codina 2001, doi:10.1016/S0168-9274(01)00053-1). With
/// dynamic subscales (Codina et al. 2007, doi:10.1016/j.cma.2007.01.002) the forces and the past of u are
/// treated like the pressure gradient, so that u keeps what the nodal u~ cannot hold. u, given at the
/// quadrature points and discontinuous between cells, is the velocity that satisfies mass; it carries seeds,
/// enters the time derivative and feels the drag. Steps 1 + 2 sum to the momentum equation with u in time
/// derivative and drag and the full grad p: so the momentum budget closes whatever theta is.
template <int dim, int degree = 1>
class Fluid {
 public:
  using Vector = dealii::Tensor<1, dim>;

  /// Errors: InputError (conditions, parameters).
  Fluid(const FluidParameters& parameters, Domain<dim>& domain);
  Fluid(const FluidParameters& parameters, Domain<dim>& domain, const BoundaryConditions<dim>& conditions);
  ~Fluid();
  Fluid(Fluid&&) noexcept;

  const QuadratureLayout<dim>& layout() const;

  /// Velocity [m/s], pressure [Pa] and void fraction (per quadrature point; empty = 1) at time t [s];
  /// restarts with a first-order step.
  void set_initial(double time, const std::function<Vector(const dealii::Point<dim>&)>& velocity,
                   const std::function<double(const dealii::Point<dim>&)>& pressure,
                   const std::vector<double>& void_fraction = {});

  /// With a rotor in the domain: how it moves. Errors: InputError without one.
  void set_rotor_motion(const RotorMotion& motion);
  /// Turns the rotor to this angle [rad], that of the end of the next step; before its `exchange` is
  /// computed, because the points of layout() turn too. All ranks.
  void turn_to(double angle);

  /// One step of size dt [s]. Empty arrays in `exchange` mean none (void fraction 1).
  /// Errors: RunError for a void fraction outside (0, 1], negative drag coefficient, NaN, a solver that does
  /// not converge, a closed domain whose inflow does not balance the change of void volume.
  void advance(double dt, const Exchange<dim>& exchange);
  double time() const;

  // At the quadrature points, after a step.
  std::vector<Vector> velocity() const;           ///< u, satisfies mass [m/s]
  std::vector<Vector> pressure_gradient() const;  ///< grad p [Pa/m]
  std::vector<Vec3> vorticity() const;       ///< curl u~ [1/s]; in 2D only its z component differs from 0
  std::vector<Vector> acceleration() const;  ///< Du~/Dt = (u - u_old)/dt + u.grad u~ [m/s2]

  const MassBalance& mass_balance() const;
  /// Volume flow out of the rotor and into the stator through the sliding interface, each from the equations
  /// of its own side [m^dim/s].
  std::array<double, 2> interface_flow() const;
  const MomentumBalance<dim>& momentum_balance() const;
  Vector momentum() const;  ///< int rho eps u [kg m/s]
  const FluidStatistics& statistics() const;
  double courant_number(double dt) const;  ///< max over points of |J^-1 u| dt * degree, all ranks
  double bytes_per_cell() const;

  /// Velocity u~ [m/s] and pressure [Pa] at a place; `inside` is false outside the mesh.
  struct Sample {
    bool inside = false;
    Vector velocity;
    double pressure = 0;
  };
  /// At the same points on all ranks; collective, for reports (the search is made anew in every call).
  std::vector<Sample> sample(const std::vector<dealii::Point<dim>>& points) const;

  /// Largest difference of nodal velocities within each cell of layout() [m/s]; for refinement.
  std::vector<double> velocity_jump() const;

  /// Errors against a known solution, all ranks (L2 norms): of u, u~, and p (mean removed if no side fixes
  /// p).
  struct Errors {
    double velocity = 0, nodal_velocity = 0, pressure = 0;
  };
  Errors errors(const std::function<Vector(const dealii::Point<dim>&)>& velocity,
                const std::function<double(const dealii::Point<dim>&)>& pressure) const;

  /// Refines and coarsens the cells flagged in the domain's triangulation (both are changed here), moves
  /// velocity and pressure to the new mesh. `void_fraction_on` is called with the new layout and returns eps
  /// at the present time there (empty = 1). The next step is first order.
  void refine(const std::function<std::vector<double>(const QuadratureLayout<dim>&)>& void_fraction_on);

  /// The whole state of this rank, binary; load() needs the same domain (see Domain::save) on as many ranks.
  /// Continuing from load() equals never having stopped, to the last bit.
  void save(std::ostream& out) const;
  void load(std::istream& in);

  /// Writes u~, p and cell-mean void fraction as <directory>/<name>_<counter>.pvtu with its pieces; returns
  /// that file's name.
  std::string write(const std::string& directory, const std::string& name, unsigned int counter) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};

}  // namespace seedflow
