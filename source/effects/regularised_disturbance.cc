#include "seedflow/effects/regularised_disturbance.h"

#include <array>
#include <cmath>
#include <string>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

const double sqrt_pi = std::sqrt(M_PI);
const double mobility_scale = std::sqrt(M_PI / 2) / (2 * M_PI * M_PI);

/// exp(x^2) erfc(x), x >= 0.
double scaled_erfc(double x) {
  if (x < 5) return std::exp(x * x) * std::erfc(x);
  // Continued fraction 1/sqrt(pi) / (x + (1/2)/(x + (2/2)/(x + (3/2)/...))); the farther out, the fewer
  // terms.
  double fraction = x;
  for (int n = static_cast<int>(200 / (x * x)) + 8; n >= 1; --n) fraction = x + 0.5 * n / fraction;
  return 1 / (sqrt_pi * fraction);
}

/// Transverse part of a Gaussian of that variance, at distance r: along r and across [1/m3].
struct TransverseGaussian {
  double along, across;
  TransverseGaussian(double distance, double variance) {
    const double x = distance / std::sqrt(2 * variance);
    const double peak = std::pow(2 * M_PI * variance, -1.5);
    // g = (erf x - 2/sqrt(pi) x exp(-x^2))/(4 pi r^3), by its series where the difference cancels
    const double x2 = x * x;
    const double ratio = x < 0.3
                             ? 1 - x2 * (3.0 / 5 - x2 * (3.0 / 14 - x2 * (1.0 / 18 - x2 / 88)))
                             : 0.75 * sqrt_pi * (std::erf(x) - 2 / sqrt_pi * x * std::exp(-x2)) / (x2 * x);
    const double g = peak / 3 * ratio;
    along = 2 * g;
    across = peak * std::exp(-x2) - g;
  }
};

constexpr std::array<double, 3> gauss_position = {0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> gauss_weight = {5.0 / 18, 8.0 / 18, 5.0 / 18};

}  // namespace

double effective_width(double spread, double average) {
  return std::hypot(spread, average);
}

SelfMobility steady_self_mobility(double reynolds) {
  const double x = reynolds / std::sqrt(2.0);
  double s = 0, h = 0;
  if (x < 0.5) {
    // erfc(x) exp(x^2) = sum (-x)^n / Gamma(n/2 + 1), inserted term by term; at x = 0.5 the 23rd term is
    // below 1e-16.
    static const auto inverse_gamma = [] {
      std::array<double, 24> list;
      for (int m = 0; m < 24; ++m) list[m] = 1 / std::tgamma(0.5 * m + 1.5);
      return list;
    }();
    for (int m = 21; m >= 0; --m) {
      s = inverse_gamma[m + 2] - x * s;
      h = inverse_gamma[m] - x * h;
    }
    s *= 0.5 * sqrt_pi, h *= 0.5 * sqrt_pi;
  } else {
    h = 0.5 * sqrt_pi * (1 - scaled_erfc(x)) / x;
    s = 0.5 * sqrt_pi / x - (1 - h) / (x * x);
  }
  return {mobility_scale * s, mobility_scale * (h - 0.5 * s)};
}

SelfMobility startup_self_mobility(double reynolds, double diffusion_time) {
  // Time in units of s^2/nu, lengths in s: M = integral of T(r = reynolds t, variance 1 + 2 t). The kernel
  // changes over the shorter of the times of diffusion and of passing, t0, and later in proportion to its
  // age: t = t0 (e^y - 1).
  const double t0 = std::min(1.0, 1 / reynolds), end = std::log1p(diffusion_time / t0);
  const int n = static_cast<int>(std::ceil(8 * end)) + 1;
  SelfMobility sum;
  for (int i = 0; i < n; ++i)
    for (int q = 0; q < 3; ++q) {
      const double y = (i + gauss_position[q]) * end / n, time = t0 * std::expm1(y);
      const TransverseGaussian t(reynolds * time, 1 + 2 * time);
      const double weight = gauss_weight[q] * end / n * t0 * std::exp(y);
      sum.along += weight * t.along;
      sum.across += weight * t.across;
    }
  return sum;
}

Vec3 steady_self_velocity(const Vec3& force, const Vec3& slip, double width, const CarrierFluid& fluid) {
  const double speed = norm(slip);
  const SelfMobility m = steady_self_mobility(width * speed * fluid.density / fluid.viscosity);
  const Vec3 along = speed > 0 ? (dot(force, slip) / (speed * speed)) * slip : Vec3();
  return (m.along * along + m.across * (force - along)) / (fluid.viscosity * width);
}

Vec3 impulse_self_velocity(const Vec3& impulse, const Vec3& displacement, double age, double width,
                           const CarrierFluid& fluid) {
  const double distance = norm(displacement);
  const TransverseGaussian t(distance, width * width + 2 * fluid.viscosity / fluid.density * age);
  const Vec3 along =
      distance > 0 ? (dot(impulse, displacement) / (distance * distance)) * displacement : Vec3();
  return (t.along * along + t.across * (impulse - along)) / fluid.density;
}

void TransientSelfVelocity::append(double time, const Vec3& force, const Vec3& path) {
  // The running impulse is recorded: thinning then keeps the impulse of every interval exactly.
  std::array<double, 6> sample = {0, 0, 0, path.x, path.y, path.z};
  if (!record.empty()) {
    const int last = record.size() - 1;
    const double step = time - record.time(last);
    if (!(step > 0))
      throw RunError("Self-induced velocity: the time " + std::to_string(time) + " s does not come after " +
                     std::to_string(record.time(last)) + " s. Remedy: one call per step.");
    for (int c = 0; c < 3; ++c) sample[c] = record.values(last)[c] + step * force[c];
  }
  record.append(time, sample.data(), resolution);
}

Vec3 TransientSelfVelocity::velocity(double width, const CarrierFluid& fluid) const {
  const int n = record.size();
  if (n < 2) return {};
  const auto part = [&](int i, int at) {
    const double* v = record.values(i) + at;
    return Vec3{v[0], v[1], v[2]};
  };
  const double now = record.time(n - 1);
  const Vec3 here = part(n - 1, 3);
  Vec3 sum;
  for (int i = 0; i + 1 < n; ++i) {
    const Vec3 impulse = part(i + 1, 0) - part(i, 0), from = part(i, 3), moved = part(i + 1, 3) - from;
    const double begin = record.time(i), step = record.time(i + 1) - begin;
    for (int q = 0; q < 3; ++q)
      sum += impulse_self_velocity(gauss_weight[q] * impulse, here - from - gauss_position[q] * moved,
                                   now - begin - gauss_position[q] * step, width, fluid);
  }
  return sum;
}

double self_solid_fraction(double volume, double width) {
  return volume * std::pow(2 * M_PI * width * width, -1.5);
}

Vec3 displacement_self_velocity(const Vec3& slip, double volume, double width) {
  return (self_solid_fraction(volume, width) / 3) * slip;
}

Vec3 undisturbed_slip(const Vec3& measured, const std::function<double(double)>& exchange, double volume,
                      double width, const CarrierFluid& fluid) {
  const double target = norm(measured);
  if (target == 0) return {};
  const double displaced = 1 + self_solid_fraction(volume, width) / 3;
  const auto seen = [&](double w) {
    const double mobility = steady_self_mobility(width * w * fluid.density / fluid.viscosity).along;
    return w * (displaced - exchange(w) * mobility / (fluid.viscosity * width));
  };
  // A body at rest in its own flow needs drag slower than the fluid's answer, else any slip would grow.
  const double creeping = exchange(0) * steady_self_mobility(0).along / (fluid.viscosity * width);
  const auto no_answer = [&] {
    return RunError("Undisturbed velocity: no slip gives the measured " + std::to_string(target) +
                    " m/s with a force spread over " + std::to_string(width) +
                    " m. Remedy: a wider kernel (effective width above 0.4 diameters of the body).");
  };
  if (creeping >= displaced) throw no_answer();
  double low = 0, high = target / displaced;
  while (seen(high) < target) {
    low = high, high *= 2;
    if (high > 1e6 * target) throw no_answer();
  }
  // False position; the value at an end that stays for a second time is halved (Illinois), so both ends close
  // in.
  double below = seen(low) - target, above = seen(high) - target, slip = high;
  int side = 0;
  for (int i = 0; i < 100 && above > 0; ++i) {
    slip = high - above * (high - low) / (above - below);
    const double excess = seen(slip) - target;
    if (std::abs(excess) <= 1e-14 * target || high - low <= 1e-15 * high) break;
    if (excess < 0) {
      low = slip, below = excess;
      if (side < 0) above *= 0.5;
      side = -1;
    } else {
      high = slip, above = excess;
      if (side > 0) below *= 0.5;
      side = 1;
    }
  }
  return (slip / target) * measured;
}

}  // namespace seedflow
