// Which sub-spheres may touch: whole seeds first, sub-spheres only of seeds that come close.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "seedflow/seeds/contacts.h"

namespace seedflow {
namespace {

struct Ball {
  Vec3 centre;
  double radius = 0;
};

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

// Takes the springs of pairs that touched from the old list; both are sorted.
void inherit(std::vector<Contacts::Pair>& now, const std::vector<Contacts::Pair>& before) {
  const auto less = [](const Contacts::Pair& a, const Contacts::Pair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  };
  std::sort(now.begin(), now.end(), less);
  auto old = before.begin();
  for (Contacts::Pair& pair : now) {
    while (old != before.end() && less(*old, pair)) ++old;
    if (old != before.end() && !less(pair, *old)) pair = *old;
  }
}

}  // namespace

void Contacts::search(const std::vector<SphereAddress>& spheres, const std::vector<int>& first,
                      const std::vector<Wall>& walls, const std::vector<char>& wall_active,
                      const ContactParameters& parameters) {
  const int n_seeds = static_cast<int>(first.size()) - 1;
  std::vector<Vec3> x(spheres.size());
  double smallest = 1e300, largest = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    x[i] = spheres[i].lanes->position.get(spheres[i].lane);
    smallest = std::min(smallest, spheres[i].radius);
  }
  const double skin = parameters.skin > 0 ? parameters.skin : 0.25 * smallest;

  std::vector<Ball> balls(n_seeds);
  for (int s = 0; s < n_seeds; ++s) {
    Vec3 low = x[first[s]], high = low;
    for (int i = first[s]; i < first[s + 1]; ++i)
      for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], x[i][c]), high[c] = std::max(high[c], x[i][c]);
    balls[s].centre = 0.5 * (low + high);
    for (int i = first[s]; i < first[s + 1]; ++i)
      balls[s].radius = std::max(balls[s].radius, norm(x[i] - balls[s].centre) + spheres[i].radius);
    largest = std::max(largest, balls[s].radius);
  }

  std::vector<Pair> old_pairs = std::move(pairs), old_wall_pairs = std::move(wall_pairs);
  pairs.clear(), wall_pairs.clear();

  const Cells cells(balls, 2 * largest + skin);
  std::vector<int> near_a, near_b;
  const auto near = [&](int seed, const Ball& other, std::vector<int>& found) {
    found.clear();
    for (int i = first[seed]; i < first[seed + 1]; ++i) {
      const double reach_i = other.radius + spheres[i].radius + skin;
      if (norm_square(x[i] - other.centre) < reach_i * reach_i) found.push_back(i);
    }
  };
  for (int a = 0; a < n_seeds; ++a)
    cells.around(balls[a].centre, [&](int b) {
      const double close = balls[a].radius + balls[b].radius + skin;
      if (b <= a || norm_square(balls[a].centre - balls[b].centre) >= close * close) return;
      near(a, balls[b], near_a);
      near(b, balls[a], near_b);
      for (int i : near_a)
        for (int j : near_b) {
          const double gap = spheres[i].radius + spheres[j].radius + skin;
          if (norm_square(x[i] - x[j]) < gap * gap) pairs.push_back({i, j, {}, false, 0});
        }
    });

  for (int s = 0; s < n_seeds; ++s)
    for (int w = 0; w < static_cast<int>(walls.size()); ++w) {
      if (!wall_active[w]) continue;
      if (dot(balls[s].centre - walls[w].point, walls[w].normal) > balls[s].radius + skin) continue;
      for (int i = first[s]; i < first[s + 1]; ++i)
        if (dot(x[i] - walls[w].point, walls[w].normal) < spheres[i].radius + skin)
          wall_pairs.push_back({i, w, {}, false, 0});
    }

  inherit(pairs, old_pairs);
  inherit(wall_pairs, old_wall_pairs);
  reach = skin;
  travelled = 0;
}

}  // namespace seedflow
