#pragma once

#include "seedflow/seeds/triangle_tree.h"

namespace seedflow {

/// Exact signed distance to a closed, consistently oriented surface: the nearest triangle is found in a tree
/// of bounding boxes; the side is decided by the angle-weighted pseudonormal of the nearest face, edge or
/// vertex, which is right at edges and corners, too.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(TriangleSurface surface);

  /// Signed distance, negative inside, and the unit vector along which it grows fastest.
  double operator()(const Vec3& x, Vec3& outward) const;

 private:
  TriangleSurface surface;
  TriangleTree tree;  // sorts the triangles, so before their normals
  SurfaceNormals normals;
};

}  // namespace seedflow
