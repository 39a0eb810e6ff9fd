#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sample_templates.h"
#include "seedflow/seeds/contact_geometry.h"
#include "seedflow/seeds/dem.h"

namespace seedflow {
namespace {

struct Numbers {
  std::mt19937 engine{5};
  double operator()(double size) { return size * std::uniform_real_distribution<double>(-1, 1)(engine); }
  Vec3 vector(double size) { return {(*this)(size), (*this)(size), (*this)(size)}; }
};

TEST(CacheLines, ColumnsAndBack) {
  CacheLine record[lane_width], back[lane_width];
  const CacheLine* from[lane_width];
  for (int l = 0; l < lane_width; ++l) {
    from[l] = &record[l];
    for (int c = 0; c < 8; ++c) record[l][c] = 10 * l + c;
  }
  Lanes column[8];
  load_columns(from, column);
  for (int l = 0; l < lane_width; ++l)
    for (int c = 0; c < 8; ++c) EXPECT_EQ(column[c][l], 10 * l + c);
  to_records(column, back);
  for (int l = 0; l < lane_width; ++l)
    for (int c = 0; c < 8; ++c) EXPECT_EQ(back[l][c], 10 * l + c);
}

TEST(LaneRoots, AgreeWithTheExactOnes) {
  for (const double a : {1e-30, 3.3e-9, 0.7, 1.0, 2.0, 5e12}) {
    EXPECT_NEAR(inverse(broadcast(a))[0] * a, 1, 5e-16);
    EXPECT_NEAR(inverse_root(broadcast(a))[0] * std::sqrt(a), 1, 5e-16);
    EXPECT_NEAR(root(broadcast(a))[0] / std::sqrt(a), 1, 5e-16);
  }
  EXPECT_EQ(root(Lanes{})[0], 0.0);
}

template <class Record, class T, int n>
void expect_columns_and_back() {
  Record record[width_of<T>], back[width_of<T>];
  const Record* from[width_of<T>];
  for (int l = 0; l < width_of<T>; ++l) {
    from[l] = &record[l];
    for (int c = 0; c < n; ++c) record[l][c] = 10 * l + c;
  }
  T column[n];
  load_columns(from, column);
  for (int c = 0; c < n; ++c) column[c] = column[c] + 1000.0;
  if constexpr (n == 4)
    store_records(back, column[0], column[1], column[2], column[3]);
  else
    store_records(back, column[0], column[1], column[2], column[3], column[4], column[5], column[6],
                  column[7]);
  for (int l = 0; l < width_of<T>; ++l)
    for (int c = 0; c < n; ++c) EXPECT_EQ(back[l][c], 1000 + 10 * l + c);
}

TEST(CacheLines, HalvesAndPairsOfLanes) {
  expect_columns_and_back<HalfLine, Lanes, 4>();
  expect_columns_and_back<HalfLine, LanePair, 4>();
  expect_columns_and_back<CacheLine, LanePair, 8>();
}

// The kernel's pairs against the law for single contacts written out with plain vectors, sticking and
// sliding, with the levers of rigid seeds and without.
template <bool levers>
void expect_kernel_agrees_with_single_contacts() {
  constexpr int width = width_of<LanePair>;
  Numbers random;
  ContactProperties properties;
  const ContactLaw law({}, {}, properties);
  const double step = 1e-6;
  const auto first = [](const auto& record) { return Vec3{record[0], record[1], record[2]}; };
  const auto second = [](const auto& record) { return Vec3{record[4], record[5], record[6]}; };
  double force_off = 0, torque_off = 0, spring_off = 0;
  for (int round = 0; round < 50; ++round) {
    ContactSphere sphere[2][width];
    ContactMotion motion[2][width];
    HalfLine centre[2][width], line[width];
    const auto record = [](const Vec3& a, double b) { return HalfLine{{a.x, a.y, a.z, b}}; };
    for (int l = 0; l < width; ++l) {
      const Vec3 a = random.vector(1e-3), away = random.vector(1);
      const Vec3 place[2] = {a, a + (0.95e-3 + random(0.02e-3)) / norm(away) * away};
      for (int s : {0, 1}) {
        const Vec3 v = random.vector(0.3), w = random.vector(50);
        sphere[s][l] = record(place[s], s == 0 ? 0.4e-3 : 0.6e-3);
        motion[s][l] = {{v.x, v.y, v.z, s == 0 ? 2e-5 : 5e-5, w.x, w.y, w.z, s == 0 ? 1e-11 : 3e-11}};
        centre[s][l] = record(place[s] - (levers ? random.vector(2e-3) : Vec3{}), 0);
      }
      line[l] = record(random.vector(round % 2 ? 1e-7 : 1e-5), 0);
    }
    const auto all = [](auto* records) { return RecordsAt{[=](int l) { return records + l; }}; };
    const LaneSphere<LanePair, levers> a(all(sphere[0]), all(motion[0]), all(centre[0])),
        b(all(sphere[1]), all(motion[1]), all(centre[1]));
    LaneMemory<LanePair, false> kept(all(line), all(line));
    const auto action =
        act_between<Rolling::constant_torque, Cohesion::none>(law, a, b, LanePair{} + 1.0, step, kept.memory);
    const auto of_lane = [](const VectorLanes<LanePair>& v, int l) {
      const auto number = [&](const LanePair& p) { return l < lane_width ? p.a[l] : p.b[l - lane_width]; };
      return Vec3{number(v.x), number(v.y), number(v.z)};
    };
    for (int l = 0; l < width; ++l) {
      const Vec3 d = first(sphere[0][l]) - first(sphere[1][l]);
      const double ra = 0.4e-3, rb = 0.6e-3, distance = norm(d);
      ContactKinematics<double> c;
      c.normal = d / distance;
      c.overlap = ra + rb - distance;
      ASSERT_GT(c.overlap, 0);
      c.reduced_radius = ra * rb / (ra + rb);
      c.reduced_mass = 2e-5 * 5e-5 / 7e-5;
      const Vec3 point = first(sphere[0][l]) - (ra - c.overlap / 2) * c.normal;
      const Vec3 lever_a = point - first(centre[0][l]), lever_b = point - first(centre[1][l]);
      c.velocity = first(motion[0][l]) + cross(second(motion[0][l]), lever_a) - first(motion[1][l]) -
                   cross(second(motion[1][l]), lever_b);
      c.spin = second(motion[0][l]) - second(motion[1][l]);
      const double to_a = norm(lever_a), to_b = norm(lever_b);
      c.rolling_radius = 2 * to_a * to_b / (to_a + to_b);
      c.inertia = 1e-11 * 3e-11 / 4e-11;
      ContactMemory<double> memory;
      memory.spring = first(line[l]);
      const ContactAction<double> single =
          contact_action<Rolling::constant_torque, Cohesion::none>(law, c, step, memory);
      const Vec3 torque_a = cross(lever_a, single.force) + single.torque,
                 torque_b = -cross(lever_b, single.force) - single.torque;
      const auto off = [](const Vec3& x, const Vec3& exact) { return norm(x - exact) / norm(exact); };
      force_off = std::max(force_off, off(of_lane(action.force, l), single.force));
      torque_off = std::max({torque_off, off(of_lane(action.torque_a, l), torque_a),
                             off(of_lane(action.torque_b, l), torque_b)});
      spring_off = std::max(spring_off, off(of_lane(kept.memory.spring, l), memory.spring));
    }
  }
  // Overlaps of 3e-5 m and more are differences of lengths of 1e-3 m: round-off of 1e-16 grows to 4e-15, and
  // by a few dozen operations to some 1e-14.
  EXPECT_LT(force_off, 1e-13);
  EXPECT_LT(torque_off, 1e-13);
  EXPECT_LT(spring_off, 1e-13);
}

TEST(ContactKernel, AgreesWithSingleContacts) {
  expect_kernel_agrees_with_single_contacts<true>();
  expect_kernel_agrees_with_single_contacts<false>();
}

// Sub-spheres of a rigid seed are where the body carries them, though nothing of them is stored.
TEST(RigidSpheres, AreComputedFromTheBody) {
  DemParameters p;
  Dem dem(p);
  const SeedTemplate model = test::lattice_seed();
  dem.add_template(model, dem.add_material({}), true);
  for (int k = 0; k < 11; ++k)
    dem.add_seed(0, {0.01 * k, 0, 0}, rotation({0.3 * k, 1, 0}), {0, 0.1, 0}, {5, 1.0 * k, 0});
  dem.advance(2e-3);
  std::vector<Vec3> x, v, w;
  dem.positions(x), dem.velocities(v), dem.angular_velocities(w);
  for (int seed = 0; seed < dem.n_seeds(); ++seed) {
    const SeedState s = dem.seed_state(seed);
    for (int i = 0; i < model.n_spheres(); ++i) {
      const int k = dem.first_sphere(seed) + i;
      const Vec3 arm = rotate(s.orientation, model.position[i]);
      EXPECT_LT(norm(x[k] - s.centre - arm), 1e-16);
      EXPECT_LT(norm(v[k] - s.velocity - cross(s.spin, arm)), 1e-15);
      EXPECT_LT(norm(w[k] - s.spin), 1e-13);
    }
  }
}

// Lists are a matter of speed: another skin means other searches at other times and not one bit of another
// motion, tangential springs included.
TEST(ContactLists, SkinChangesNoBit) {
  const auto run = [](double skin, long& searches) {
    DemParameters p;
    p.time_step = 4e-6;
    p.contacts.skin = skin;
    Dem dem(p);
    const int m = dem.add_material({});
    dem.add_template(test::lattice_seed(), m, true);
    dem.add_template(test::single_sphere(), m, true);
    dem.add_box({0, 0, 0}, {0.012, 0.012, 0.1}, m);
    for (int k = 0; k < 16; ++k)
      dem.add_seed(k % 2,
                   {0.0035 + 0.0047 * (k % 2), 0.0035 + 0.0047 * (k / 2 % 2), 0.0025 + 0.0043 * (k / 4)}, {},
                   {0.1 * (k % 3), 0, -0.3});
    dem.advance(0.02);
    searches = dem.n_searches();
    std::vector<Vec3> x;
    dem.positions(x);
    return x;
  };
  long few = 0, many = 0;
  const auto a = run(0.8e-3, few), b = run(0.04e-3, many);
  EXPECT_GT(many, 2 * few);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_EQ(a[i][c], b[i][c]);
}

// Spheres piled on each other; then one that touches nobody is removed. The others must not notice: a lost
// tangential spring would let the pile slip.
TEST(ContactLists, SpringsSurviveRemovalAndSorting) {
  enum class Removed { none, first, last };
  const auto run = [](double rolling, Removed removed) {
    DemParameters p;
    p.time_step = 4e-6;
    Dem dem(p);
    const int m = dem.add_material({});
    dem.set_contact(m, m, {0.3, 0.8, rolling});
    dem.add_template(test::single_sphere(), m, true);
    dem.add_wall({"floor", {}, {0, 0, 1}, {}, m});
    dem.add_seed(0, {0.1, 0, 2e-3});
    for (int k = 0; k < 3; ++k)
      dem.add_seed(0,
                   {2.02e-3 * std::cos(2.0944 * k) * 1.1547, 2.02e-3 * std::sin(2.0944 * k) * 1.1547, 2e-3});
    dem.add_seed(0, {0, 0, 5.27e-3});
    dem.add_seed(0, {-0.1, 0, 2e-3});
    dem.advance(0.1);
    if (removed != Removed::none) dem.remove_seeds({removed == Removed::first ? 0 : 5});
    dem.advance(0.02);
    std::vector<Vec3> x;
    const int pile = removed == Removed::first ? 0 : 1;
    for (int k = 0; k < 4; ++k) x.push_back(dem.seed_state(pile + k).centre);
    return x;
  };
  const auto expect_equal = [](const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
    EXPECT_GT(x[3].z, 5e-3) << "the pile stands by friction";
    for (int k = 0; k < 4; ++k) EXPECT_LT(norm(x[k] - y[k]), 1e-12);
  };
  // The first seed moves all others up, the last one none.
  expect_equal(run(0.1, Removed::first), run(0.1, Removed::last));
  // After a removal forces are computed anew from the velocities of the whole step, which rolling friction of
  // constant torque answers by some 1e-12 m; without it even that makes no difference.
  expect_equal(run(0, Removed::first), run(0, Removed::none));
}

// Kinetic energy dies away below 1e-9 J per seed and nothing creeps over 0.1 s.
TEST(HeapAtRest, HoldsStill) {
  DemParameters p;
  p.time_step = 2.5e-6;
  Dem dem(p);
  const int m = dem.add_material({});
  dem.add_template(test::lattice_seed(), m, true);
  dem.add_template(test::single_sphere(), m, true);
  dem.add_box({0, 0, 0}, {0.0135, 0.0135, 0.1}, m);
  for (int k = 0; k < 27; ++k)
    dem.add_seed(k % 2, {0.0025 + 0.0043 * (k % 3), 0.0025 + 0.0043 * (k / 3 % 3), 0.0025 + 0.0043 * (k / 9)},
                 rotation({0.3 * k, 0.1 * k, 0}), {0.03 * (k % 5), 0.02 * (k % 3), 0});
  dem.advance(0.6);
  EXPECT_LT(dem.energies().kinetic / dem.n_seeds(), 1e-9);
  std::vector<Vec3> before, after;
  dem.positions(before);
  dem.advance(0.1);
  dem.positions(after);
  double creep = 0;
  for (std::size_t i = 0; i < before.size(); ++i) creep = std::max(creep, norm(after[i] - before[i]));
  // Rolling friction of constant torque lets spheres creep at up to 5/2 g h, here 6 um in 0.1 s on a vertical
  // slope (see creep_test.cc): in proportion to the step, which is therefore half of what contacts need.
  EXPECT_LT(creep, 1e-6);
  EXPECT_LT(dem.energies().kinetic / dem.n_seeds(), 1e-9);
}

}  // namespace
}  // namespace seedflow
