#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/seeds/stl.h"

namespace seedflow {
namespace {

Vec3 corner_mean(const TriangleSurface& s) {
  Vec3 sum;
  for (const Vec3& x : s.vertex) sum += x;
  return sum / static_cast<double>(s.vertex.size());
}

std::string place(const Vec3& x) {
  std::ostringstream text;
  text << "(" << x.x << ", " << x.y << ", " << x.z << ")";
  return text.str();
}

using Edge = std::pair<int, int>;

}  // namespace

void require_area(const TriangleSurface& s, const std::string& name) {
  for (const auto& [a, b, c] : s.triangle) {
    const Vec3 ab = s.vertex[b] - s.vertex[a], ac = s.vertex[c] - s.vertex[a];
    const double longest = std::max({norm_square(ab), norm_square(ac), norm_square(ab - ac)});
    if (!(norm(cross(ab, ac)) > 1e-12 * longest))
      throw InputError(
          name + ": the triangle at " + place(s.vertex[a]) +
          " has no area (its corners lie on a line); remove degenerate triangles in the mesh program.");
  }
}

namespace {

void require_manifold(const TriangleSurface& s, const std::string& name) {
  std::map<Edge, int> along;  // how often an edge is passed in this direction
  for (const auto& t : s.triangle)
    for (int c = 0; c < 3; ++c) ++along[{t[c], t[(c + 1) % 3]}];
  int open = 0, flipped = 0, crowded = 0;
  Edge first_open, first_flipped, first_crowded;
  for (const auto& [edge, count] : along) {
    const auto back = along.find({edge.second, edge.first});
    const int opposite = back == along.end() ? 0 : back->second;
    if (count + opposite > 2) {
      if (crowded++ == 0) first_crowded = edge;
    } else if (count + opposite == 1) {
      if (open++ == 0) first_open = edge;
    } else if (count == 2) {
      if (flipped++ == 0) first_flipped = edge;
    }
  }
  const auto reject = [&](int count, const Edge& edge, const std::string& what, const std::string& remedy) {
    throw InputError(name + ": " + std::to_string(count) + " edges " + what + ", the first from " +
                     place(s.vertex[edge.first]) + " to " + place(s.vertex[edge.second]) + "; " + remedy);
  };
  if (crowded)
    reject(crowded, first_crowded, "are shared by more than two triangles",
           "the surface must be the boundary of one body: remove doubled and inner triangles.");
  if (open)
    reject(open, first_open, "belong to one triangle only, so the surface is open",
           "close the holes, or merge vertices that should be one, in the mesh program.");
  if (flipped)
    reject(flipped, first_flipped, "join triangles of opposite orientation",
           "unify the normals in the mesh program so that all point outwards.");
}

void require_one_body(const TriangleSurface& s, const std::string& name) {
  std::vector<int> piece(s.vertex.size());
  std::iota(piece.begin(), piece.end(), 0);
  const auto root = [&](int i) {
    while (piece[i] != i) i = piece[i] = piece[piece[i]];
    return i;
  };
  for (const auto& [a, b, c] : s.triangle) piece[root(b)] = root(a), piece[root(c)] = root(a);
  const int body = root(s.triangle[0][0]);
  for (const auto& t : s.triangle)
    if (root(t[0]) != body)
      throw InputError(name + ": the surface has more than one piece, one at " + place(s.vertex[body]) +
                       ", one at " + place(s.vertex[t[0]]) + "; keep the outer surface of one body.");
}

}  // namespace

SurfaceMoments moments(const TriangleSurface& s) {
  SurfaceMoments m;
  const Vec3 origin = corner_mean(s);  // near the body: no cancellation
  Vec3 first;
  for (const auto& t : s.triangle) {
    const Vec3 p[3] = {s.vertex[t[0]] - origin, s.vertex[t[1]] - origin, s.vertex[t[2]] - origin};
    const double six_volumes = dot(p[0], cross(p[1], p[2]));
    const Vec3 sum = p[0] + p[1] + p[2];
    m.volume += six_volumes / 6;
    first += six_volumes / 24 * sum;
    const auto second = [&](int a, int b) {
      return six_volumes / 120 *
             (sum[a] * sum[b] + p[0][a] * p[0][b] + p[1][a] * p[1][b] + p[2][a] * p[2][b]);
    };
    m.square += Vec3{second(0, 0), second(1, 1), second(2, 2)};
    m.mixed += Vec3{second(0, 1), second(0, 2), second(1, 2)};
  }
  const Vec3 c = first / m.volume;
  m.square = m.square / m.volume - Vec3{c.x * c.x, c.y * c.y, c.z * c.z};
  m.mixed = m.mixed / m.volume - Vec3{c.x * c.y, c.x * c.z, c.y * c.z};
  m.centroid = origin + c;
  return m;
}

void require_closed(TriangleSurface& s, const std::string& name) {
  if (s.triangle.empty()) throw InputError(name + ": the surface has no triangles; export it again.");
  require_area(s, name);
  require_manifold(s, name);
  require_one_body(s, name);
  if (moments(s).volume < 0)
    for (auto& t : s.triangle) std::swap(t[1], t[2]);
}

}  // namespace seedflow
