#include "seedflow/seeds/restitution.h"

#include <cmath>

namespace seedflow {

double impact_time(double reduced_radius, double reduced_mass, double young, double speed) {
  const double k = 4.0 / 3 * young * std::sqrt(reduced_radius);
  return std::pow(reduced_mass * reduced_mass / (k * k * speed), 0.2);
}

// Scaled with T and v T the impact is x'' = -x^(3/2) - 3/2 a x^(1/2) x', x(0) = 0, x'(0) = 1. In s = x^(1/2)
// and tau, dt = s dtau, it is smooth at both ends: ds/dtau = u/2, du/dtau = -s^4 - 3/2 a s^2 u.
double viscoelastic_restitution(double a) {
  if (a == 0) return 1;
  const auto slope = [a](double s, double u, double& ds, double& du) {
    ds = 0.5 * u;
    du = -s * s * s * s - 1.5 * a * s * s * u;
  };
  double s = 0, u = 1;
  const double h = 2e-3;
  for (;;) {
    double s1, u1, s2, u2, s3, u3, s4, u4;
    slope(s, u, s1, u1);
    slope(s + 0.5 * h * s1, u + 0.5 * h * u1, s2, u2);
    slope(s + 0.5 * h * s2, u + 0.5 * h * u2, s3, u3);
    slope(s + h * s3, u + h * u3, s4, u4);
    const double ds = h / 6 * (s1 + 2 * s2 + 2 * s3 + s4), du = h / 6 * (u1 + 2 * u2 + 2 * u3 + u4);
    if (s + ds <= 0) return -(u - s / ds * du);
    s += ds, u += du;
  }
}

double dissipation_of(double restitution) {
  if (restitution == 1) return 0;
  double low = 0, high = 1;
  while (viscoelastic_restitution(high) > restitution) high *= 2;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (viscoelastic_restitution(middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace seedflow
