#include "seedflow/seeds/shape.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

double sign(double a) {
  return a < 0 ? -1.0 : 1.0;
}

/// Signed distance to the ellipsoid with semi-axes a, the shortest last. The nearest surface point is
/// p_i = a_i^2 x_i / (a_i^2 + t) with the largest root t of F(t) = sum (a_i x_i / (a_i^2 + t))^2 - 1 (Eberly,
/// "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid", Geometric Tools, 2013). Written
/// in s = t + c^2, so that points near the plane of the two longer axes lose no digits; F falls and is convex
/// for s > 0, so Newton's method from the left never overshoots.
double ellipsoid_distance(const Vec3& a, const Vec3& x, Vec3& outward) {
  Vec3 gap;  // a_i^2 - c^2, which a_i^2 + t exceeds by s
  for (int d = 0; d < 2; ++d) gap[d] = (a[d] - a.z) * (a[d] + a.z);
  double s = 0;  // left of the root: one term of the sum alone is already 1 here
  for (int d = 0; d < 3; ++d) s = std::max(s, a[d] * std::abs(x[d]) - gap[d]);
  for (int step = 0; step < 100; ++step) {
    double f = -1, slope = 0;
    for (int d = 0; d < 3; ++d) {
      if (x[d] == 0) continue;
      const double q = a[d] * x[d] / (gap[d] + s);
      f += q * q;
      slope += 2 * q * q / (gap[d] + s);
    }
    if (!(f > 0)) break;
    const double next = s + f / slope;
    if (!(next > s * (1 + 1e-15))) break;
    s = next;
  }
  Vec3 p;
  double rest = 1;
  for (int d = 0; d < 3; ++d) {
    if (x[d] != 0) p[d] = a[d] * a[d] * x[d] / (gap[d] + s);
    rest -= p[d] * p[d] / (a[d] * a[d]);
  }
  // On the medial axis (x = 0 along the shortest axis, no root above s = 0) the nearest point keeps that
  // axis' length.
  if (s == 0) p.z = a.z * std::sqrt(std::max(rest, 0.0));

  double inside = -1;
  Vec3 normal;
  for (int d = 0; d < 3; ++d) {
    inside += x[d] * x[d] / (a[d] * a[d]);
    normal[d] = p[d] / (a[d] * a[d]);
  }
  outward = normal / norm(normal);
  return sign(inside) * norm(x - p);
}

}  // namespace

Shape ellipsoid_shape(const Vec3& a) {
  if (!(a.x >= a.y && a.y >= a.z && a.z > 0) || !std::isfinite(a.x * a.y * a.z)) {
    std::ostringstream message;
    message << "Ellipsoid: the semi-axes (" << a.x << ", " << a.y << ", " << a.z
            << ") m must be finite, positive and in descending order.";
    throw InputError(message.str());
  }
  Shape shape;
  if (a.x == a.y && a.y == a.z)
    shape.signed_distance = [r = a.x](const Vec3& x, Vec3& outward) {
      const double distance = norm(x);
      outward = distance > 0 ? x / distance : Vec3{0, 0, 1};
      return distance - r;
    };
  else
    shape.signed_distance = [a](const Vec3& x, Vec3& outward) { return ellipsoid_distance(a, x, outward); };
  shape.support = [a](const Vec3& n) { return norm(Vec3{a.x * n.x, a.y * n.y, a.z * n.z}); };
  shape.low = -a;
  shape.high = a;
  shape.volume = 4.0 / 3.0 * M_PI * a.x * a.y * a.z;
  shape.second_moment = {a.x * a.x / 5, a.y * a.y / 5, a.z * a.z / 5};
  shape.semi_axes = a;
  shape.inscribed_radius = a.z;
  return shape;
}

Shape sphere_shape(double diameter) {
  return ellipsoid_shape(0.5 * Vec3{diameter, diameter, diameter});
}

}  // namespace seedflow
