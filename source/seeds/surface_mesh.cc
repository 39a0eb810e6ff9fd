#include "seedflow/seeds/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

// Two triangles of one plane, as exactly as single-precision STL files can say it.
constexpr double coplanar = 1e-5;  // sine of the angle between the normals

// Distances (squared) to two triangles that share the nearest point differ by round-off only.
constexpr double same_distance = 1e-11;

// Places closer together than this part of their distance to the centre are one place.
constexpr double same_place = 1e-4;

// Corners closer to a triangle than this part of the surface's size lie on it.
constexpr double on_surface = 1e-6;

// Of a solid only the side that faces the centre can be touched; a centre inside is pushed to the nearest
// face.
void drop_far_side(std::size_t begin, std::vector<WallPoint>& out) {
  std::size_t nearest = begin;
  for (std::size_t k = begin; k < out.size(); ++k)
    if (std::abs(out[k].distance) < std::abs(out[nearest].distance)) nearest = k;
  if (nearest == out.size()) return;
  if (out[nearest].distance < 0) {
    const WallPoint kept = out[nearest];
    out.resize(begin);
    out.push_back(kept);
    return;
  }
  out.erase(std::remove_if(out.begin() + begin, out.end(), [](const WallPoint& p) { return p.distance < 0; }),
            out.end());
}

}  // namespace

TriangleWall::TriangleWall(TriangleSurface s, bool is_closed)
    : surface(std::move(s)), tree(surface), normals(surface), closed(is_closed) {
  connect();
  number_features();
}

void TriangleWall::connect() {
  std::map<std::pair<int, int>, std::vector<int>> sharing;
  std::vector<std::vector<int>> around(surface.vertex.size());
  const int n = static_cast<int>(surface.triangle.size());
  for (int i = 0; i < n; ++i) {
    const auto& t = surface.triangle[i];
    for (int c = 0; c < 3; ++c) {
      sharing[std::minmax(t[(c + 1) % 3], t[(c + 2) % 3])].push_back(i);
      around[t[c]].push_back(i);
    }
  }
  std::map<std::pair<int, int>, int> number;
  for (const auto& [ends, triangles] : sharing) {
    number[ends] = static_cast<int>(edges.size());
    edges.push_back({static_cast<int>(edge_triangle.size()), static_cast<int>(triangles.size()), 0, 0});
    edge_triangle.insert(edge_triangle.end(), triangles.begin(), triangles.end());
    // At a rim other triangles may go on whose corners lie elsewhere on the same line.
    if (triangles.size() > 1) continue;
    const double tolerance = on_surface * norm(tree.high() - tree.low());
    const Vec3 a = surface.vertex[ends.first], b = surface.vertex[ends.second];
    const double reach = 0.5 * norm(b - a) + tolerance;
    double square = reach * reach;
    tree.nearer_than(0.5 * (a + b), square, [&](int j) {
      if (j == triangles[0] || !(nearest(j, 0.5 * (a + b)).square < square)) return;
      edge_triangle.push_back(j);
      ++edges.back().beside;
      for (const int v : {ends.first, ends.second}) {
        auto& own = around[v];
        if (nearest(j, surface.vertex[v]).square < tolerance * tolerance &&
            std::find(own.begin(), own.end(), j) == own.end())
          own.push_back(j);
      }
    });
  }
  edge_of.resize(n);
  for (int i = 0; i < n; ++i) {
    const auto& t = surface.triangle[i];
    for (int c = 0; c < 3; ++c) edge_of[i][c] = number.at(std::minmax(t[(c + 1) % 3], t[(c + 2) % 3]));
  }
  vertex_first.assign(1, 0);
  for (const auto& triangles : around) {
    vertex_triangle.insert(vertex_triangle.end(), triangles.begin(), triangles.end());
    vertex_first.push_back(static_cast<int>(vertex_triangle.size()));
  }
}

void TriangleWall::number_features() {
  // Facets: everything in the plane of a first triangle that is connected with it through edges.
  const int n = static_cast<int>(surface.triangle.size());
  facet.assign(n, -1);
  std::vector<int> open;
  for (int first = 0; first < n; ++first) {
    if (facet[first] >= 0) continue;
    facet[first] = facets;
    open.assign(1, first);
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      for (const int e : edge_of[i])
        for (int k = 0; k < edges[e].count; ++k) {
          const int j = edge_triangle[edges[e].first_triangle + k];
          if (facet[j] >= 0 || norm(cross(normals.face[first], normals.face[j])) > coplanar) continue;
          facet[j] = facets;
          open.push_back(j);
        }
    }
    ++facets;
  }
  const auto common = [&](const int* triangle, int count) {
    for (int k = 1; k < count; ++k)
      if (facet[triangle[k]] != facet[triangle[0]]) return -1;
    return count > 0 ? facet[triangle[0]] : -1;
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const int inside = common(&edge_triangle[edges[e].first_triangle], edges[e].count);
    // The rim of an open surface is an edge, not part of its facet.
    edges[e].feature = inside >= 0 && edges[e].count > 1 ? inside : facets + static_cast<int>(e);
  }
  for (std::size_t v = 0; v < surface.vertex.size(); ++v) {
    const int first = vertex_first[v], count = vertex_first[v + 1] - first;
    int inside = count > 0 ? common(&vertex_triangle[first], count) : -1;
    for (int k = 0; inside >= 0 && k < count; ++k) {
      const int i = vertex_triangle[first + k];
      for (int c = 0; c < 3; ++c)
        if (surface.triangle[i][c] != static_cast<int>(v) && edges[edge_of[i][c]].count < 2) inside = -1;
    }
    vertex_feature.push_back(inside >= 0 ? inside : facets + static_cast<int>(edges.size() + v));
  }
}

TrianglePoint TriangleWall::nearest(int triangle, const Vec3& x) const {
  const auto& t = surface.triangle[triangle];
  const Vec3 corner[3] = {surface.vertex[t[0]], surface.vertex[t[1]], surface.vertex[t[2]]};
  return nearest_on_triangle(corner, normals.face[triangle], x);
}

bool TriangleWall::is_least(int triangle, const TrianglePoint& near, const Vec3& x) const {
  const int *first, *last;
  if (near.corner >= 0) {
    const int v = surface.triangle[triangle][near.corner];
    first = vertex_triangle.data() + vertex_first[v], last = vertex_triangle.data() + vertex_first[v + 1];
  } else if (near.edge >= 0) {
    const Edge& e = edges[edge_of[triangle][near.edge]];
    first = edge_triangle.data() + e.first_triangle, last = first + e.count + e.beside;
  } else {
    return true;
  }
  const double tolerance = on_surface * norm(tree.high() - tree.low());
  for (; first != last; ++first)
    if (*first != triangle && nearest(*first, x).square < near.square * (1 - same_distance) &&
        nearest(*first, near.point).square < tolerance * tolerance)
      return false;
  return true;
}

int TriangleWall::feature(int triangle, const TrianglePoint& near) const {
  if (near.corner >= 0) return vertex_feature[surface.triangle[triangle][near.corner]];
  if (near.edge >= 0) return edges[edge_of[triangle][near.edge]].feature;
  return facet[triangle];
}

void TriangleWall::points_near(const Vec3& x, double reach, bool inside_out,
                               std::vector<WallPoint>& out) const {
  const std::size_t begin = out.size();
  double square = reach * reach;
  const double size = norm(tree.high() - tree.low());
  tree.nearer_than(x, square, [&](int triangle) {
    const TrianglePoint near = nearest(triangle, x);
    if (!(near.square < square) || !is_least(triangle, near, x)) return;
    const double distance = std::sqrt(near.square);
    const Vec3& pseudonormal = normals.at(surface, triangle, near);
    const Vec3 unit = pseudonormal / norm(pseudonormal);
    double side = 1;
    if (closed) side = (dot(x - near.point, unit) < 0) != inside_out ? -1 : 1;
    WallPoint p;
    p.distance = side * distance;
    // On the surface the direction to it is lost in round-off; the pseudonormal stands for it.
    p.normal = distance > 1e-12 * size ? side / distance * (x - near.point) : inside_out ? -unit : unit;
    p.feature = feature(triangle, near);
    for (std::size_t k = begin; k < out.size(); ++k) {
      // Equal directions at equal distances: one place seen from two triangles.
      if (norm_square(out[k].normal - p.normal) > same_place * same_place ||
          std::abs(out[k].distance - p.distance) > same_place * distance)
        continue;
      if (p.feature < out[k].feature) out[k] = p;
      return;
    }
    out.push_back(p);
  });
  if (closed) drop_far_side(begin, out);
}

double TriangleWall::distance(const Vec3& x) const {
  double square = std::numeric_limits<double>::max(), side = 1;
  tree.nearer_than(x, square, [&](int triangle) {
    const TrianglePoint near = nearest(triangle, x);
    if (!(near.square < square)) return;
    square = near.square;
    side = closed && dot(x - near.point, normals.at(surface, triangle, near)) < 0 ? -1 : 1;
  });
  return side * std::sqrt(square);
}

Mesh::Mesh(TriangleSurface s, Side wanted, const std::string& name) : side(wanted) {
  if (s.triangle.empty()) throw InputError("Wall '" + name + "': the surface has no triangles.");
  if (side == Side::both) {
    require_area(s, name);
  } else {
    try {
      require_closed(s, name);
    } catch (const InputError& error) {
      throw InputError(std::string(error.what()) +
                       " A wall with seeds on one side only needs a closed surface; "
                       "an open one is a wall with two sides (side both).");
    }
  }
  surface = std::make_shared<const TriangleWall>(std::move(s), side != Side::both);
}

void Mesh::check(const std::string& name) {
  if (!surface) throw InputError("Wall '" + name + "': it has no triangles. Give an STL file.");
}

TriangleSurface read_wall_triangles(const std::string& file, double scale, const Vec3& shift) {
  TriangleSurface s = read_triangles(file);
  for (Vec3& x : s.vertex) x = scale * x + shift;
  return s;
}

}  // namespace seedflow
