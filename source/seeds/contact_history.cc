#include "seedflow/seeds/contact_history.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace seedflow {

void ContactHistory::sort() {
  const auto before = [](const Pair& a, const Pair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  };
  if (!std::is_sorted(pairs.begin(), pairs.end(), before)) std::sort(pairs.begin(), pairs.end(), before);
  std::sort(on_wall.begin(), on_wall.end(), [](const OnWall& a, const OnWall& b) {
    return std::tie(a.sphere, a.wall, a.feature) < std::tie(b.sphere, b.wall, b.feature);
  });
}

void ContactHistory::renumber(const std::vector<int>& new_number) {
  std::size_t kept = 0;
  for (Pair pair : pairs) {
    pair.first = new_number[pair.first], pair.second = new_number[pair.second];
    if (pair.first < 0 || pair.second < 0) continue;
    if (pair.first > pair.second) {
      std::swap(pair.first, pair.second);
      for (const int c : {0, 1, 2, 4, 5, 6}) pair.memory[c] = -pair.memory[c];
    }
    pairs[kept++] = pair;
  }
  pairs.resize(kept);
  kept = 0;
  for (OnWall contact : on_wall) {
    contact.sphere = new_number[contact.sphere];
    if (contact.sphere >= 0) on_wall[kept++] = contact;
  }
  on_wall.resize(kept);
  sort();
}

}  // namespace seedflow
