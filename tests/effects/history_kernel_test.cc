#include "seedflow/effects/history_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seedflow {
namespace {

/// Kernels of a 0.8 mm sphere in water at 0.3 m/s (Re 267), and Basset's.
std::vector<HistoryKernel> kernels() {
  return {HistoryKernel(), finite_reynolds_kernel(8e-4, 0.9e-6, 0.3, 2, 0.105),
          finite_reynolds_kernel(8e-4, 0.9e-6, 0.3, 2.5, 0.2)};
}

TEST(HistoryKernel, PublishedFormAndLimits) {
  // Mei & Adrian as printed, with R = d/2, against the form in which the code holds it.
  const double d = 8e-4, r = d / 2, nu = 0.9e-6, u = 0.3, re = d * u / nu;
  for (const auto& [c, c2] : {std::pair{2.0, 0.105}, std::pair{2.5, 0.2}})
    for (const double t : {1e-8, 1e-4, 1e-2, 1.0}) {
      const double f = 0.75 + c2 * re;
      const double printed =
          std::pow(std::pow(M_PI * nu * t / (r * r), 0.5 / c) +
                       std::pow(M_PI / 2 * u * u * u * t * t / (r * nu * f * f * f), 1 / c),
                   -c);
      const double ours = std::sqrt(r * r / (M_PI * nu)) * finite_reynolds_kernel(d, nu, u, c, c2).value(t);
      EXPECT_NEAR(ours, printed, 1e-12 * printed);
    }
  for (const auto& kernel : kernels()) EXPECT_NEAR(kernel.value(1e-16) * 1e-8, 1, 1e-3);  // Basset at once
  for (int i = 1; i < 3; ++i)  // s^-2 once the vorticity has been swept away
    EXPECT_NEAR(std::log10(kernels()[i].value(1e6) / kernels()[i].value(1e7)), 2, 1e-2);
  // No slip, no sweeping: Basset.
  EXPECT_DOUBLE_EQ(finite_reynolds_kernel(d, nu, 0, 2, 0.105).value(0.1), HistoryKernel().value(0.1));
}

TEST(HistoryKernel, IntegralsAgainstFineSums) {
  for (const auto& kernel : kernels())
    for (const auto& [a, b] : {std::pair{0.0, 1e-4}, std::pair{1e-4, 2e-4}, std::pair{1e-2, 1.05e-2}}) {
      double sum = 0;
      const int n = 20000;
      for (int i = 0; i < n; ++i) {  // in y = sqrt(s)
        const double low = std::sqrt(a), high = std::sqrt(b), y = low + (high - low) * (i + 0.5) / n;
        sum += 2 * y * kernel.value(y * y) * (high - low) / n;
      }
      EXPECT_NEAR(kernel.integral(a, b), sum, 2e-4 * sum) << a;  // four, two and one point
    }
  // Basset: mean over a step of 2 sqrt(s) is 4/3 sqrt(step), of 2 sqrt(h + s) - 2 sqrt(s) by hand.
  const double h = 1e-3;
  EXPECT_NEAR(HistoryKernel().newest(h), 4.0 / 3 * std::sqrt(h), 1e-15);
  for (const int k : {0, 1, 6, 100}) {
    const auto cube = [&](double n) { return std::pow(n, 1.5); };
    const double exact = 4.0 / 3 * std::sqrt(h) * (cube(k + 2) - 2 * cube(k + 1) + cube(k));
    EXPECT_NEAR(HistoryKernel().step_mean(k * h, (k + 1) * h, h), exact, 1e-4 * exact) << k;
  }
}

TEST(ThinnedHistory, KeepsTheRecentAndThinsTheOld) {
  std::vector<double> numbers = {42.0};  // belongs to someone else
  ThinnedHistory record(numbers, 1, 1);
  const double resolution = 10;
  for (int i = 0; i <= 10000; ++i) {
    const double value = 3.0 * i;
    record.append(i, &value, resolution);
  }
  EXPECT_EQ(numbers[0], 42.0);
  EXPECT_EQ(record.time(0), 0);
  EXPECT_EQ(record.time(record.size() - 1), 10000);
  EXPECT_LT(record.size(), 2 * resolution * (1 + std::log(10000 / resolution)));
  for (int i = 0; i + 1 < record.size(); ++i) {
    EXPECT_EQ(record.values(i)[0], 3 * record.time(i));  // samples stay as they were
    EXPECT_LE(record.time(i + 1) - record.time(i), std::max(1.0, (10000 - record.time(i + 1)) / resolution));
  }
  EXPECT_EQ(record.time(record.size() - 11), 9990);  // ten steps back every sample is there
}

}  // namespace
}  // namespace seedflow
