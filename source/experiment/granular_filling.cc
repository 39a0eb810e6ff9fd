#include "seedflow/experiment/granular_filling.h"

#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"

namespace seedflow {

Quaternion RandomNumbers::orientation() {
  const double u = uniform(), a = 2 * M_PI * uniform(), b = 2 * M_PI * uniform();
  const double s = std::sqrt(1 - u), t = std::sqrt(u);
  return normalized({t * std::cos(b), {s * std::sin(a), s * std::cos(a), t * std::sin(b)}});
}

std::vector<Vec3> lattice_places(const FillingRoom& room, int n, double radius, RandomNumbers& random) {
  // Neighbours are 2.2 radii apart; shaken by 0.08 radii in each direction they still do not touch.
  const double edge = 2.2 * radius, shake = 0.08 * radius;
  int cells[3];
  Vec3 first;
  for (int d = 0; d < 3; ++d) {
    const double free = room.high[d] - room.low[d] - 2 * (radius + shake);
    cells[d] = free < 0 ? 0 : 1 + static_cast<int>(free / edge);
    first[d] = room.low[d] + radius + shake + 0.5 * (free - edge * (cells[d] - 1)) * (d < 2);
  }
  std::vector<Vec3> places;
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        Vec3 x = first + edge * Vec3{1.0 * i, 1.0 * j, 1.0 * k};
        for (int d = 0; d < 3; ++d) x[d] += shake * (2 * random.uniform() - 1);
        if (room.has && !room.has(x, radius)) continue;
        places.push_back(x);
        if (static_cast<int>(places.size()) == n) return places;
      }
  std::ostringstream text;
  text << "'" << room.name << "' is full: only " << places.size() << " of the " << n
       << " seeds have room in it before they settle (" << 1e3 * (room.high.x - room.low.x) << " x "
       << 1e3 * (room.high.y - room.low.y) << " x " << 1e3 * (room.high.z - room.low.z) << " mm, seeds of "
       << 2e3 * radius << " mm). Use less mass (Filling/Mass) or a larger room.";
  throw InputError(text.str());
}

}  // namespace seedflow
