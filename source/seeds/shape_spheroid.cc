#include "seedflow/seeds/shape_spheroid.h"

#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/seeds/packing_random.h"

namespace seedflow {
namespace {

constexpr double least_sphericity = 0.3;

/// Surface of a spheroid with polar semi-axis p and equatorial semi-axis q. Both classical forms,
/// 2 pi q^2 (1 + (p/q) asin(e)/e) and 2 pi q^2 (1 + (p/q)^2 atanh(e)/e), tend to the sphere's as e -> 0.
double spheroid_surface(double p, double q) {
  const double ratio = p / q;
  const double e = std::sqrt(std::abs(ratio > 1 ? 1 - 1 / (ratio * ratio) : 1 - ratio * ratio));
  double side = ratio;
  if (e > 1e-8) side = ratio > 1 ? ratio * std::asin(e) / e : ratio * ratio * std::atanh(e) / e;
  return 2 * M_PI * q * q * (1 + side);
}

Vec3 from_aspect(double diameter, double aspect, SpheroidKind kind) {
  const double mean = 0.5 * diameter;  // cube root of a b c
  if (kind == SpheroidKind::prolate) {
    const double b = mean / std::cbrt(aspect);
    return {aspect * b, b, b};
  }
  const double a = mean * std::cbrt(aspect);
  return {a, a, a / aspect};
}

double draw(PortableRandom& random, double mean, double deviation, double low, double high) {
  for (;;) {
    const double z = random.normal(), value = mean + deviation * z;
    if (std::abs(z) <= 3 && value >= low && value <= high) return value;
  }
}

}  // namespace

double sphericity(const Vec3& a, SphericityKind kind) {
  const double mean = std::cbrt(a.x * a.y * a.z);
  if (kind == SphericityKind::axes) return mean / a.x;
  if (a.x != a.y && a.y != a.z)
    throw InputError(
        "Sphericity by surface: two semi-axes must be equal; use the sphericity by axes instead.");
  const double surface = a.y == a.z ? spheroid_surface(a.x, a.y) : spheroid_surface(a.z, a.x);
  return 4 * M_PI * mean * mean / surface;
}

Vec3 spheroid_semi_axes(double diameter, double target, SphericityKind kind, SpheroidKind spheroid) {
  if (!(diameter > 0) || !std::isfinite(diameter) || !(target >= least_sphericity && target <= 1)) {
    std::ostringstream message;
    message << "Spheroid: diameter " << diameter << " m must be positive and sphericity " << target
            << " within [" << least_sphericity << ", 1].";
    throw InputError(message.str());
  }
  // The sphericity falls steadily with the aspect ratio: bisection on its logarithm, to the last bit.
  double low = 0, high = 8;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (sphericity(from_aspect(diameter, std::exp(middle), spheroid), kind) > target ? low : high) = middle;
  }
  return from_aspect(diameter, target == 1 ? 1.0 : std::exp(0.5 * (low + high)), spheroid);
}

Vec3 SeedPopulation::semi_axes(std::uint64_t k) const {
  if (!(diameter > 3 * diameter_deviation) || diameter_deviation < 0 || sphericity_deviation < 0 ||
      !(sphericity >= least_sphericity && sphericity <= 1)) {
    std::ostringstream message;
    message << "Seed population: mean diameter " << diameter << " m must exceed three standard deviations ("
            << diameter_deviation << " m), the mean sphericity " << sphericity << " must be within ["
            << least_sphericity << ", 1] and no deviation negative.";
    throw InputError(message.str());
  }
  PortableRandom random(random_number, k);
  const double d = draw(random, diameter, diameter_deviation, 0, 2 * diameter);
  const double s = draw(random, sphericity, sphericity_deviation, least_sphericity, 1);
  return spheroid_semi_axes(d, s, sphericity_kind, spheroid_kind);
}

}  // namespace seedflow
