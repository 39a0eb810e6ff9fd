#include "seedflow/seeds/bench_seeds.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "seedflow/seeds/packing_random.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {
namespace {

constexpr double diameter = 4e-3;

double cpu_time() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

SeedTemplate plain_sphere() {
  SeedTemplate t;
  t.name = "sphere";
  t.position.push_back({});
  t.radius.push_back(diameter / 2);
  t.seed_volume = M_PI / 6 * diameter * diameter * diameter;
  t.seed_density = 1340;
  t.seed_semi_axes = Vec3{diameter / 2, diameter / 2, diameter / 2};
  t.finish();
  return t;
}

/// Rounds of 100 substeps, the length of a coupling step of 1e-4 s; the median round counts.
SeedBench measure(Dem& dem, double time_step, double seconds, MPI_Comm communicator) {
  const int round = 100;
  dem.set_time_step(time_step);
  dem.advance(round * time_step);
  std::vector<double> times;
  const long searches = dem.n_searches(), substeps = dem.n_substeps();
  double spent = 0;
  int running = 0;
  MPI_Initialized(&running);
  SeedBench result;
  if (running) MPI_Comm_size(communicator, &result.n_ranks);
  while (spent < seconds || times.size() < 5) {
    const double start = cpu_time();
    dem.advance(round * time_step);
    double time = cpu_time() - start;
    if (result.n_ranks > 1) MPI_Allreduce(MPI_IN_PLACE, &time, 1, MPI_DOUBLE, MPI_MAX, communicator);
    times.push_back(time);
    spent += time;
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  result.n_seeds = dem.n_seeds();
  result.n_spheres = dem.n_spheres();
  result.rate = 1.0 * round * dem.n_spheres() / times[times.size() / 2] / result.n_ranks;
  result.bytes_per_sphere = static_cast<double>(dem.bytes()) / dem.n_spheres();
  result.contacts_per_seed = static_cast<double>(dem.n_contacts()) / dem.n_seeds();
  result.substeps_per_search =
      static_cast<double>(dem.n_substeps() - substeps) / std::max(1L, dem.n_searches() - searches);
  result.kinetic_energy = dem.energies().kinetic / dem.n_seeds();
  result.imbalance = dem.imbalance();
  return result;
}

}  // namespace

SeedBench bench_heap(const HeapBench& heap, MPI_Comm communicator) {
  const int side = std::max(3, static_cast<int>(std::lround(std::cbrt(heap.n_seeds))));
  const int layers = (heap.n_seeds + side * side - 1) / (side * side);
  const double spacing = 4.25e-3;
  const Vec3 box{side * spacing, side * spacing, 1.3 * layers * spacing};

  // Plain spheres fall from a jittered lattice and come to rest, with the largest step that is allowed.
  DemParameters p;
  p.time_step = 8e-6;
  Dem spheres(p, communicator);
  const int m = spheres.add_material({});
  spheres.add_template(plain_sphere(), m, true);
  spheres.add_box({0, 0, 0}, box, m);
  PortableRandom random(1);
  for (int k = 0; k < heap.n_seeds; ++k) {
    const Vec3 cell{k % side + 0.5, k / side % side + 0.5, k / (side * side) + 0.5};
    spheres.add_seed(0, spacing * cell + random.in_box({-1e-4, -1e-4, -1e-4}, {1e-4, 1e-4, 1e-4}), {},
                     random.in_box({-0.1, -0.1, -0.3}, {0.1, 0.1, -0.3}));
  }
  spheres.advance(0.2);
  if (heap.n_sub_spheres == 1) return measure(spheres, heap.time_step, heap.seconds, communicator);

  SeedTemplateParameters shape;
  shape.n_spheres = heap.n_sub_spheres;
  p.time_step = 4e-6;
  p.bonds.damping_ratio = 0.05;
  Dem seeds(p, communicator);
  seeds.add_material({});
  seeds.add_template(make_seed_template(shape), m, heap.rigid);
  seeds.add_box({0, 0, 0}, box, m);
  for (int k = 0; k < heap.n_seeds; ++k)
    seeds.add_seed(0, spheres.seed_state(k).centre, rotation(random.in_box({-2, -2, -2}, {2, 2, 2})));
  seeds.advance(0.05);
  return measure(seeds, heap.time_step, heap.seconds, communicator);
}

SeedBench bench_drum(double rpm, double seconds, MPI_Comm communicator) {
  const double radius = 0.05, length = 0.045;
  DemParameters p;
  p.time_step = 8e-6;
  p.gravity = {0, -9.81, 0};
  Dem dem(p, communicator);
  const int m = dem.add_material({});
  dem.add_template(plain_sphere(), m, true);
  Cylinder tube;
  tube.radius = radius, tube.length = 2 * length;
  tube.base = {0, 0, -0.5 * length};
  tube.base_cap = tube.end_cap = false;
  dem.add_wall({"drum", tube, m, WallMotion::rotation({}, {0, 0, rpm * 2 * M_PI / 60})});
  dem.add_wall({"end z-", {}, {0, 0, 1}, {}, m});
  dem.add_wall({"end z+", {0, 0, length}, {0, 0, -1}, {}, m});
  PortableRandom random(1);
  const double spacing = 4.1e-3;
  for (int n = 0, k = 0; n < 2200; ++k) {
    const Vec3 cell{k % 22 - 10.5, (k / 242) - 10.5, k / 22 % 11 - 5.0};
    const Vec3 x = spacing * cell + Vec3{0, 0, 0.5 * length};
    if (std::hypot(x.x, x.y) > radius - 0.51 * diameter) continue;
    dem.add_seed(0, x, {}, random.in_box({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}));
    ++n;
  }
  dem.advance(0.6);
  return measure(dem, 2e-6, seconds, communicator);
}

}  // namespace seedflow
