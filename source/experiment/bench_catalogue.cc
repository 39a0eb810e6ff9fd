#include "seedflow/experiment/experiment.h"
#include "seedflow/mesh/point_location_bench.h"
#include "seedflow/seeds/bench_seeds.h"

namespace seedflow {

namespace {

std::vector<BenchResult> seed_results(const std::string& name, const SeedBench& bench) {
  return {{name + "/rate", bench.rate, "sub-sphere-steps/s per core"},
          {name + "/memory", bench.bytes_per_sphere, "bytes per sub-sphere"},
          {name + "/contacts per seed", bench.contacts_per_seed, "1"}};
}

std::vector<BenchResult> append(std::vector<BenchResult> a, const std::vector<BenchResult>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<BenchResult> seeds_bonded() {
  return append(seed_results("seeds-bonded", bench_seeds_bonded()),
                seed_results("seeds-bonded, packed", bench_seeds_bonded(true)));
}

std::vector<BenchResult> locate() {
  const PointLocationRate r = measure_point_location(MPI_COMM_SELF);
  return {{"locate/look-up", r.look_up_ms, "ms per coupling step"},
          {"locate/table", r.build_ms, "ms per mesh change"},
          {"locate/points", static_cast<double>(r.n_points), "1"},
          {"locate/cells", static_cast<double>(r.n_cells), "1"}};
}

}  // namespace

std::vector<Bench> bench_catalogue() {
  return {{"seeds-bonded", "800 bonded seeds of 70 sub-spheres: bonds, motion, contact search", seeds_bonded},
          {"locate", "56,000 sub-spheres to the cells of an adaptive mesh of 50,000 cells", locate}};
}

}  // namespace seedflow
