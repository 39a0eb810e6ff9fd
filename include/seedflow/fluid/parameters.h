#pragma once

#include <string>

#include "seedflow/base/parameters.h"

namespace seedflow {

/// What a user sets of the air: section "Air".
struct FluidParameters {
  double density = 1.2;           ///< rho [kg/m3]
  double viscosity = 1.8e-5;      ///< mu, dynamic [Pa s]
  std::string formulation = "A";  ///< A: pressure gradient shared by air and seeds; B: all on the air
  std::string boundary_conditions = "*: wall";

  std::string viscous_stress = "laplacian";  ///< laplacian: eps mu grad u; full: with transpose and trace

  double eddy_viscosity = 0;   ///< strength of the WALE model, 0: none (see fluid/eddy_viscosity.h)
  double eddy_constant = 0.5;  ///< C_w [1]

  /// extrapolated: that of second order, 2 u^n - u^(n-1); averaged: (u^n + u^(n-1))/2, see TimeScheme
  std::string convecting_velocity = "extrapolated";

  double pressure_stabilization = 1;       ///< factor on theta, 0..1 (see fluid/step_coefficients.h)
  std::string subscales = "quasi-static";  ///< quasi-static: of the pressure only; dynamic: of all forces
  double streamline_upwinding = 1;         ///< factor on the SUPG time scale

  std::string backend = "trilinos";                ///< trilinos: multigrid ML; petsc: BoomerAMG
  std::string momentum_preconditioner = "jacobi";  ///< jacobi, or ilu
  double pressure_tolerance = 1e-9;                ///< residual / right-hand side, 2-norm
  double momentum_tolerance = 1e-11;  ///< diagonally scaled residual / velocity, largest component
  int max_iterations = 1000;

  void declare(Parameters& parameters);
  /// The section "Linear solver" alone, for users that choose the rest themselves.
  void declare_solver(Parameters& parameters);
};

}  // namespace seedflow
