#include "seedflow/seeds/surface_box.h"

#include <algorithm>

#include "seedflow/base/error.h"

namespace seedflow {

void Box::check(const std::string& name) {
  for (int c = 0; c < 3; ++c)
    if (!(high[c] > low[c]))
      throw InputError("Wall '" + name + "': the box has no extent along " + std::string(1, "xyz"[c]) +
                       ". Its high corner must lie above its low corner in x, y and z.");
}

void Box::points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const {
  for (int c = 0; c < 3; ++c)
    for (int end = 0; end < 2; ++end) {
      const double distance = end ? high[c] - x[c] : x[c] - low[c];
      if (!(distance < reach)) continue;
      Vec3 normal;
      normal[c] = end ? -1 : 1;
      out.push_back({normal, distance, 2 * c + end, {}});
    }
}

double Box::clearance(const Vec3& x) const {
  double least = high.x - x.x;
  for (int c = 0; c < 3; ++c) least = std::min({least, x[c] - low[c], high[c] - x[c]});
  return least;
}

}  // namespace seedflow
