#pragma once

#include <functional>

#include "seedflow/base/vector.h"

namespace seedflow {

/// The outer shape of a real seed, homogeneous inside: what sub-spheres are packed into and what the clump is
/// compared with. Coordinates in m, from the centroid, along the principal axes, the longest one first.
struct Shape {
  /// Signed distance from x to the surface [m], negative inside, and the unit vector along which it grows
  /// fastest.
  std::function<double(const Vec3& x, Vec3& outward)> signed_distance;
  /// How far the shape reaches from the centroid in the direction n (unit vector): max of n . x [m].
  std::function<double(const Vec3& n)> support;

  Vec3 low, high;      ///< corners of the bounding box [m]
  double volume = 0;   ///< [m3]
  Vec3 second_moment;  ///< means of x^2, y^2, z^2 over the volume [m2]; those of xy, xz, yz are zero
  /// Of the ellipsoid itself; for any other shape of the ellipsoid with the same volume and the same ratios
  /// of second moments [m].
  Vec3 semi_axes;
  double inscribed_radius = 0;  ///< of the largest sphere that fits inside [m]
  Vec3 deepest;                 ///< its centre [m]

  /// Principal moments of inertia of the homogeneous body of this mass [kg m2].
  Vec3 inertia(double mass) const {
    const Vec3& s = second_moment;
    return mass * Vec3{s.y + s.z, s.x + s.z, s.x + s.y};
  }
};

/// A sphere of this diameter [m] around the origin.
Shape sphere_shape(double diameter);

/// An ellipsoid around the origin with these semi-axes [m], the longest first.
/// Errors: InputError if they are not finite, positive and in descending order.
Shape ellipsoid_shape(const Vec3& semi_axes);

}  // namespace seedflow
