#include "seedflow/seeds/bench_seeds.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>

#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

double cpu_time() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

SeedBench bench(bool rigid, bool packed, double seconds) {
  const SeedTemplate model = make_seed_template({});
  DemParameters parameters;
  Dem dem(parameters);
  const int material = dem.add_material({});
  dem.add_template(model, material, rigid);

  const int per_edge[3] = {10, 10, 8};
  const double spacing = 2 * model.bounding_radius * (packed ? 1.0 : 1.5);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&](double size) {
    return size * Vec3{uniform(random), uniform(random), uniform(random)};
  };
  for (int i = 0; i < per_edge[0]; ++i)
    for (int j = 0; j < per_edge[1]; ++j)
      for (int k = 0; k < per_edge[2]; ++k)
        dem.add_seed(0, spacing * Vec3{i + 0.5, j + 0.5, k + 0.5}, rotation(vector(2)),
                     vector(packed ? 0.05 : 0.3), vector(20));
  dem.add_box({0, 0, 0}, spacing * Vec3{1.0 * per_edge[0], 1.0 * per_edge[1], 1.0 * per_edge[2]}, material);

  // Rounds of 100 substeps, the length of a coupling step of 1e-4 s; the median round is reported.
  const double duration = 100 * parameters.time_step;
  dem.advance(duration);
  std::vector<double> rates;
  const double start = cpu_time();
  double last = start;
  while (last - start < seconds || rates.size() < 3) {
    dem.advance(duration);
    const double present = cpu_time();
    rates.push_back(100.0 * dem.n_spheres() / (present - last));
    last = present;
  }
  std::nth_element(rates.begin(), rates.begin() + rates.size() / 2, rates.end());

  SeedBench result;
  result.n_seeds = dem.n_seeds();
  result.n_spheres = dem.n_spheres();
  result.n_bonds_per_seed = static_cast<int>(model.bond.size());
  result.lane_width = lane_width;
  result.n_substeps = dem.n_substeps();
  result.rate = rates[rates.size() / 2];
  result.bytes_per_sphere = static_cast<double>(dem.bytes()) / dem.n_spheres();
  result.contacts_per_seed = static_cast<double>(dem.n_contacts()) / dem.n_seeds();
  return result;
}

}  // namespace

SeedBench bench_seeds_bonded(bool packed, double seconds) {
  return bench(false, packed, seconds);
}
SeedBench bench_seeds_rigid(bool packed, double seconds) {
  return bench(true, packed, seconds);
}

}  // namespace seedflow
