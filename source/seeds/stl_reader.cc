#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <tuple>

#include "seedflow/base/error.h"
#include "seedflow/seeds/stl.h"

namespace seedflow {
namespace {

/// Collects triangles by their corners and merges equal corners.
class Collector {
 public:
  void add(const std::array<Vec3, 3>& corner) {
    std::array<int, 3> t;
    for (int c = 0; c < 3; ++c) {
      const Vec3 x = corner[c] + Vec3{};  // -0 becomes 0
      const auto [place, fresh] =
          number.try_emplace({x.x, x.y, x.z}, static_cast<int>(surface.vertex.size()));
      if (fresh) surface.vertex.push_back(x);
      t[c] = place->second;
    }
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) surface.triangle.push_back(t);
  }
  TriangleSurface surface;

 private:
  std::map<std::tuple<double, double, double>, int> number;
};

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

std::uint32_t little_endian(const unsigned char* b) {
  return b[0] | std::uint32_t(b[1]) << 8 | std::uint32_t(b[2]) << 16 | std::uint32_t(b[3]) << 24;
}

std::size_t binary_count(const std::string& data) {
  return little_endian(reinterpret_cast<const unsigned char*>(data.data()) + 80);
}

TriangleSurface read_binary(const std::string& data, const std::string& file) {
  Collector collector;
  for (std::size_t i = 0; i < binary_count(data); ++i) {
    // Normal (unused), three corners, two bytes of attributes (unused).
    const auto* p =
        reinterpret_cast<const unsigned char*>(data.data()) + header_bytes + triangle_bytes * i + 12;
    std::array<Vec3, 3> corner;
    for (Vec3& x : corner)
      for (int d = 0; d < 3; ++d, p += 4) {
        const std::uint32_t bits = little_endian(p);
        float value;
        std::memcpy(&value, &bits, sizeof value);
        if (!std::isfinite(value))
          throw InputError(file + ", triangle " + std::to_string(i) +
                           " (from 0): a coordinate is not a finite number; export the surface again.");
        x[d] = value;
      }
    collector.add(corner);
  }
  return std::move(collector.surface);
}

class AsciiReader {
 public:
  AsciiReader(const std::string& data, const std::string& file) : data(data), file(file) {}

  TriangleSurface read() {
    for (std::string word = next(); !word.empty(); word = next()) {
      if (word == "solid" || word == "endsolid") {
        skip_line();  // a name, which may be any text
      } else if (word == "facet") {
        expect("normal");
        for (int d = 0; d < 3; ++d) number(false);
        expect("outer"), expect("loop");
        std::array<Vec3, 3> corner;
        for (Vec3& x : corner) {
          expect("vertex");
          for (int d = 0; d < 3; ++d) x[d] = number(true);
        }
        expect("endloop"), expect("endfacet");
        collector.add(corner);
      } else {
        fail("'" + word + "' stands where 'facet' or 'endsolid' is expected");
      }
    }
    return std::move(collector.surface);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(file + ", line " + std::to_string(line) + ": " + reason +
                     "; export the surface again as STL.");
  }
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  std::string next() {
    for (; at < data.size() && blank(data[at]); ++at) line += data[at] == '\n';
    const std::size_t start = at;
    while (at < data.size() && !blank(data[at])) ++at;
    return data.substr(start, at - start);
  }
  void skip_line() {
    while (at < data.size() && data[at] != '\n') ++at;
  }
  void expect(const char* word) {
    const std::string found = next();
    if (found.empty()) fail(std::string("the file ends where '") + word + "' is expected");
    if (found != word) fail("'" + found + "' stands where '" + word + "' is expected");
  }
  /// Normals are unused and some programs write nan there for them; corners must be finite.
  double number(bool must_be_finite) {
    const std::string word = next();
    if (word.empty()) fail("the file ends where a number is expected");
    const char* const first = word.data() + (word[0] == '+');
    const char* const end = word.data() + word.size();
    double a = 0;
    const auto [stop, error] = std::from_chars(first, end, a);
    if (error != std::errc() || stop != end) fail("'" + word + "' is not a number");
    if (must_be_finite && !std::isfinite(a)) fail("'" + word + "' is not a finite coordinate");
    return a;
  }

  const std::string& data;
  const std::string& file;
  std::size_t at = 0;
  int line = 1;
  Collector collector;
};

}  // namespace

TriangleSurface read_triangles(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string data{std::istreambuf_iterator<char>(in), {}};
  if (!in || data.empty())
    throw InputError("STL surface: cannot read '" + file +
                     "' (missing or empty); give the name of an STL file.");
  // Binary files may begin with "solid" as well: their exact length decides first, and text has no zero
  // bytes.
  TriangleSurface surface;
  if (data.size() >= header_bytes && data.size() == header_bytes + triangle_bytes * binary_count(data))
    surface = read_binary(data, file);
  else if (data.compare(0, 5, "solid") == 0 && data.find('\0') == std::string::npos)
    surface = AsciiReader(data, file).read();
  else
    throw InputError(
        file + ": this is no complete STL surface: no text beginning with 'solid' (ASCII), and its " +
        std::to_string(data.size()) + " bytes are not 84 + 50 per triangle (binary; " +
        (data.size() >= header_bytes ? std::to_string(binary_count(data)) + " triangles announced"
                                     : "no complete header") +
        "). It may be cut off; export it again.");
  if (surface.triangle.empty()) throw InputError(file + ": the surface has no triangles; export it again.");
  return surface;
}

TriangleSurface read_stl(const std::string& file) {
  TriangleSurface surface = read_triangles(file);
  require_closed(surface, file);
  return surface;
}

}  // namespace seedflow
