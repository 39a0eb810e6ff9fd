#include "seedflow/seeds/triangle_tree.h"

#include <cmath>
#include <limits>
#include <map>

namespace seedflow {
namespace {

Vec3 smaller(const Vec3& a, const Vec3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 larger(const Vec3& a, const Vec3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

}  // namespace

TrianglePoint nearest_on_triangle(const Vec3* p, const Vec3& n, const Vec3& x) {
  TrianglePoint best;
  best.square = std::numeric_limits<double>::max();
  const auto offer = [&](const Vec3& point, int edge, int corner) {
    const double square = norm_square(x - point);
    if (square < best.square) best = {point, square, edge, corner};
  };
  // Above the face if x lies on the inner side of all three edge planes.
  bool inside = true;
  for (int c = 0; c < 3; ++c) {
    const int next = (c + 1) % 3, last = (c + 2) % 3;
    const Vec3 &a = p[next], &b = p[last];
    if (dot(cross(n, b - a), x - a) >= 0) continue;
    inside = false;
    const double along = dot(x - a, b - a) / norm_square(b - a);
    if (along <= 0)
      offer(a, -1, next);
    else if (along >= 1)
      offer(b, -1, last);
    else
      offer(a + along * (b - a), c, -1);
  }
  if (inside) offer(x - dot(n, x - p[0]) * n, -1, -1);
  return best;
}

SurfaceNormals::SurfaceNormals(const TriangleSurface& surface) : vertex(surface.vertex.size()) {
  std::map<std::pair<int, int>, Vec3> sum;
  for (const auto& t : surface.triangle) {
    const Vec3 p[3] = {surface.vertex[t[0]], surface.vertex[t[1]], surface.vertex[t[2]]};
    const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    face.push_back(n / norm(n));
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3, last = (c + 2) % 3;
      vertex[t[c]] += angle(p[next] - p[c], p[last] - p[c]) * face.back();
      sum[std::minmax(t[next], t[last])] += face.back();
    }
  }
  for (const auto& t : surface.triangle)
    edge.push_back(
        {sum[std::minmax(t[1], t[2])], sum[std::minmax(t[2], t[0])], sum[std::minmax(t[0], t[1])]});
}

TriangleTree::TriangleTree(TriangleSurface& surface) {
  build(surface, 0, static_cast<int>(surface.triangle.size()));
}

int TriangleTree::build(TriangleSurface& surface, int first, int count) {
  const int self = static_cast<int>(nodes.size());
  nodes.emplace_back();
  Node node;
  node.low = node.high = surface.vertex[surface.triangle[first][0]];
  for (int i = first; i < first + count; ++i)
    for (const int v : surface.triangle[i]) {
      node.low = smaller(node.low, surface.vertex[v]);
      node.high = larger(node.high, surface.vertex[v]);
    }
  if (count <= 4) {
    node.first = first;
    node.count = count;
  } else {
    const Vec3 size = node.high - node.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto middle_of = [&](const std::array<int, 3>& t) {
      return surface.vertex[t[0]][axis] + surface.vertex[t[1]][axis] + surface.vertex[t[2]][axis];
    };
    const auto begin = surface.triangle.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count,
                     [&](const auto& a, const auto& b) { return middle_of(a) < middle_of(b); });
    node.left = build(surface, first, count / 2);
    node.right = build(surface, first + count / 2, count - count / 2);
  }
  nodes[self] = node;
  return self;
}

}  // namespace seedflow
