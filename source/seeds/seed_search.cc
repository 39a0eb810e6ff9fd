#include "seedflow/seeds/seed_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "seedflow/seeds/cache_line.h"

namespace seedflow {
namespace {

struct SeedPair {
  int first, second;  // first < second
};

// Linked cells over an unbounded space: seeds sorted by the key of their cell.
class Cells {
 public:
  Cells(const std::vector<Ball>& balls, double cell_size) : size(cell_size) {
    for (const Ball& b : balls)
      for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], b.centre[c]);
    order.reserve(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i)
      order.push_back({key(balls[i].centre), static_cast<int>(i)});
    std::sort(order.begin(), order.end());
  }

  // Calls visit(a, b) once for any two seeds in the same or in neighbouring cells.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    const int n = static_cast<int>(order.size());
    for (int k = 0; k < n; ++k)
      for (int j = k + 1; j < n && order[j].first <= order[k].first + 1; ++j)
        visit(order[k].second, order[j].second);
    // Columns of cells ahead, three cells of each: their keys follow each other, and grow with the seed's.
    const std::uint64_t x = std::uint64_t(1) << 42, y = std::uint64_t(1) << 21;
    for (const std::uint64_t ahead : {y, x - y, x, x + y})
      for (int k = 0, begin = 0; k < n; ++k) {
        const std::uint64_t there = order[k].first + ahead;
        while (begin < n && order[begin].first < there - 1) ++begin;
        for (int j = begin; j < n && order[j].first <= there + 1; ++j)
          visit(order[k].second, order[j].second);
      }
  }

 private:
  std::uint64_t key(const Vec3& x) const {
    // Cells count from 1, so that a neighbour's key never wraps around.
    const auto cell = [&](int c) {
      const double number = std::floor((x[c] - low[c]) / size);
      return static_cast<std::uint64_t>(number > 0 ? std::min(number, 2097149.0) : 0.0) + 1;
    };
    return cell(0) << 42 | cell(1) << 21 | cell(2);
  }

  double size;
  Vec3 low{1e300, 1e300, 1e300};
  std::vector<std::pair<std::uint64_t, int>> order;
};

// Pairs of seeds whose balls come closer than the gap, of which one is own, sorted.
std::vector<SeedPair> seeds_within(const std::vector<Ball>& ball, double gap, const std::vector<char>& own) {
  double largest = 0;
  for (const Ball& b : ball) largest = std::max(largest, b.radius);
  std::vector<SeedPair> near;
  std::vector<int> begin(ball.size() + 2, 0);
  Cells(ball, 2 * largest + gap).for_each_pair([&](int a, int b) {
    const double close = ball[a].radius + ball[b].radius + gap;
    if (!(own[a] || own[b]) || !(norm_square(ball[a].centre - ball[b].centre) < close * close)) return;
    near.push_back({std::min(a, b), std::max(a, b)});
    ++begin[near.back().first + 2];
  });
  for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
  std::vector<SeedPair> sorted(near.size());
  for (const SeedPair& p : near) sorted[begin[p.first + 1]++] = p;
  for (std::size_t a = 0; a < ball.size(); ++a)
    std::sort(sorted.begin() + begin[a], sorted.begin() + begin[a + 1],
              [](const SeedPair& p, const SeedPair& q) { return p.second < q.second; });
  return sorted;
}

SEEDFLOW_INLINE Lanes load(const double* from) {
  Lanes r;
  std::memcpy(&r, from, sizeof(Lanes));
  return r;
}

// Sub-spheres that come near a ball: numbers, and their coordinates and radii one after the other.
struct Near {
  int size = 0;
  std::vector<int> number;
  std::array<std::vector<double>, 4> of;  // x, y, z, radius, with a few old numbers behind

  void reserve(int n) {
    number.resize(n + lane_width);
    for (auto& a : of) a.resize(n + lane_width);
  }
};

class PairFinder {
 public:
  PairFinder(const std::vector<SeedStore>& seed_stores, const SeedCloud& seed_cloud, double reach,
             double inner_reach)
      : stores(seed_stores), cloud(seed_cloud), gap(reach), inner_gap(inner_reach) {
    int largest = 0;
    for (const SeedStore& s : stores) {
      radius.push_back(s.model.radius);
      radius.back().resize(s.n_spheres() + lane_width, 0.0);
      largest = std::max(largest, s.n_spheres());
    }
    near_a.reserve(largest), near_b.reserve(largest);
    count.resize(largest + 1);
  }

  // Sub-spheres of the seed that follow are first of their pairs.
  void begin(int seed) {
    seed_a = seed, store_a = cloud.numbering.store_of_seed(seed);
    found.clear();
    std::fill_n(count.begin(), stores[store_a].n_spheres() + 1, 0);
  }
  // With seeds b that ascend.
  void compare(int b) {
    const int t = cloud.numbering.store_of_seed(b);
    collect(seed_a, store_a, cloud.ball[b], near_a);
    if (near_a.size == 0) return;
    collect(b, t, cloud.ball[seed_a], near_b);
    const int first = first_sphere(seed_a, store_a), n = near_b.size;
    for (int i = 0; i < near_a.size; ++i) {
      const double x = near_a.of[0][i], y = near_a.of[1][i], z = near_a.of[2][i], r = near_a.of[3][i];
      const int number = near_a.number[i];
      for (int j = 0; j < n; j += lane_width) {
        const Lanes dx = load(&near_b.of[0][j]) - x, dy = load(&near_b.of[1][j]) - y,
                    dz = load(&near_b.of[2][j]) - z, radii = load(&near_b.of[3][j]) + r;
        const Lanes square = dx * dx + dy * dy + dz * dz, reach = radii + gap, inner = radii + inner_gap;
        unsigned bits = mask_bits(square < reach * reach);
        if (bits == 0) continue;
        if (j + lane_width > n) bits &= (1u << (n - j)) - 1;
        const unsigned close = mask_bits(square < inner * inner);
        for (; bits; bits &= bits - 1) {
          const int l = __builtin_ctz(bits);
          found.push_back({number, near_b.number[j + l], static_cast<char>(close >> l & 1)});
          ++count[number - first + 1];
        }
      }
    }
  }
  // Appends them sorted: those of each first sub-sphere came in order.
  void end(FoundPairs& all) {
    const int first = first_sphere(seed_a, store_a);
    const std::size_t before = all.pair.size();
    all.pair.resize(before + found.size()), all.close.resize(before + found.size());
    for (int i = 1; i <= stores[store_a].n_spheres(); ++i) count[i] += count[i - 1];
    for (const Found& f : found) {
      const std::size_t place = before + count[f.first - first]++;
      all.pair[place] = {f.first, f.second}, all.close[place] = f.close;
    }
  }

 private:
  struct Found {
    int first, second;
    char close;
  };

  int first_sphere(int seed, int t) const {
    return cloud.first_sphere(stores[t], t, seed - cloud.numbering.first_seed[t]);
  }

  void collect(int seed, int t, const Ball& other, Near& near) {
    const int n = stores[t].n_spheres(), begin = first_sphere(seed, t);
    const double reach = other.radius + gap;
    int size = 0;
    for (int i = 0; i < n; i += lane_width) {
      const Lanes x = load(&cloud.x[begin + i]), y = load(&cloud.y[begin + i]), z = load(&cloud.z[begin + i]),
                  r = load(&radius[t][i]);
      const Lanes dx = x - other.centre.x, dy = y - other.centre.y, dz = z - other.centre.z,
                  close = r + reach;
      unsigned bits = mask_bits(dx * dx + dy * dy + dz * dz < close * close);
      if (i + lane_width > n) bits &= (1u << (n - i)) - 1;
      for (; bits; bits &= bits - 1, ++size) {
        const int l = __builtin_ctz(bits);
        near.number[size] = begin + i + l;
        near.of[0][size] = cloud.x[begin + i + l], near.of[1][size] = cloud.y[begin + i + l];
        near.of[2][size] = cloud.z[begin + i + l], near.of[3][size] = radius[t][i + l];
      }
    }
    near.size = size;
  }

  const std::vector<SeedStore>& stores;
  const SeedCloud& cloud;
  double gap, inner_gap;
  std::vector<std::vector<double>> radius;  ///< [store][sub-sphere], padded
  Near near_a, near_b;
  int seed_a = 0, store_a = 0;
  std::vector<Found> found;  ///< pairs of the present seed, in the order they were found
  std::vector<int> count;    ///< of its sub-spheres before this one
};

// Balls around the bonded seeds of a block.
void enclose(const SeedStore& s, int b, LaneVec3& centre, Lanes& radius) {
  const SphereLanes* const sphere = s.block(b);
  LaneVec3 low = sphere[0].position, high = low;
  for (int i = 1; i < s.n_spheres(); ++i) {
    const LaneVec3& p = sphere[i].position;
    low.x = lane_min(low.x, p.x), low.y = lane_min(low.y, p.y), low.z = lane_min(low.z, p.z);
    high.x = lane_max(high.x, p.x), high.y = lane_max(high.y, p.y), high.z = lane_max(high.z, p.z);
  }
  centre = 0.5 * (low + high);
  Lanes square = {};
  for (int i = 0; i < s.n_spheres(); ++i) {
    const LaneVec3 d = sphere[i].position - centre;
    square = lane_max(square, dot(d, d));
  }
  radius = lane_sqrt(square) + *std::max_element(s.model.radius.begin(), s.model.radius.end());
}

}  // namespace

SeedCloud::SeedCloud(const std::vector<SeedStore>& stores) : numbering(stores) {
  for (auto* a : {&x, &y, &z}) a->resize(numbering.n_spheres() + lane_width, 0.0);
  ball.resize(numbering.n_seeds()), taken.resize(numbering.n_seeds(), 0);
  for (std::size_t t = 0; t < stores.size(); ++t) {
    const SeedStore& s = stores[t];
    const int n_slots = static_cast<int>(s.seed.size());
    for (int b = 0; b < s.n_blocks(); ++b) {
      LaneVec3 centre;
      Lanes radius;
      if (s.rigid)
        centre = s.body[b].position, radius = broadcast(s.model.bounding_radius);
      else
        enclose(s, b, centre, radius);
      for (int slot = b * lane_width; slot < std::min((b + 1) * lane_width, n_slots); ++slot)
        ball[numbering.first_seed[t] + slot] = {centre.get(slot - b * lane_width),
                                                radius[slot - b * lane_width]};
    }
  }
}

void SeedCloud::take(const std::vector<SeedStore>& stores, int seed) {
  if (taken[seed]) return;
  taken[seed] = 1;
  const int t = numbering.store_of_seed(seed), slot = seed - numbering.first_seed[t];
  const int begin = first_sphere(stores[t], t, slot);
  stores[t].positions(
      slot, [&](int i, const Vec3& a) { x[begin + i] = a.x, y[begin + i] = a.y, z[begin + i] = a.z; });
}

FoundPairs pairs_within(const std::vector<SeedStore>& stores, SeedCloud& cloud, double gap, double inner_gap,
                        const std::vector<char>& own) {
  FoundPairs all;
  const int n = static_cast<int>(cloud.ball.size());
  all.begin.resize(n + 1, 0);
  if (n == 0) return all;
  const std::vector<SeedPair> seeds = seeds_within(cloud.ball, gap, own);
  for (const SeedPair& p : seeds) cloud.take(stores, p.first), cloud.take(stores, p.second);
  PairFinder finder(stores, cloud, gap, inner_gap);
  auto pair = seeds.begin();
  for (int a = 0; a < n; ++a) {
    all.begin[a] = static_cast<int>(all.pair.size());
    if (pair == seeds.end() || pair->first != a) continue;
    finder.begin(a);
    for (; pair != seeds.end() && pair->first == a; ++pair) finder.compare(pair->second);
    finder.end(all);
  }
  all.begin[n] = static_cast<int>(all.pair.size());
  return all;
}

}  // namespace seedflow
