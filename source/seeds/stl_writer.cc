#include "seedflow/seeds/stl_writer.h"

#include <cstdint>
#include <cstring>
#include <ostream>
#include <string>

namespace seedflow {

namespace {

void put(std::uint32_t bits, int bytes, std::ostream& out) {
  for (int i = 0; i < bytes; ++i) out.put(static_cast<char>(bits >> 8 * i & 255));
}

void put(const Vec3& x, std::ostream& out) {
  for (int d = 0; d < 3; ++d) {
    const float value = static_cast<float>(x[d]);
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    put(bits, 4, out);
  }
}

}  // namespace

void write_stl(const TriangleSurface& s, double unit, std::ostream& out) {
  std::string header = "binary STL";
  header.resize(80, ' ');
  out << header;
  put(static_cast<std::uint32_t>(s.triangle.size()), 4, out);
  for (const auto& [a, b, c] : s.triangle) {
    const Vec3 normal = cross(s.vertex[b] - s.vertex[a], s.vertex[c] - s.vertex[a]);
    put(norm(normal) > 0 ? normal / norm(normal) : Vec3{}, out);
    for (const int v : {a, b, c}) put(s.vertex[v] / unit, out);
    put(0, 2, out);
  }
}

}  // namespace seedflow
