#include "seedflow/seeds/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

double sign(double a) {
  return a < 0 ? -1.0 : 1.0;
}

/// Signed distance to the ellipsoid with semi-axes a. The nearest surface point is p_i = a_i^2 x_i / (a_i^2 +
/// t) with the root t of F(t) = sum (a_i x_i / (a_i^2 + t))^2 - 1, which is the only one above t = -min a^2
/// (Eberly, "Distance from a point to an ellipsoid", Geometric Tools, 2013); F falls monotonically there, so
/// bisection and Newton steps within the bracket are safe.
double ellipsoid_distance(const Vec3& a, const Vec3& x, Vec3& outward) {
  int shortest = 0;
  for (int d = 1; d < 3; ++d)
    if (a[d] < a[shortest]) shortest = d;
  const double floor = -a[shortest] * a[shortest];
  const auto residual = [&](double t, double& slope) {
    double f = -1;
    slope = 0;
    for (int d = 0; d < 3; ++d) {
      const double q = a[d] * x[d] / (a[d] * a[d] + t);
      f += q * q;
      slope -= 2 * q * q / (a[d] * a[d] + t);
    }
    return f;
  };

  // On the medial axis (x = 0 along a shortest axis, deep inside) F has no root above the floor: the nearest
  // point then sits at t = floor with the remaining length along that axis.
  double f_floor = -1;
  for (int d = 0; d < 3; ++d) {
    if (x[d] == 0) continue;
    const double gap = a[d] * a[d] + floor;
    f_floor = gap > 0 ? f_floor + std::pow(a[d] * x[d] / gap, 2) : std::numeric_limits<double>::infinity();
  }
  Vec3 p;
  if (f_floor <= 0) {
    double rest = 1;
    for (int d = 0; d < 3; ++d) {
      const double gap = a[d] * a[d] + floor;
      p[d] = gap > 0 ? a[d] * a[d] * x[d] / gap : 0.0;
      rest -= p[d] * p[d] / (a[d] * a[d]);
    }
    p[shortest] = a[shortest] * std::sqrt(std::max(rest, 0.0));
  } else {
    double low = floor, high = 0, slope;
    for (int d = 0; d < 3; ++d) {
      low = std::max(low, a[d] * std::abs(x[d]) - a[d] * a[d]);  // one term alone is already 1
      high += a[d] * a[d] * x[d] * x[d];
    }
    high = std::max(std::sqrt(high) + floor, low);  // with all denominators at their smallest the sum is 1
    double t = low;
    for (int step = 0; step < 100; ++step) {
      const double f = residual(t, slope);
      (f > 0 ? low : high) = t;
      double next = std::isfinite(f) && slope < 0 ? t - f / slope : 0.5 * (low + high);
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      const bool settled = std::abs(next - t) <= 1e-15 * std::max(std::abs(t), -floor);
      t = next;
      if (settled) break;
    }
    for (int d = 0; d < 3; ++d) p[d] = x[d] == 0 ? 0.0 : a[d] * a[d] * x[d] / (a[d] * a[d] + t);
  }

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
  if (!(a.x > 0 && a.y > 0 && a.z > 0) || !std::isfinite(a.x * a.y * a.z)) {
    std::ostringstream message;
    message << "Ellipsoid: the semi-axes (" << a.x << ", " << a.y << ", " << a.z
            << ") m must be finite and positive.";
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
  shape.low = -a;
  shape.high = a;
  shape.volume = 4.0 / 3.0 * M_PI * a.x * a.y * a.z;
  shape.second_moment = {a.x * a.x / 5, a.y * a.y / 5, a.z * a.z / 5};
  shape.semi_axes = a;
  shape.inscribed_radius = std::min({a.x, a.y, a.z});
  return shape;
}

Shape sphere_shape(double diameter) {
  return ellipsoid_shape(0.5 * Vec3{diameter, diameter, diameter});
}

}  // namespace seedflow
