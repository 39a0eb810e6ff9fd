#include "seedflow/output/ticks.h"

#include <cmath>
#include <limits>
#include <set>

#include "testing.h"

namespace seedflow {
namespace {

using Values = std::vector<double>;
using Labels = std::vector<std::string>;

TEST(Ticks, AreTheRoundNumbersOneWouldChoose) {
  const Ticks a = linear_ticks(0.003, 0.118, 6);
  EXPECT_EQ(a.values, (Values{0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.12}));
  EXPECT_EQ(a.labels, (Labels{"0.00", "0.02", "0.04", "0.06", "0.08", "0.10", "0.12"}));
  EXPECT_EQ(a.low, 0);
  EXPECT_EQ(a.high, 0.12);
  const Ticks b = linear_ticks(-7, 12, 5);
  EXPECT_EQ(b.labels, (Labels{"−10", "−5", "0", "5", "10", "15"}));
  const Ticks c = linear_ticks(0, 3e7, 3);
  EXPECT_EQ(c.labels, (Labels{"0", "10⁷", "2 × 10⁷", "3 × 10⁷"}));
  const Ticks d = linear_ticks(1000.1, 1000.3, 2);
  EXPECT_EQ(d.labels, (Labels{"1000.1", "1000.2", "1000.3"}));
}

TEST(Ticks, CoverTheDataWithAboutTheWantedNumberAndDistinctLabels) {
  for (double low : {-3.7e5, -1.0, 0.0, 1e-9, 0.5, 123.456})
    for (double width : {3e-8, 0.0017, 1.0, 9.99, 4.4e6})
      for (int wanted : {2, 5, 8}) {
        if (width < 1e-9 * std::abs(low)) continue;
        const Ticks t = linear_ticks(low, low + width, wanted);
        EXPECT_LE(t.low, low + 1e-6 * width);
        EXPECT_GE(t.high, low + width * (1 - 1e-6));
        EXPECT_GE(t.values.size(), 2u);
        EXPECT_LE(static_cast<int>(t.values.size()), wanted + 2);
        EXPECT_EQ(std::set<std::string>(t.labels.begin(), t.labels.end()).size(), t.labels.size())
            << low << " " << width << " " << t.labels[0];
        // Evenly spaced by 1, 2 or 5 times a power of ten.
        const double step = t.values[1] - t.values[0];
        const double digit = step / std::pow(10.0, std::floor(std::log10(step * 1.0001)));
        EXPECT_LT(std::min({std::abs(digit - 1), std::abs(digit - 2), std::abs(digit - 5)}), 1e-3) << step;
      }
}

TEST(Ticks, FixedBoundsStay) {
  const Ticks t = linear_ticks(0.07, 0.33, 5, true, true);
  EXPECT_EQ(t.low, 0.07);
  EXPECT_EQ(t.high, 0.33);
  EXPECT_EQ(t.values, (Values{0.1, 0.2, 0.3}));
}

TEST(Ticks, AnEmptyIntervalIsWidened) {
  for (const double value : {0.0, 5.0, -1e-7}) {
    const Ticks t = linear_ticks(value, value, 5);
    EXPECT_LT(t.low, value);
    EXPECT_GT(t.high, value);
  }
  const Ticks t = logarithmic_ticks(3, 3, 5);
  EXPECT_LT(t.low, 3);
  EXPECT_GT(t.high, 3);
}

TEST(Ticks, LogarithmicOnesArePowersOfTenOrOneTwoFive) {
  const Ticks a = logarithmic_ticks(0.03, 7000, 6);
  EXPECT_EQ(a.values, (Values{0.01, 0.1, 1, 10, 100, 1000, 1e4}));
  EXPECT_EQ(a.labels, (Labels{"0.01", "0.1", "1", "10", "100", "1000", "10000"}));
  EXPECT_FALSE(a.minor.empty());
  const Ticks b = logarithmic_ticks(0.3, 40, 6);
  EXPECT_EQ(b.values, (Values{0.2, 0.5, 1, 2, 5, 10, 20, 50}));
  const Ticks c = logarithmic_ticks(1e-15, 1, 5);
  EXPECT_LE(c.values.size(), 7u);
  EXPECT_LE(c.values.front(), 1e-15 * (1 + 1e-9));
  EXPECT_EQ(c.labels.front(), "10⁻¹⁵");
}

TEST(Ticks, WhatCannotBeDrawnIsAnError) {
  const double nan_value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(linear_ticks(0, nan_value, 5), RunError);
  EXPECT_THROW(linear_ticks(-std::numeric_limits<double>::infinity(), 0, 5), RunError);
  EXPECT_THROW(logarithmic_ticks(0, 1, 5), RunError);
}

}  // namespace
}  // namespace seedflow
