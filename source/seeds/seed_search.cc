#include "seedflow/seeds/seed_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "seedflow/seeds/cache_line.h"

namespace seedflow {
namespace {

// Linked cells over an unbounded space: seeds sorted by the key of their cell.
class Cells {
 public:
  Cells(const std::vector<Ball>& balls, double cell_size) : size(cell_size) {
    for (std::size_t i = 0; i < balls.size(); ++i)
      order.push_back({key(balls[i].centre, 0, 0, 0), static_cast<int>(i)});
    std::sort(order.begin(), order.end());
  }

  template <class Visit>
  void around(const Vec3& x, Visit visit) const {
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        // The three cells along z have consecutive keys.
        auto it = std::lower_bound(order.begin(), order.end(), std::make_pair(key(x, i, j, -1), -1));
        const std::uint64_t last = key(x, i, j, 1);
        for (; it != order.end() && it->first <= last; ++it) visit(it->second);
      }
  }

 private:
  std::uint64_t key(const Vec3& x, int i, int j, int k) const {
    const auto cell = [&](double a, int shift) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(a / size)) + shift + (1 << 20)) &
             0x1fffff;
    };
    return cell(x.x, i) << 42 | cell(x.y, j) << 21 | cell(x.z, k);
  }

  double size;
  std::vector<std::pair<std::uint64_t, int>> order;
};

SEEDFLOW_INLINE Lanes load(const double* from) {
  Lanes r;
  std::memcpy(&r, from, sizeof(Lanes));
  return r;
}

// Sub-spheres that come near a point: numbers, and their coordinates and radii one after the other.
struct Near {
  std::vector<int> number;
  std::vector<double> x, y, z, radius;

  void clear() { number.clear(), x.clear(), y.clear(), z.clear(), radius.clear(); }
  void pad() {
    for (auto* a : {&x, &y, &z, &radius}) a->resize(number.size() + lane_width, 0.0);
  }
};

class PairFinder {
 public:
  PairFinder(const std::vector<SeedStore>& seed_stores, const SeedCloud& seed_cloud, double gap)
      : stores(seed_stores), cloud(seed_cloud), skin(gap) {
    for (const SeedStore& s : stores) {
      radius.push_back(s.model.radius);
      radius.back().resize(s.n_spheres() + lane_width, 0.0);
    }
  }

  // Appends the pairs of seeds a < b.
  void compare(int a, int b, std::vector<SpherePair>& found) {
    collect(a, cloud.ball[b], near_a);
    if (near_a.number.empty()) return;
    collect(b, cloud.ball[a], near_b);
    near_b.pad();
    const int n = static_cast<int>(near_b.number.size());
    for (std::size_t i = 0; i < near_a.number.size(); ++i) {
      const Vec3 x{near_a.x[i], near_a.y[i], near_a.z[i]};
      const double reach = near_a.radius[i] + skin;
      for (int j = 0; j < n; j += lane_width) {
        const Lanes dx = load(&near_b.x[j]) - x.x, dy = load(&near_b.y[j]) - x.y,
                    dz = load(&near_b.z[j]) - x.z, close = load(&near_b.radius[j]) + reach;
        for (unsigned bits = mask_bits(dx * dx + dy * dy + dz * dz < close * close); bits; bits &= bits - 1) {
          const int k = j + __builtin_ctz(bits);
          if (k < n) found.push_back({near_a.number[i], near_b.number[k]});
        }
      }
    }
  }

 private:
  void collect(int seed, const Ball& other, Near& near) {
    const int t = cloud.numbering.store_of_seed(seed), n = stores[t].n_spheres();
    const int begin = cloud.numbering.first_sphere[t] + (seed - cloud.numbering.first_seed[t]) * n;
    const double reach = other.radius + skin;
    near.clear();
    for (int i = 0; i < n; i += lane_width) {
      const Lanes dx = load(&cloud.x[begin + i]) - other.centre.x,
                  dy = load(&cloud.y[begin + i]) - other.centre.y,
                  dz = load(&cloud.z[begin + i]) - other.centre.z, close = load(&radius[t][i]) + reach;
      for (unsigned bits = mask_bits(dx * dx + dy * dy + dz * dz < close * close); bits; bits &= bits - 1) {
        const int k = i + __builtin_ctz(bits);
        if (k >= n) break;
        near.number.push_back(begin + k);
        near.x.push_back(cloud.x[begin + k]);
        near.y.push_back(cloud.y[begin + k]);
        near.z.push_back(cloud.z[begin + k]);
        near.radius.push_back(radius[t][k]);
      }
    }
  }

  const std::vector<SeedStore>& stores;
  const SeedCloud& cloud;
  double skin;
  std::vector<std::vector<double>> radius;  ///< [store][sub-sphere], padded
  Near near_a, near_b;
};

}  // namespace

SeedCloud::SeedCloud(const std::vector<SeedStore>& stores) : numbering(stores) {
  for (auto* a : {&x, &y, &z}) a->resize(numbering.n_spheres() + lane_width, 0.0);
  ball.resize(numbering.n_seeds());
}

void SeedCloud::take(const SeedStore& s, int t, int slot) {
  const int n = s.n_spheres(), begin = numbering.first_sphere[t] + slot * n;
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  s.positions(slot, [&](int i, const Vec3& a) {
    x[begin + i] = a.x, y[begin + i] = a.y, z[begin + i] = a.z;
    for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], a[c]), high[c] = std::max(high[c], a[c]);
  });
  Ball& b = ball[numbering.first_seed[t] + slot];
  b.centre = 0.5 * (low + high);
  b.radius = 0;
  for (int i = 0; i < n; ++i)
    b.radius = std::max(b.radius, norm(position(begin + i) - b.centre) + s.model.radius[i]);
}

std::vector<SpherePair> pairs_within(const std::vector<SeedStore>& stores, const SeedCloud& cloud,
                                     double skin, const std::vector<char>& own) {
  double largest = 0;
  for (const Ball& b : cloud.ball) largest = std::max(largest, b.radius);
  std::vector<SpherePair> pairs;
  if (cloud.ball.empty()) return pairs;
  const Cells cells(cloud.ball, 2 * largest + skin);
  PairFinder finder(stores, cloud, skin);
  for (int a = 0; a < static_cast<int>(cloud.ball.size()); ++a) {
    const std::size_t begin = pairs.size();
    const Ball& ball = cloud.ball[a];
    cells.around(ball.centre, [&](int b) {
      const double close = ball.radius + cloud.ball[b].radius + skin;
      if (b > a && (own[a] || own[b]) && norm_square(ball.centre - cloud.ball[b].centre) < close * close)
        finder.compare(a, b, pairs);
    });
    std::sort(pairs.begin() + begin, pairs.end(), [](const SpherePair& p, const SpherePair& q) {
      return p.first != q.first ? p.first < q.first : p.second < q.second;
    });
  }
  return pairs;
}

}  // namespace seedflow
