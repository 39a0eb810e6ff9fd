#include "seedflow/experiment/seeding_quality.h"

#include <algorithm>
#include <cmath>

namespace seedflow {

namespace {

SeedingIndices indices(int n, int good, int multiple, int miss) {
  return {n, share_of(good, n), share_of(multiple, n), share_of(miss, n), 0};
}

}  // namespace

Share share_of(int k, int n) {
  if (n == 0) return {};
  constexpr double z = 1.959964;
  const double p = static_cast<double>(k) / n, scale = 1 / (1 + z * z / n);
  const double middle = scale * (p + z * z / (2 * n));
  const double half = scale * z * std::sqrt(p * (1 - p) / n + z * z / (4.0 * n * n));
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

SeedingIndices indices_of_counts(const std::vector<int>& seeds) {
  int miss = 0, good = 0;
  for (const int n : seeds) miss += n == 0, good += n == 1;
  const int n = static_cast<int>(seeds.size());
  return indices(n, good, n - good - miss, miss);
}

SeedingIndices indices_of_spacings(const std::vector<double>& spacing, double target) {
  int multiple = 0, miss = 0;
  std::vector<double> good;
  for (const double s : spacing)
    if (s <= 0.5 * target)
      ++multiple;
    else if (s > 1.5 * target)
      ++miss;
    else
      good.push_back(s);
  SeedingIndices result =
      indices(static_cast<int>(spacing.size()), static_cast<int>(good.size()), multiple, miss);
  if (good.size() > 1) {
    double mean = 0, square = 0;
    for (const double s : good) mean += s / static_cast<double>(good.size());
    for (const double s : good) square += (s - mean) * (s - mean);
    result.precision = std::sqrt(square / static_cast<double>(good.size() - 1)) / target;
  }
  return result;
}

std::vector<double> spacings(std::vector<double> times, double speed) {
  std::sort(times.begin(), times.end());
  std::vector<double> result;
  for (std::size_t i = 1; i < times.size(); ++i) result.push_back(speed * (times[i] - times[i - 1]));
  return result;
}

}  // namespace seedflow
