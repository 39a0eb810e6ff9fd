#pragma once

#include <array>
#include <vector>

#include "seedflow/seeds/stl.h"

namespace seedflow {

/// Exact signed distance to a closed, consistently oriented surface: the nearest triangle is found in a tree
/// of bounding boxes; the side is decided by the angle-weighted pseudonormal of the nearest face, edge or
/// vertex (Baerentzen & Aanaes 2005, doi 10.1109/TVCG.2005.49), which is right at edges and corners, too.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(TriangleSurface surface);

  /// Signed distance, negative inside, and the unit vector along which it grows fastest.
  double operator()(const Vec3& x, Vec3& outward) const;

 private:
  struct Node {
    Vec3 low, high;
    int first = 0, count = 0;  ///< triangles, for a leaf (count > 0)
    int left = -1, right = -1;
  };
  struct Nearest {
    Vec3 point, normal;
    double square;  ///< of the distance
  };
  int build(int first, int count);
  void search(int node, const Vec3& x, Nearest& best) const;
  void compare(int triangle, const Vec3& x, Nearest& best) const;

  TriangleSurface surface;
  std::vector<Vec3> face_normal, vertex_normal;
  std::vector<std::array<Vec3, 3>> edge_normal;  ///< of each triangle's edge opposite to its corner
  std::vector<Node> nodes;
};

}  // namespace seedflow
