#include "seedflow/coupling/aperture_flow.h"

#include <algorithm>
#include <cmath>

namespace seedflow {

Vec3 aperture_velocity(const Vec3& x, double a, double flow, double limit) {
  const double z = std::max(x.z, 0.0) / a, rho = std::hypot(x.x, x.y) / a;
  const double d = rho * rho + z * z - 1;
  const double root = std::sqrt(d * d + 4 * z * z);
  // zeta^2 xi^2 = z^2; each square from the sum that does not cancel.
  const double zeta2 = d >= 0 ? 0.5 * (root + d) : 2 * z * z / std::max(root - d, 1e-300);
  const double xi2 = d >= 0 ? (zeta2 > 0 ? z * z / zeta2 : 0.0) : 0.5 * (root - d);
  const double zeta = std::sqrt(zeta2), xi = std::sqrt(std::min(xi2, 1.0));
  const double spread = std::sqrt(std::max(zeta2 + xi2, 1e-12));
  const double speed = std::min(limit, flow / (2 * M_PI * a * a * std::sqrt(1 + zeta2) * spread));
  const double across = zeta * std::sqrt(std::max(0.0, 1 - xi * xi)) / spread;
  const double up = xi * std::sqrt(1 + zeta2) / spread;
  const double scale = rho > 0 ? across / (rho * a) : 0;
  return -speed * Vec3{scale * x.x, scale * x.y, up};
}

}  // namespace seedflow
