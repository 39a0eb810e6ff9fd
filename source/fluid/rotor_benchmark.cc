#include "seedflow/fluid/rotor_benchmark.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "seedflow/fluid/fluid.h"

namespace seedflow {

namespace {

/// Two slabs with vertices of their own in the plane z = 0; the lower one, material 1, turns.
void two_slabs(int n, dealii::Triangulation<3>& mesh) {
  std::vector<dealii::Point<3>> vertices;
  std::vector<dealii::CellData<3>> cells;
  const int layers = 3 * n / 8;
  for (int slab = 0; slab < 2; ++slab) {
    const unsigned int offset = vertices.size(), row = n + 1;
    for (int k = 0; k <= layers; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
          vertices.emplace_back(4.0 * i / n - 2, 4.0 * j / n - 2, 4.0 * (k - (slab == 0 ? layers : 0)) / n);
    for (int k = 0; k < layers; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          dealii::CellData<3> cell;
          for (int v = 0; v < 8; ++v)
            cell.vertices[v] = offset + ((k + (v >> 2)) * row + j + (v >> 1 & 1)) * row + i + (v & 1);
          cell.material_id = slab == 0;
          cells.push_back(cell);
        }
  }
  mesh.create_triangulation(vertices, cells, dealii::SubCellData());
  const double depth = 4.0 * layers / n;
  for (const auto& cell : mesh.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary()) continue;
      const bool turns = cell->material_id() == 1;
      const double z = cell->face(f)->center()[2];
      int id = turns ? 0 : 1;
      if (std::abs(z) < 1e-9) id = turns ? 2 : 3;
      if (std::abs(std::abs(z) - depth) < 1e-9) id = turns ? 4 : 5;
      cell->face(f)->set_boundary_id(id);
    }
}

/// Largest resident memory of this process so far [bytes].
double peak_memory() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * usage.ru_maxrss;
}

}  // namespace

RotorBenchmark bench_rotor(int n, int steps, const std::string& backend, MPI_Comm comm) {
  const double memory = peak_memory();
  dealii::Triangulation<3> coarse;
  two_slabs(n, coarse);
  Domain<3> domain(coarse,
                   {{0, "rotor wall"},
                    {1, "stator wall"},
                    {2, "rotor top"},
                    {3, "stator bottom"},
                    {4, "floor"},
                    {5, "lid"}},
                   {}, comm);
  Rotor<3> rotor;
  rotor.pairs = {{"rotor top", "stator bottom"}};
  domain.set_rotor(rotor);
  FluidParameters parameters;
  parameters.density = 1;
  parameters.viscosity = 1e-2;
  parameters.backend = backend;
  parameters.pressure_tolerance = 1e-6;
  parameters.momentum_tolerance = 1e-5;
  parameters.boundary_conditions =
      "rotor wall: rotor wall; floor: velocity inlet, 0, 0, 1; lid: pressure outlet, 0; *: wall";
  Fluid<3, 1> fluid(parameters, domain);
  const double dt = 2.0 / n, turn = 0.1 * (4.0 / n) / 2.0;
  fluid.set_rotor_motion({RotorMotion::Mode::sliding, turn / dt});
  int step = 0;
  const auto advance = [&] {
    fluid.turn_to(turn * ++step);
    fluid.advance(dt, {});
  };
  for (int i = 0; i < 4; ++i) advance();

  RotorBenchmark result;
  const FluidStatistics before = fluid.statistics();
  const std::clock_t start = std::clock();
  for (int i = 0; i < steps; ++i) {
    advance();
    result.pressure_iterations += double(fluid.statistics().pressure_iterations) / steps;
    result.momentum_iterations += double(fluid.statistics().momentum_iterations) / steps;
    result.mass_residual = std::max(result.mass_residual, fluid.mass_balance().largest);
  }
  const double seconds = dealii::Utilities::MPI::max(double(std::clock() - start) / CLOCKS_PER_SEC, comm);
  result.seconds_per_step = seconds / steps;
  result.turning = dealii::Utilities::MPI::max(fluid.statistics().turning - before.turning, comm) / seconds;
  result.preconditioners =
      double(fluid.statistics().preconditioners_built - before.preconditioners_built) / steps;
  result.cells = domain.triangulation().n_global_active_cells();
  result.bytes_per_cell = dealii::Utilities::MPI::sum(peak_memory() - memory, comm) / result.cells;
  result.interface_faces = 2.0 * n * n;
  return result;
}

}  // namespace seedflow
