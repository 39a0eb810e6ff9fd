// One answer on any number of ranks: every test compares the world's ranks with one rank alone.

#include <gtest/gtest.h>

#include <sstream>

#include "sample_templates.h"
#include "seedflow/base/error.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

MPI_Comm world() {
  int running = 0;
  MPI_Initialized(&running);
  return running ? MPI_COMM_WORLD : MPI_COMM_SELF;
}

int n_ranks() {
  int n = 1, running = 0;
  MPI_Initialized(&running);
  if (running) MPI_Comm_size(MPI_COMM_WORLD, &n);
  return n;
}

// A heap of bonded and rigid seeds and plain spheres that falls into a box with a moving floor.
Dem heap(MPI_Comm communicator, int n_seeds = 36) {
  DemParameters p;
  p.time_step = 2e-6;
  p.bonds.damping_ratio = 0.02;
  p.bonds.normal_strength = 2e5;
  Dem dem(p, communicator);
  const int seed = dem.add_material({}), steel = dem.add_material({"steel", 7800, 0.3, 1e9});
  dem.set_contact(seed, steel, {0.4, 0.5, 0.02});
  dem.add_template(test::lattice_seed(), seed, false);
  dem.add_template(test::lattice_seed(), seed, true);
  dem.add_template(test::single_sphere(), steel, true);
  dem.add_box({0, 0, 0}, {0.014, 0.014, 0.1}, steel);
  dem.set_wall_velocity(4, {0.01, 0, 0.002});
  for (int k = 0; k < n_seeds; ++k)
    dem.add_seed(k % 3, {0.0025 + 0.0045 * (k % 3), 0.0025 + 0.0045 * (k / 3 % 3), 0.0025 + 0.0042 * (k / 9)},
                 rotation({0.1 * k, 0.2, 0.3 * k}), {0.05 * (k % 4) - 0.1, 0.02 * (k % 5), -0.4},
                 {3.0 * k, 0, 5});
  return dem;
}

void expect_same(const Dem& a, const Dem& b) {
  std::vector<Vec3> x, y, v, w;
  a.positions(x), b.positions(y);
  a.velocities(v), b.velocities(w);
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      ASSERT_EQ(x[i][c], y[i][c]) << "position of sub-sphere " << i;
      ASSERT_EQ(v[i][c], w[i][c]) << "velocity of sub-sphere " << i;
    }
  const ContactNetwork m = a.contact_network(), n = b.contact_network();
  ASSERT_EQ(m.size(), n.size());
  for (std::size_t k = 0; k < m.size(); ++k) {
    ASSERT_EQ(m[k].label_a, n[k].label_a);
    ASSERT_EQ(m[k].label_b, n[k].label_b);
    ASSERT_EQ(m[k].sphere_a, n[k].sphere_a);
    ASSERT_EQ(m[k].sphere_b, n[k].sphere_b);
    ASSERT_EQ(m[k].wall, n[k].wall);
    ASSERT_EQ(m[k].normal_force, n[k].normal_force);
  }
  for (std::size_t k = 0; k < a.wall_impulses().size(); ++k)
    for (int c = 0; c < 3; ++c) ASSERT_EQ(a.wall_impulses()[k][c], b.wall_impulses()[k][c]);
  EXPECT_EQ(a.energies().dissipated, b.energies().dissipated);
}

TEST(DemMpi, SameBitsAfterTenThousandSteps) {
  Dem shared = heap(world()), alone = heap(MPI_COMM_SELF);
  for (const double duration : {0.012, 0.008}) {
    shared.advance(duration);
    alone.advance(duration);
    ASSERT_EQ(shared.n_substeps(), alone.n_substeps());
    expect_same(shared, alone);
  }
  EXPECT_EQ(shared.n_substeps(), 10000);
  EXPECT_EQ(shared.n_searches(), alone.n_searches()) << "the skin is chosen by what all ranks know";
  EXPECT_GT(shared.contact_network().size(), 10u);
}

// A bed of plain spheres and clumps at rest: the whole contact network after ten thousand steps.
TEST(DemMpi, ContactNetworkOfABed) {
  const auto bed = [](MPI_Comm communicator) {
    DemParameters p;
    p.time_step = 4e-6;
    Dem dem(p, communicator);
    const int m = dem.add_material({});
    dem.add_template(test::single_sphere(), m, true);
    dem.add_template(test::lattice_seed(4e-3, 1.2e-3), m, true);
    dem.add_box({0, 0, 0}, {0.034, 0.034, 0.05}, m);
    for (int k = 0; k < 384; ++k)
      dem.add_seed(k % 7 == 0,
                   {0.0022 + 0.00415 * (k % 8) + 5e-5 * (k / 64 % 2),
                    0.0022 + 0.00415 * (k / 8 % 8) + 3e-5 * (k % 3), 0.0021 + 0.0041 * (k / 64)},
                   {}, {0.02 * (k % 5 - 2), 0.02 * (k % 3 - 1), -0.1});
    dem.advance(0.04);
    return dem;
  };
  const Dem shared = bed(world()), alone = bed(MPI_COMM_SELF);
  EXPECT_EQ(shared.n_substeps(), 10000);
  EXPECT_GE(alone.contact_network().size(), 500u);
  expect_same(shared, alone);
}

// Drag, added mass and their impulses, advanced in short coupling steps.
TEST(DemMpi, LoadsAndTheirImpulses) {
  Dem shared = heap(world()), alone = heap(MPI_COMM_SELF);
  SphereLoads load;
  load.drag_coefficient.assign(alone.n_spheres(), 1e-6);
  load.flow_velocity.assign(alone.n_spheres(), {0.3, 0, 0.1});
  load.added_mass.assign(alone.n_spheres(), 1e-8);
  for (int k = 0; k < 20; ++k) {
    load.force.assign(alone.n_spheres(), {0, 1e-7 * k, 0});
    for (Dem* dem : {&shared, &alone}) dem->set_loads(load), dem->advance(1e-4);
  }
  expect_same(shared, alone);
  std::vector<Vec3> a, b;
  shared.fluid_impulses(a), alone.fluid_impulses(b);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_EQ(a[i][c], b[i][c]);
}

// Seeds come and go while running; a state saved by one rank alone goes on on all.
TEST(DemMpi, PopulationChangesAndResumeOnOtherRanks) {
  Dem shared = heap(world()), alone = heap(MPI_COMM_SELF);
  const auto change = [](Dem& dem) {
    dem.remove_seeds({3, 17, 18});
    dem.add_seed(1, {0.005, 0.005, 0.05}, {}, {0, 0, -1});
    dem.add_seed(0, {0.010, 0.010, 0.05}, {}, {0, 0, -1});
  };
  for (Dem* dem : {&shared, &alone}) {
    dem->advance(4e-3);
    change(*dem);
    EXPECT_EQ(dem->seed_label(3), 4);
    EXPECT_EQ(dem->seed_label(dem->n_seeds() - 1), 37);
    dem->advance(4e-3);
  }
  expect_same(shared, alone);
  std::stringstream file;
  alone.save(file);
  Dem resumed = heap(world());
  resumed.load(file);
  resumed.advance(4e-3);
  alone.advance(4e-3);
  expect_same(resumed, alone);
}

// A heap in one corner of a large box: equal volumes would leave most ranks idle.
TEST(DemMpi, CostIsBalanced) {
  DemParameters p;
  p.time_step = 4e-6;
  Dem dem(p, world());
  const int m = dem.add_material({});
  dem.add_template(test::single_sphere(), m, true);
  dem.add_box({0, 0, 0}, {1, 1, 1}, m);
  for (int k = 0; k < 600; ++k)
    dem.add_seed(0, {0.003 + 0.0042 * (k % 8), 0.003 + 0.0042 * (k / 8 % 8), 0.003 + 0.0042 * (k / 64)});
  dem.add_seed(0, {0.9, 0.9, 0.9});
  dem.advance(1e-4);
  // 75 blocks of 8 seeds (more where lanes are fewer) divided by 3 ranks: a block more or less is 4 %; the
  // contacts inside differ.
  EXPECT_LT(dem.imbalance(), 1.1);
  EXPECT_GE(dem.imbalance(), 1.0);
}

// What goes wrong on one rank stops all of them with the same words.
TEST(DemMpi, LostSeedStopsAllRanks) {
  Dem dem = heap(world());
  dem.set_domain({0, 0, 0}, {0.014, 0.014, 0.02});
  dem.add_seed(2, {0.007, 0.007, 0.0199}, {}, {0, 0, 2});
  try {
    dem.advance(1e-3);
    FAIL();
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("left the domain: seed 36"), std::string::npos) << e.what();
  }
  EXPECT_GE(n_ranks(), 1);
}

}  // namespace
}  // namespace seedflow
