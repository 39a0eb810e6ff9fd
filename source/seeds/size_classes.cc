// Seeds of different diameters as classes of templates.

#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/seeds/feeder_parameters.h"

namespace seedflow {
namespace {

double density(double z) {
  return std::isinf(z) ? 0 : std::exp(-0.5 * z * z) / std::sqrt(2 * M_PI);
}

// The z below which the part p of the normal distribution lies, by bisection of erfc.
double quantile(double p) {
  if (p <= 0) return -INFINITY;
  if (p >= 1) return INFINITY;
  double low = -10, high = 10;
  while (high - low > 1e-14) {
    const double z = 0.5 * (low + high);
    (0.5 * std::erfc(-z / std::sqrt(2.0)) < p ? low : high) = z;
    if (z == low && z == high) break;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<double> size_classes(double deviation, int n) {
  if (!(deviation >= 0) || n < 1)
    throw InputError("A distribution of diameters needs a deviation of at least 0 and at least one class.");
  std::vector<double> diameter;
  // The mean of z between two quantiles a and b is (density(a) - density(b)) / probability.
  for (int i = 0; i < n; ++i) {
    const double a = quantile(static_cast<double>(i) / n), b = quantile(static_cast<double>(i + 1) / n);
    diameter.push_back(1 + deviation * n * (density(a) - density(b)));
  }
  if (!(diameter.front() > 0))
    throw InputError("The deviation of the diameters is " + std::to_string(100 * deviation) +
                     " % of the mean: the smallest seeds would have no size. Make it smaller.");
  return diameter;
}

SeedTemplate scaled(const SeedTemplate& model, double factor) {
  SeedTemplate t = model;
  for (Vec3& x : t.position) x *= factor;
  for (double& r : t.radius) r *= factor;
  for (Bond& b : t.bond) b.radius *= factor;
  t.seed_volume *= factor * factor * factor;
  t.seed_semi_axes *= factor;
  t.seed_centre *= factor;
  t.finish();
  return t;
}

}  // namespace seedflow
