#include "seedflow/effects/history_kernel.h"

#include <array>
#include <cmath>

namespace seedflow {
namespace {

struct GaussPoint {
  double position, weight;  // on [0, 1]
};
constexpr std::array<GaussPoint, 4> gauss_4 = {{{0.06943184420297371, 0.17392742256872693},
                                                {0.33000947820757187, 0.32607257743127307},
                                                {0.66999052179242813, 0.32607257743127307},
                                                {0.93056815579702629, 0.17392742256872693}}};
constexpr std::array<GaussPoint, 2> gauss_2 = {{{0.21132486540518712, 0.5}, {0.78867513459481288, 0.5}}};

/// (1 + kappa y^(3/c))^-c with y = sqrt(age): what is left of the kernel once s^-1/2 is in the variable of
/// integration.
double decay(const HistoryKernel& k, double y) {
  if (k.exponent == 2) {
    const double x = 1 + k.kappa * y * std::sqrt(y);
    return 1 / (x * x);
  }
  const double x = 1 + k.kappa * std::pow(y, 3 / k.exponent);
  return k.exponent == 2.5 ? 1 / (x * x * std::sqrt(x)) : std::pow(x, -k.exponent);
}

}  // namespace

double HistoryKernel::value(double age) const {
  return decay(*this, std::sqrt(age)) / std::sqrt(age);
}

double HistoryKernel::integral(double a, double b) const {
  const double low = std::sqrt(a), high = std::sqrt(b);
  const double length = b > 0 ? (b - a) / (high + low) : 0;  // high - low without cancellation
  if (kappa == 0) return 2 * length;
  if (a > 0.85 * b) return 2 * length * decay(*this, low + 0.5 * length);
  double sum = 0;
  if (a > 0.5 * b)
    for (const auto& p : gauss_2) sum += p.weight * decay(*this, low + p.position * length);
  else
    for (const auto& p : gauss_4) sum += p.weight * decay(*this, low + p.position * length);
  return 2 * length * sum;
}

double HistoryKernel::step_mean(double a, double b, double step) const {
  // The error of a rule in s adds up over all bins to that of the nearest: few points only where s is short
  // against a.
  if (a > 64 * step) return integral(a + 0.5 * step, b + 0.5 * step);
  if (a > 4 * step) {
    double mean = 0;
    for (const auto& p : gauss_2) mean += p.weight * integral(a + p.position * step, b + p.position * step);
    return mean;
  }
  // With s = step y^2 the root at a = 0 becomes a polynomial.
  double sum = 0;
  for (const auto& p : gauss_4) {
    const double s = step * p.position * p.position;
    sum += p.weight * 2 * p.position * integral(a + s, b + s);
  }
  return sum;
}

double HistoryKernel::newest(double step) const {
  double sum = 0;
  for (const auto& p : gauss_4)
    sum += p.weight * 2 * p.position * integral(0, step * p.position * p.position);
  return sum;
}

HistoryKernel finite_reynolds_kernel(double diameter, double nu, double slip_speed, double exponent,
                                     double c2) {
  const double radius = 0.5 * diameter, f_h = 0.75 + c2 * diameter * slip_speed / nu;
  const double diffusion = M_PI * nu / (radius * radius);
  const double convection = 0.5 * M_PI * std::pow(slip_speed / f_h, 3) / (radius * nu);
  return {exponent, std::pow(convection / std::sqrt(diffusion), 1 / exponent)};
}

Vec3 history_integral(const HistoryKernel& kernel, const ThinnedHistory& slip, double step, bool impulsive) {
  const int n = slip.size();
  const double now = slip.time(n - 1);
  const auto value = [&](int i) { return Vec3{slip.values(i)[0], slip.values(i)[1], slip.values(i)[2]}; };
  Vec3 sum;
  for (int i = 0; i + 1 < n; ++i) {
    const double from = slip.time(i), to = slip.time(i + 1);
    const Vec3 change = value(i + 1) - value(i);
    sum += (kernel.step_mean(now - to, now - from, step) / (to - from)) * change;
  }
  if (impulsive) {
    const double age = now - slip.time(0);
    sum += (kernel.integral(age, age + step) / step) * value(0);
  }
  return sum;
}

}  // namespace seedflow
