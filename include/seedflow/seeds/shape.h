#pragma once

#include <functional>

#include "seedflow/base/vector.h"

namespace seedflow {

/// The outer shape of a real seed, homogeneous inside: what sub-spheres are packed into and what the clump is
/// compared with. Coordinates in m.
struct Shape {
  /// Signed distance from x to the surface [m], negative inside, and the unit vector along which it grows
  /// fastest.
  std::function<double(const Vec3& x, Vec3& outward)> signed_distance;

  Vec3 low, high;     ///< corners of the bounding box [m]
  double volume = 0;  ///< [m3]
  Vec3 centroid;      ///< [m]
  /// Second moments about the centroid, sum over the volume of x_a x_b, per volume [m2]: xx, yy, zz and xy,
  /// xz, yz.
  Vec3 second_moment, mixed_moment;
  /// Of the ellipsoid itself; for any other shape of the ellipsoid with the same volume and the same ratios
  /// of principal second moments [m].
  Vec3 semi_axes;
  double inscribed_radius = 0;  ///< radius of a sphere that fits inside [m]; exact for ellipsoids
};

/// A sphere of this diameter [m] around the origin.
Shape sphere_shape(double diameter);

/// An ellipsoid around the origin with these semi-axes [m] along x, y, z.
Shape ellipsoid_shape(const Vec3& semi_axes);

}  // namespace seedflow
