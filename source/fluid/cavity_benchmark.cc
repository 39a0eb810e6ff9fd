#include "seedflow/fluid/cavity_benchmark.h"

#include <algorithm>
#include <ctime>

namespace seedflow {

CavityBenchmark bench_cavity(int cells, int steps, double dt, const std::string& backend, MPI_Comm comm) {
  DomainParameters box;
  const int refinements = cells % 8 == 0 ? 3 : 0;
  box.refinements = refinements;
  box.cells.assign(3, cells >> refinements);
  Domain<3> domain(box, comm);
  FluidParameters parameters;
  parameters.density = 1;
  parameters.viscosity = 1e-3;
  parameters.backend = backend;
  parameters.pressure_tolerance = 1e-6;
  parameters.momentum_tolerance = 1e-5;
  parameters.boundary_conditions = "top: moving wall, 1, 0, 0; *: wall";
  Fluid<3, 1> fluid(parameters, domain);
  const Exchange<3> nothing;
  for (int i = 0; i < 5; ++i) fluid.advance(dt, nothing);

  CavityBenchmark result;
  const FluidStatistics before = fluid.statistics();
  const std::clock_t start = std::clock();
  for (int i = 0; i < steps; ++i) {
    fluid.advance(dt, nothing);
    result.pressure_iterations += double(fluid.statistics().pressure_iterations) / steps;
    result.momentum_iterations += double(fluid.statistics().momentum_iterations) / steps;
    result.mass_residual = std::max(result.mass_residual, fluid.mass_balance().largest);
  }
  result.seconds = dealii::Utilities::MPI::max(double(std::clock() - start) / CLOCKS_PER_SEC, comm);
  const double n_cells = domain.triangulation().n_global_active_cells();
  result.cell_steps_per_second_per_core =
      n_cells * steps / result.seconds / dealii::Utilities::MPI::n_mpi_processes(comm);
  result.bytes_per_cell = fluid.bytes_per_cell();
  result.courant_number = fluid.courant_number(dt);
  result.statistics = fluid.statistics();
  auto& s = result.statistics;
  s.momentum_assembly -= before.momentum_assembly;
  s.momentum_solve -= before.momentum_solve;
  s.pressure_assembly -= before.pressure_assembly;
  s.pressure_setup -= before.pressure_setup;
  s.pressure_solve -= before.pressure_solve;
  s.update -= before.update;
  return result;
}

}  // namespace seedflow
