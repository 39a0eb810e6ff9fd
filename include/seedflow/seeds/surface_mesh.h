#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "seedflow/seeds/polygon_surface.h"
#include "seedflow/seeds/triangle_tree.h"
#include "seedflow/seeds/wall_point.h"

namespace seedflow {

/// Triangles as a wall. A sphere touches where its distance to the surface has a local minimum: on a face, on
/// an edge if no triangle that shares the edge comes closer, at a corner if no triangle that shares the
/// corner comes closer. So a seam between triangles of one plane is no bump, a convex edge gives one contact
/// and a concave edge one with each of its faces.
///
/// Features: connected triangles of one plane have one number (the facet), then come the edges, then the
/// corners; those inside a facet have the facet's number.
class TriangleWall {
 public:
  /// `closed`: the surface bounds a solid (its corners counter-clockwise from outside); distances are
  /// negative inside it. Otherwise the surface pushes to the side a sphere's centre is on.
  TriangleWall(TriangleSurface surface, bool closed);

  void points_near(const Vec3& x, double reach, bool inside_out, std::vector<WallPoint>& out) const;
  /// Distance to the surface, negative inside the solid of a closed one.
  double distance(const Vec3& x) const;

  const TriangleSurface& triangles() const { return surface; }
  int n_facets() const { return facets; }
  bool is_closed() const { return closed; }

 private:
  struct Edge {
    int first_triangle = -1, count = 0;  ///< in edge_triangle
    int beside = 0;                      ///< further triangles there that may share part of the edge
    int feature = 0;
  };
  TrianglePoint nearest(int triangle, const Vec3& x) const;
  bool is_least(int triangle, const TrianglePoint& near, const Vec3& x) const;
  int feature(int triangle, const TrianglePoint& near) const;
  void connect();
  void number_features();

  TriangleSurface surface;
  TriangleTree tree;  // sorts the triangles: before what is numbered by them
  SurfaceNormals normals;
  bool closed;
  int facets = 0;
  std::vector<int> facet;                   ///< [triangle]
  std::vector<std::array<int, 3>> edge_of;  ///< [triangle] numbers of the edges opposite to its corners
  std::vector<Edge> edges;
  std::vector<int> edge_triangle;
  std::vector<int> vertex_first, vertex_triangle;  ///< triangles around each corner
  std::vector<int> vertex_feature;
};

/// A wall made of triangles, read from an STL file or made otherwise.
struct Mesh {
  enum class Side {
    both,     ///< thin: pushes to the side a sphere's centre is on
    outside,  ///< seeds are outside a closed surface
    inside    ///< seeds are inside a closed surface
  };

  std::shared_ptr<const TriangleWall> surface;  ///< never changes, shared between copies of the wall
  Side side = Side::both;

  Mesh() = default;
  /// Checks the triangles; InputError (naming `name`) for degenerate triangles, or if side is not `both` and
  /// the surface is open, in several pieces or of mixed orientation.
  Mesh(TriangleSurface surface, Side side, const std::string& name);

  void check(const std::string& name);
  void points_near(const Vec3& x, double reach, std::vector<WallPoint>& out) const {
    surface->points_near(x, reach, side == Side::inside, out);
  }
  double clearance(const Vec3& x) const {
    const double d = surface->distance(x);
    return side == Side::inside ? -d : d;
  }
};

/// An STL file as a surface in m: coordinates times `scale` [m per unit of the file], then moved by `shift`
/// [m].
TriangleSurface read_wall_triangles(const std::string& file, double scale, const Vec3& shift);

}  // namespace seedflow
