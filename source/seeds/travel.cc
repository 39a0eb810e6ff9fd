#include "seedflow/seeds/travel.h"

#include <algorithm>
#include <cmath>

namespace seedflow {

void Travel::begin(const std::vector<SeedStore>& stores, const SeedShare& share, double skin) {
  reach = skin;
  of_pair = of_seed = of_walls = 0;
  reference.assign(stores.size(), {});
  for (std::size_t t = 0; t < stores.size(); ++t) {
    const SeedStore& s = stores[t];
    Reference& r = reference[t];
    const std::size_t blocks = share.end(t) - share.begin(t);
    const bool turns = s.rigid && s.n_spheres() > 1;
    r.sphere.reserve(s.rigid ? 0 : blocks * s.n_spheres());
    r.centre.reserve(s.rigid ? blocks : 0), r.orientation.reserve(turns ? blocks : 0);
    for (int b = share.begin(t); b < share.end(t); ++b) {
      if (s.rigid) r.centre.push_back(s.body[b].position);
      if (turns) r.orientation.push_back(s.body[b].orientation);
      for (int i = 0; !s.rigid && i < s.n_spheres(); ++i) r.sphere.push_back(s.block(b)[i].position);
    }
  }
}

std::vector<double> Travel::two_longest(const std::vector<SeedStore>& stores, const SeedShare& share) const {
  double first = 0, second = 0;
  const auto take = [&](const SeedStore& s, int b, Lanes way) {
    for (int lane = 0; lane < lane_width; ++lane) {
      if (s.occupied[b][lane] == 0.0) continue;
      second = std::max(second, std::min(first, way[lane]));
      first = std::max(first, way[lane]);
    }
  };
  for (std::size_t t = 0; t < stores.size(); ++t) {
    const SeedStore& s = stores[t];
    const Reference& r = reference[t];
    const int n = s.n_spheres();
    for (int b = share.begin(t), k = 0; b < share.end(t); ++b, ++k) {
      Lanes square = {};
      if (!s.rigid) {
        for (int i = 0; i < n; ++i) {
          const LaneVec3 d = s.block(b)[i].position - r.sphere[static_cast<std::size_t>(k) * n + i];
          square = lane_max(square, dot(d, d));
        }
        take(s, b, lane_sqrt(square));
        continue;
      }
      const LaneVec3 d = s.body[b].position - r.centre[k];
      Lanes way = lane_sqrt(dot(d, d));
      if (n > 1) {
        // Turned by the angle a a point at r goes 2 r sin(a/2), and sin(a/2) is the vector part of q q0*.
        const LaneQuaternion &q = s.body[b].orientation, &q0 = r.orientation[k];
        const LaneVec3 v = q0.w * q.v - q.w * q0.v - cross(q.v, q0.v);
        way += (2 * s.model.bounding_radius) * lane_sqrt(dot(v, v));
      }
      take(s, b, way);
    }
  }
  std::vector<double> longest{first, second};
  share.concatenate(longest);
  std::partial_sort(longest.begin(), longest.begin() + 2, longest.end(), std::greater<double>());
  return longest;
}

double Travel::way(const std::vector<SeedStore>& stores, const SeedShare& share) {
  const std::vector<double> longest = two_longest(stores, share);
  of_pair = longest[0] + longest[1], of_seed = longest[0];
  return bound();
}

std::size_t Travel::bytes() const {
  std::size_t sum = 0;
  for (const Reference& r : reference)
    sum += (r.sphere.capacity() + r.centre.capacity()) * sizeof(LaneVec3) +
           r.orientation.capacity() * sizeof(LaneQuaternion);
  return sum;
}

}  // namespace seedflow
