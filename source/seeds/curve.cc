#include "seedflow/seeds/curve.h"

#include <algorithm>
#include <cstdint>

namespace seedflow {
namespace {

constexpr int bits = 16;

// Skilling's transform of cell coordinates into the transposed Hilbert index: inverse undoing of excess work
// from the highest bit down, then Gray encoding.
unsigned long long hilbert_index(std::uint32_t x[3]) {
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    const std::uint32_t low = q - 1;
    for (int c = 0; c < 3; ++c) {
      if (x[c] & q) {
        x[0] ^= low;
      } else {
        const std::uint32_t t = (x[0] ^ x[c]) & low;
        x[0] ^= t, x[c] ^= t;
      }
    }
  }
  x[1] ^= x[0], x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  unsigned long long index = 0;
  for (int b = bits - 1; b >= 0; --b)
    for (int c = 0; c < 3; ++c) index = index << 1 | ((x[c] ^ t) >> b & 1);
  return index;
}

}  // namespace

std::vector<unsigned long long> curve_keys(const std::vector<Vec3>& points) {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const Vec3& p : points)
    for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
  double size = 1e-300;
  for (int c = 0; c < 3; ++c) size = std::max(size, high[c] - low[c]);
  std::vector<unsigned long long> keys;
  keys.reserve(points.size());
  for (const Vec3& p : points) {
    std::uint32_t x[3];
    for (int c = 0; c < 3; ++c)
      x[c] = static_cast<std::uint32_t>(std::min(65535.0, (p[c] - low[c]) / size * 65536.0));
    keys.push_back(hilbert_index(x));
  }
  return keys;
}

}  // namespace seedflow
