#pragma once

#include <array>
#include <string>

#include "seedflow/base/vector.h"

namespace seedflow {

/// A flow with closed-form derivatives,
///   u = U + A sin(w t) + (S x + C x^2) e_z,
/// uniform, oscillating, sheared and parabolic parts. The x axis points across the shear.
struct TruthFlow {
  Vec3 uniform;          ///< U [m/s]
  Vec3 amplitude;        ///< A [m/s]
  double frequency = 0;  ///< w [rad/s]
  double shear = 0;      ///< S [1/s]
  double curvature = 0;  ///< C [1/(m s)]

  Vec3 velocity(const Vec3& x, double t) const;
  /// du/dt at a fixed place [m/s2].
  Vec3 rate(double t) const;
  /// du/dt along the path of a point that moves at v: rate + (v . grad) u. With v = u it is Du/Dt.
  Vec3 rate_along(const Vec3& x, double t, const Vec3& v) const;
  Vec3 vorticity(const Vec3& x) const;
  Vec3 laplacian() const;
  /// The three components as expressions of x, y, z, t; "0" where there is none.
  std::array<std::string, 3> expressions() const;
};

}  // namespace seedflow
