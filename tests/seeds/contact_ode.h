#pragma once

#include <array>
#include <cmath>

#include "seedflow/seeds/material.h"

namespace seedflow::test {

/// A pair of bodies as the textbook formulas need it, written out independently of the product's law.
struct Pair {
  double young, shear, radius, mass;  ///< E*, G*, R*, m*

  static Pair spheres(const Material& a, const Material& b, double ra, double rb, double ma, double mb) {
    const auto e = [](const Material& m) { return 2 * (1 + m.poisson_ratio) * m.shear_modulus; };
    const double nu_a = a.poisson_ratio, nu_b = b.poisson_ratio;
    return {1 / ((1 - nu_a * nu_a) / e(a) + (1 - nu_b * nu_b) / e(b)),
            1 / ((2 - nu_a) / a.shear_modulus + (2 - nu_b) / b.shear_modulus), 1 / (1 / ra + 1 / rb),
            1 / (1 / ma + 1 / mb)};
  }
};

inline double damping_ratio(double restitution) {
  const double l = std::log(restitution);
  return -l / std::sqrt(l * l + M_PI * M_PI);
}

/// One step of the classical Runge-Kutta method for y' = f(y).
template <std::size_t n, class F>
void runge_kutta(std::array<double, n>& y, double h, const F& f) {
  const auto at = [&](const std::array<double, n>& k, double part) {
    std::array<double, n> z = y;
    for (std::size_t i = 0; i < n; ++i) z[i] += part * h * k[i];
    return z;
  };
  const auto k1 = f(y), k2 = f(at(k1, 0.5)), k3 = f(at(k2, 0.5)), k4 = f(at(k3, 1));
  for (std::size_t i = 0; i < n; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
}

struct HeadOn {
  double rebound = 0, time = 0, depth = 0;
};

/// Head-on collision: m* x'' = -4/3 E* sqrt(R*) x^(3/2) - beta sqrt(5 m* 4/3 E* sqrt(R* x)) x', from x = 0 to
/// x = 0, in `steps` steps over about one contact.
inline HeadOn head_on(const Pair& p, double restitution, double speed, int steps = 20000) {
  const double k = 4.0 / 3 * p.young * std::sqrt(p.radius), beta = damping_ratio(restitution);
  const double h = 3.3 * std::pow(p.mass * p.mass / (k * k * speed), 0.2) / steps;
  std::array<double, 2> y{0, speed};
  HeadOn result;
  const auto f = [&](const std::array<double, 2>& z) {
    const double x = std::max(z[0], 0.0), root = std::sqrt(x);
    return std::array<double, 2>{z[1],
                                 -(k * x * root + beta * std::sqrt(5 * p.mass * k * root) * z[1]) / p.mass};
  };
  for (;;) {
    const auto before = y;
    runge_kutta(y, h, f);
    result.depth = std::max(result.depth, y[0]);
    if (y[0] <= 0) {
      const double part = before[0] / (before[0] - y[0]);
      result.rebound = -(before[1] + part * (y[1] - before[1]));
      result.time += part * h;
      return result;
    }
    result.time += h;
  }
}

}  // namespace seedflow::test
