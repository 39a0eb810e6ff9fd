#pragma once

#include <algorithm>
#include <vector>

#include "seedflow/seeds/stl.h"

namespace seedflow {

/// The point of a triangle that is nearest to another point.
struct TrianglePoint {
  Vec3 point;
  double square = 0;           ///< of the distance [m2]
  int edge = -1, corner = -1;  ///< on the edge opposite to this corner, or at this corner; else on the face
};

/// `corner`: the three corners; `face_normal`: the unit normal.
TrianglePoint nearest_on_triangle(const Vec3* corner, const Vec3& face_normal, const Vec3& x);

/// Normals of a surface and the pseudonormals of its edges and corners (sum over the faces, at corners
/// weighted with the angle; Baerentzen & Aanaes 2005, doi 10.1109/TVCG.2005.49): they tell the side on which
/// a point lies whose nearest point is on an edge or a corner.
struct SurfaceNormals {
  std::vector<Vec3> face, vertex;         ///< face: unit vectors
  std::vector<std::array<Vec3, 3>> edge;  ///< of each triangle's edge opposite to its corner

  explicit SurfaceNormals(const TriangleSurface& surface);
  const Vec3& at(const TriangleSurface& surface, int triangle, const TrianglePoint& place) const {
    if (place.corner >= 0) return vertex[surface.triangle[triangle][place.corner]];
    return place.edge >= 0 ? edge[triangle][place.edge] : face[triangle];
  }
};

/// A tree of bounding boxes over the triangles of a surface, for searches that cost the logarithm of their
/// number.
class TriangleTree {
 public:
  /// Sorts the triangles of the surface.
  explicit TriangleTree(TriangleSurface& surface);

  /// Calls visit(triangle) for the triangles whose leaf comes closer to x than best_square (squared [m2]),
  /// nearer ones first; visit may lower best_square.
  template <class Visit>
  void nearer_than(const Vec3& x, double& best_square, const Visit& visit) const {
    search(0, x, best_square, visit);
  }

  const Vec3& low() const { return nodes[0].low; }
  const Vec3& high() const { return nodes[0].high; }

 private:
  struct Node {
    Vec3 low, high;
    int first = 0, count = 0;  ///< triangles, for a leaf (count > 0)
    int left = -1, right = -1;
  };
  int build(TriangleSurface& surface, int first, int count);
  double distance_square(const Node& node, const Vec3& x) const {
    double sum = 0;
    for (int d = 0; d < 3; ++d) {
      const double out = std::max({node.low[d] - x[d], 0.0, x[d] - node.high[d]});
      sum += out * out;
    }
    return sum;
  }
  template <class Visit>
  void search(int index, const Vec3& x, double& best_square, const Visit& visit) const {
    const Node& node = nodes[index];
    if (node.count > 0) {
      for (int i = node.first; i < node.first + node.count; ++i) visit(i);
      return;
    }
    int near = node.left, far = node.right;
    double near_square = distance_square(nodes[near], x), far_square = distance_square(nodes[far], x);
    if (far_square < near_square) std::swap(near, far), std::swap(near_square, far_square);
    if (near_square < best_square) search(near, x, best_square, visit);
    if (far_square < best_square) search(far, x, best_square, visit);
  }

  std::vector<Node> nodes;
};

}  // namespace seedflow
