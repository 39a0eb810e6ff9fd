#include "seedflow/seeds/stl_distance.h"

#include <algorithm>
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

double box_distance_square(const Vec3& low, const Vec3& high, const Vec3& x) {
  double sum = 0;
  for (int d = 0; d < 3; ++d) {
    const double out = std::max({low[d] - x[d], 0.0, x[d] - high[d]});
    sum += out * out;
  }
  return sum;
}

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

}  // namespace

SurfaceDistance::SurfaceDistance(TriangleSurface s) : surface(std::move(s)) {
  // Boxes first: building the tree sorts the triangles.
  build(0, static_cast<int>(surface.triangle.size()));
  vertex_normal.resize(surface.vertex.size());
  std::map<std::pair<int, int>, Vec3> edge;
  for (const auto& t : surface.triangle) {
    const Vec3 p[3] = {surface.vertex[t[0]], surface.vertex[t[1]], surface.vertex[t[2]]};
    const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    face_normal.push_back(n / norm(n));
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3, last = (c + 2) % 3;
      vertex_normal[t[c]] += angle(p[next] - p[c], p[last] - p[c]) * face_normal.back();
      edge[std::minmax(t[next], t[last])] += face_normal.back();
    }
  }
  for (const auto& t : surface.triangle)
    edge_normal.push_back(
        {edge[std::minmax(t[1], t[2])], edge[std::minmax(t[2], t[0])], edge[std::minmax(t[0], t[1])]});
}

int SurfaceDistance::build(int first, int count) {
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
    node.left = build(first, count / 2);
    node.right = build(first + count / 2, count - count / 2);
  }
  nodes[self] = node;
  return self;
}

void SurfaceDistance::compare(int triangle, const Vec3& x, Nearest& best) const {
  const auto& t = surface.triangle[triangle];
  const Vec3 p[3] = {surface.vertex[t[0]], surface.vertex[t[1]], surface.vertex[t[2]]};
  const auto offer = [&](const Vec3& point, const Vec3& normal) {
    const double square = norm_square(x - point);
    if (square < best.square) best = {point, normal, square};
  };

  // Above the face if x lies on the inner side of all three edge planes.
  const Vec3& n = face_normal[triangle];
  bool inside = true;
  for (int c = 0; c < 3; ++c) {
    const Vec3 &a = p[(c + 1) % 3], &b = p[(c + 2) % 3];
    if (dot(cross(n, b - a), x - a) >= 0) continue;
    inside = false;
    const double along = dot(x - a, b - a) / norm_square(b - a);
    if (along <= 0)
      offer(a, vertex_normal[t[(c + 1) % 3]]);
    else if (along >= 1)
      offer(b, vertex_normal[t[(c + 2) % 3]]);
    else
      offer(a + along * (b - a), edge_normal[triangle][c]);
  }
  if (inside) offer(x - dot(n, x - p[0]) * n, n);
}

void SurfaceDistance::search(int index, const Vec3& x, Nearest& best) const {
  const Node& node = nodes[index];
  if (node.count > 0) {
    for (int i = node.first; i < node.first + node.count; ++i) compare(i, x, best);
    return;
  }
  int near = node.left, far = node.right;
  double near_square = box_distance_square(nodes[near].low, nodes[near].high, x);
  double far_square = box_distance_square(nodes[far].low, nodes[far].high, x);
  if (far_square < near_square) std::swap(near, far), std::swap(near_square, far_square);
  if (near_square < best.square) search(near, x, best);
  if (far_square < best.square) search(far, x, best);
}

double SurfaceDistance::operator()(const Vec3& x, Vec3& outward) const {
  Nearest best{{}, {}, std::numeric_limits<double>::max()};
  search(0, x, best);
  const double distance = std::sqrt(best.square);
  const Vec3 normal = best.normal / norm(best.normal);
  const double side = dot(x - best.point, normal) < 0 ? -1 : 1;
  // On the surface the direction to it is lost in round-off; the pseudonormal stands for it.
  const double size = norm(nodes[0].high - nodes[0].low);
  outward = distance > 1e-12 * size ? side / distance * (x - best.point) : normal;
  return side * distance;
}

}  // namespace seedflow
