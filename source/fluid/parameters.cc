#include "seedflow/fluid/parameters.h"

namespace seedflow {

void FluidParameters::declare(Parameters& p) {
  const auto section = p.section("Air", "Volume-averaged incompressible flow between the seeds.");
  p.number("Density", density, "kg/m3", Range::positive(), "Density of the air.");
  p.number("Dynamic viscosity", viscosity, "Pa s", Range::positive(), "Dynamic viscosity of the air.");
  p.choice("Formulation", formulation, {"A", "B"},
           "A: air and seeds share the pressure gradient by volume; B: all of it acts on the air.");
  p.choice(
      "Viscous stress", viscous_stress, {"laplacian", "full"},
      "laplacian: eps mu grad u, which gives the same flow where eps mu is uniform; full: eps mu (grad u + "
      "(grad u)^T - 2/3 div u), the added part of the extrapolated velocity.");
  p.text(
      "Boundary conditions", boundary_conditions,
      "Entries `side: type, values` separated by semicolons. Types: wall; moving wall, u; velocity inlet, u; "
      "pressure outlet, p; pressure inlet, p; slip; periodic. Values are numbers or expressions in x, y, z, "
      "t; "
      "`*` stands for all sides not named.");
  p.number("Eddy viscosity", eddy_viscosity, "1", Range::between(0, 2),
           "Strength of the eddy viscosity of the unresolved turbulence by the WALE model (Nicoud & Ducros "
           "1999, doi:10.1023/A:1009995426001); 0: none, 1: as published.");
  p.number("Eddy constant", eddy_constant, "1", Range::between(0, 1),
           "C_w of the WALE model; published: 0.5 (0.55 to 0.6 in isotropic turbulence).");
  p.choice(
      "Convecting velocity", convecting_velocity, {"extrapolated", "averaged"},
      "The velocity u* of the convection u*.grad u. extrapolated: of second order in the step. averaged: "
      "mean "
      "of the last two steps, of first order, for steps far longer than a flow that is given by pressures "
      "takes to adjust: there extrapolation overshoots from step to step.");
  p.number("Pressure stabilization", pressure_stabilization, "1", Range::between(0, 1),
           "Factor on the stabilisation of the pressure by orthogonal subscales.");
  p.choice(
      "Subscales", subscales, {"quasi-static", "dynamic"},
      "What the elements cannot hold of the velocity. quasi-static: the answer to the pressure gradient, "
      "as it stabilises the pressure. dynamic: the answer to all forces, with a memory (Codina et al. 2007, "
      "doi:10.1016/j.cma.2007.01.002), so that a force put into one cell moves that cell as it would with "
      "one velocity per cell (finite volumes).");
  p.number("Streamline upwinding", streamline_upwinding, "1", Range::between(0, 10),
           "Factor on the SUPG time scale.");
  declare_solver(p);
}

void FluidParameters::declare_solver(Parameters& p) {
  const auto section = p.section("Linear solver", "How the linear systems of a step are solved.");
  p.choice("Backend", backend, {"trilinos", "petsc"},
           "Algebraic multigrid of the pressure. trilinos: ML; petsc: BoomerAMG of hypre.");
  p.choice("Momentum preconditioner", momentum_preconditioner, {"jacobi", "ilu"},
           "jacobi is fastest while the Courant number is around 1; ilu (incomplete factors without fill) "
           "for large steps or strong viscosity.");
  p.number("Pressure tolerance", pressure_tolerance, "1", {1e-15, 0.1},
           "Residual over right-hand side of the pressure equation.");
  p.number("Momentum tolerance", momentum_tolerance, "1", {1e-15, 0.1},
           "Largest velocity residual over largest velocity.");
  p.integer("Largest number of iterations", max_iterations, Range::between(1, 100000),
            "More than this many iterations of a solver are an error.");
}

}  // namespace seedflow
