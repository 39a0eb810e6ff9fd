#pragma once

#include <cstdint>

#include "seedflow/base/vector.h"

namespace seedflow {

/// How the sphericity of a particle is defined.
enum class SphericityKind {
  axes,  ///< (a b c)^(1/3) / a, a the longest semi-axis (Mohsenin 1970): what a caliper gives, the habit with
         ///< seeds
  surface  ///< surface of the sphere of equal volume / surface of the particle (Wadell 1932)
};

/// Ellipsoids with two equal semi-axes.
enum class SpheroidKind {
  prolate,  ///< a > b = c
  oblate    ///< a = b > c
};

/// Sphericity [1] of the ellipsoid with these semi-axes [m], the longest first. SphericityKind::surface needs
/// two equal ones (the surface of a general ellipsoid has no closed form); InputError otherwise.
double sphericity(const Vec3& semi_axes, SphericityKind kind);

/// Semi-axes [m], the longest first, of the spheroid with the volume of a sphere of this diameter [m] and
/// this sphericity [1]. Errors: InputError if the diameter is not positive or the sphericity outside [0.3,
/// 1].
Vec3 spheroid_semi_axes(double diameter, double sphericity, SphericityKind, SpheroidKind);

/// Seeds that differ in size and sphericity: normal distributions, redrawn beyond three standard deviations
/// and where the sphericity leaves [0.3, 1]. The paper's 4.0 +- 0.1 mm is read as mean and standard
/// deviation; it prints no spread of the sphericity, so that is 0 unless given.
struct SeedPopulation {
  double diameter = 4e-3;            ///< mean of the volume-equivalent diameter [m]
  double diameter_deviation = 1e-4;  ///< standard deviation [m]
  double sphericity = 0.976;         ///< mean before redrawing [1]
  double sphericity_deviation = 0;   ///< standard deviation [1]
  SphericityKind sphericity_kind = SphericityKind::axes;
  SpheroidKind spheroid_kind = SpheroidKind::prolate;
  std::uint64_t random_number = 1;

  /// Semi-axes [m] of seed k. Seeds are independent of each other: seed k does not depend on which were drawn
  /// before.
  Vec3 semi_axes(std::uint64_t k) const;
};

}  // namespace seedflow
