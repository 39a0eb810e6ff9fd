#pragma once

#include <array>
#include <string>
#include <vector>

#include "seedflow/base/vector.h"
#include "seedflow/seeds/shape.h"

namespace seedflow {

/// A closed surface of triangles, its corners counter-clockwise seen from outside. Lengths in the file's
/// unit.
struct TriangleSurface {
  std::vector<Vec3> vertex;
  std::vector<std::array<int, 3>> triangle;
};

/// Volume, centroid and second moments of the homogeneous body inside a closed surface (divergence theorem:
/// signed tetrahedra from one point to all triangles; exact). In powers of the surface's unit.
struct SurfaceMoments {
  double volume = 0;
  Vec3 centroid;
  /// Means over the volume of x^2, y^2, z^2 and of xy, xz, yz, relative to the centroid.
  Vec3 square, mixed;
};
SurfaceMoments moments(const TriangleSurface& surface);

/// Reads an STL file, ASCII or binary. Corners that agree in all digits become one vertex; triangles
/// collapsed to a line between two vertices are left out, which leaves the surface as it is. The normals in
/// the file are not used: the order of the corners counts. A surface turned inside out as a whole is turned
/// back.
///
/// Errors: InputError with file, line (ASCII) or triangle (binary), reason and remedy: unreadable, malformed,
/// not finite, zero-area triangles, open, edges shared by more than two triangles, triangles of opposite
/// orientation, more than one piece. Surfaces that cut through themselves are not recognised.
TriangleSurface read_stl(const std::string& file);

/// Reads an STL file that may be open, in pieces and of any orientation, as a wall is. Errors: InputError as
/// of read_stl() for a file that is unreadable, malformed or empty.
TriangleSurface read_triangles(const std::string& file);

/// InputError if a triangle has no area.
void require_area(const TriangleSurface& surface, const std::string& name);

/// Checks and orients what read_stl() has read (also for surfaces made otherwise); `name` is used in
/// messages.
void require_closed(TriangleSurface& surface, const std::string& name);

/// The shape of a closed surface, scaled to the volume of a sphere of this diameter [m] (an STL has no unit),
/// moved to its centroid and turned into its principal axes.
Shape surface_shape(const TriangleSurface& surface, double diameter);

}  // namespace seedflow
