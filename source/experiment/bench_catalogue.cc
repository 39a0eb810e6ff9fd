#include "seedflow/experiment/experiment.h"
#include "seedflow/fluid/cavity_benchmark.h"
#include "seedflow/fluid/rotor_benchmark.h"
#include "seedflow/mesh/point_location_bench.h"
#include "seedflow/seeds/bench_seeds.h"

namespace seedflow {

namespace {

std::vector<BenchResult> seed_results(const std::string& name, const SeedBench& bench) {
  return {{name + "/rate", bench.rate, "sub-sphere-steps/s per core", bench.n_ranks},
          {name + "/memory", bench.bytes_per_sphere, "bytes per sub-sphere", bench.n_ranks},
          {name + "/contacts per seed", bench.contacts_per_seed, "1", bench.n_ranks},
          {name + "/kinetic energy", bench.kinetic_energy, "J per seed", bench.n_ranks},
          {name + "/steps per search", bench.substeps_per_search, "1", bench.n_ranks},
          {name + "/imbalance", bench.imbalance, "1", bench.n_ranks}};
}

std::vector<BenchResult> append(std::vector<BenchResult> a, const std::vector<BenchResult>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<BenchResult> seeds_bonded() {
  return seed_results("seeds-bonded", bench_heap({}, MPI_COMM_WORLD));
}

std::vector<BenchResult> seeds_rigid() {
  HeapBench small, large;
  small.rigid = large.rigid = true;
  small.n_seeds = 200, large.n_seeds = 2000;
  return append(seed_results("seeds-rigid, 200", bench_heap(small, MPI_COMM_WORLD)),
                seed_results("seeds-rigid, 2000", bench_heap(large, MPI_COMM_WORLD)));
}

std::vector<BenchResult> spheres() {
  HeapBench heap;
  heap.n_seeds = 10000, heap.n_sub_spheres = 1, heap.rigid = true;
  heap.time_step = 2e-6;
  return seed_results("spheres", bench_heap(heap, MPI_COMM_WORLD));
}

std::vector<BenchResult> drum() {
  return seed_results("drum", bench_drum(40, 2, MPI_COMM_WORLD));
}

std::vector<BenchResult> air() {
  const CavityBenchmark b = bench_cavity(40, 20, 0.01, "trilinos", MPI_COMM_WORLD);
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const FluidStatistics& s = b.statistics;
  return {{"air/rate", b.cell_steps_per_second_per_core, "cell-steps/s per core", ranks},
          {"air/memory", b.bytes_per_cell, "bytes per cell", ranks},
          {"air/courant number", b.courant_number, "1", ranks},
          {"air/pressure iterations", b.pressure_iterations, "per step", ranks},
          {"air/momentum iterations", b.momentum_iterations, "per step", ranks},
          {"air/momentum assembly", s.momentum_assembly / b.seconds, "of the time", ranks},
          {"air/momentum solve", s.momentum_solve / b.seconds, "of the time", ranks},
          {"air/pressure assembly", s.pressure_assembly / b.seconds, "of the time", ranks},
          {"air/pressure set-up", s.pressure_setup / b.seconds, "of the time", ranks},
          {"air/pressure solve", s.pressure_solve / b.seconds, "of the time", ranks},
          {"air/update", s.update / b.seconds, "of the time", ranks}};
}

std::vector<BenchResult> rotor() {
  const RotorBenchmark b = bench_rotor(64, 8, "trilinos", MPI_COMM_WORLD);
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return {{"rotor/turning", b.turning, "of the time", ranks},
          {"rotor/step", b.seconds_per_step, "s", ranks},
          {"rotor/rate", b.cells / b.seconds_per_step / ranks, "cell-steps/s per core", ranks},
          {"rotor/memory", b.bytes_per_cell, "bytes per cell", ranks},
          {"rotor/cells", b.cells, "1", ranks},
          {"rotor/interface faces", b.interface_faces, "1", ranks},
          {"rotor/pressure iterations", b.pressure_iterations, "per step", ranks},
          {"rotor/momentum iterations", b.momentum_iterations, "per step", ranks},
          {"rotor/multigrids built", b.preconditioners, "per step", ranks},
          {"rotor/mass residual", b.mass_residual, "1", ranks}};
}

std::vector<BenchResult> locate() {
  const PointLocationRate r = measure_point_location(MPI_COMM_SELF);
  return {{"locate/look-up", r.look_up_ms, "ms per coupling step"},
          {"locate/table", r.build_ms, "ms per mesh change"},
          {"locate/first look-up, hexahedra", r.hexahedra_first_ms, "ms per mesh change"},
          {"locate/look-up, hexahedra", r.hexahedra_look_up_ms, "ms per coupling step"},
          {"locate/table, hexahedra", r.hexahedra_build_ms, "ms per mesh change"},
          {"locate/points", static_cast<double>(r.n_points), "1"},
          {"locate/cells", static_cast<double>(r.n_cells), "1"}};
}

}  // namespace

std::vector<Bench> bench_catalogue() {
  return {
      {"air", "lid-driven cavity of 40^3 cells, implicit convection, pressure to 1e-6", air},
      {"rotor", "slab turning under another, 2 x 98,304 cells, sliding interface between them", rotor},
      {"seeds-bonded", "settled heap of 800 bonded seeds of 70 sub-spheres", seeds_bonded},
      {"seeds-rigid", "settled heaps of 200 and 2000 rigid seeds of 70 sub-spheres", seeds_rigid},
      {"spheres", "settled bed of 10,000 plain spheres", spheres},
      {"drum", "2,200 plain spheres in a drum at 40 turns a minute", drum},
      {"locate", "56,000 sub-spheres to the cells of an adaptive mesh of more than 50,000 cells", locate}};
}

}  // namespace seedflow
