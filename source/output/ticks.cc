#include "seedflow/output/ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "seedflow/base/error.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

/// Tells a mark that lies on a bound from one beside it in spite of round-off.
constexpr double slack = 1e-9;

double round_step(double raw) {
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power * (1 + slack)) return factor * power;
  return 10 * power;
}

/// k * step without the round-off of 3 * 0.1.
double multiple(double k, double step) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", k * step);
  return std::stod(text);
}

std::vector<std::string> label_all(const std::vector<double>& values, double step) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  std::vector<std::string> labels;
  const bool plain = largest < 1e5 && step >= 0.99e-4;
  for (const double v : values) {
    if (!plain) {
      const int digits =
          1 + static_cast<int>(std::floor(std::log10(largest)) - std::floor(std::log10(step) + slack));
      labels.push_back(printed_number(v, v == 0 ? 1 : std::clamp(digits, 1, 15)));
      continue;
    }
    char text[40];
    std::snprintf(text, sizeof text, "%.*f",
                  std::max(0, static_cast<int>(-std::floor(std::log10(step) + slack))), v == 0 ? 0.0 : v);
    labels.push_back(text[0] == '-' ? "−" + std::string(text + 1) : text);
  }
  return labels;
}

void require_finite(double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high))
    throw RunError("An axis cannot run from " + std::to_string(low) + " to " + std::to_string(high) + ".");
}

}  // namespace

Ticks linear_ticks(double low, double high, int wanted, bool fix_low, bool fix_high) {
  require_finite(low, high);
  if (high < low) std::swap(low, high);
  // Steps below the resolution of doubles would repeat the same mark.
  if (high - low <= 1e-10 * std::max(std::abs(low), std::abs(high)) || high == low) {
    const double margin = low == 0 ? 1 : 0.1 * std::abs(low);
    low -= margin, high += margin;
    fix_low = fix_high = false;
  }
  const double step = round_step((high - low) / std::max(1, wanted));
  Ticks ticks;
  ticks.low = fix_low ? low : multiple(std::floor(low / step + slack), step);
  ticks.high = fix_high ? high : multiple(std::ceil(high / step - slack), step);
  for (double k = std::ceil(ticks.low / step - slack); k * step <= ticks.high + slack * step; ++k)
    ticks.values.push_back(multiple(k, step));
  ticks.labels = label_all(ticks.values, step);
  return ticks;
}

Ticks logarithmic_ticks(double low, double high, int wanted, bool fix_low, bool fix_high) {
  require_finite(low, high);
  if (high < low) std::swap(low, high);
  if (low <= 0)
    throw RunError("A logarithmic axis cannot show " + printed_number(low) + ": only values above zero.");
  if (high <= low * (1 + 1e-10)) low /= 2, high *= 2;
  Ticks ticks;
  const double decades = std::log10(high / low);
  const auto first = static_cast<int>(std::floor(std::log10(low) + slack));
  const auto last = static_cast<int>(std::ceil(std::log10(high) - slack));
  const auto value = [](int exponent, int factor) {
    return std::stod(std::to_string(factor) + "e" + std::to_string(exponent));
  };

  // 1, 2, 5 per decade over less than about two decades, otherwise every n-th power of ten.
  const bool fine = decades < 0.45 * wanted;
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / std::max(1, wanted) - slack)));
  std::vector<double> candidates;
  for (int e = first; e <= last; ++e)
    for (const int factor : {1, 2, 5})
      if (fine ? true : factor == 1 && (e - first) % stride == 0) candidates.push_back(value(e, factor));
  ticks.low = low, ticks.high = high;
  if (!fix_low)
    for (const double c : candidates)
      if (c <= low * (1 + slack)) ticks.low = c;
  if (!fix_high) {
    candidates.push_back(value(last + 1, 1));
    for (auto c = candidates.rbegin(); c != candidates.rend(); ++c)
      if (*c >= high * (1 - slack)) ticks.high = *c;
  }
  for (const double c : candidates)
    if (c >= ticks.low * (1 - slack) && c <= ticks.high * (1 + slack)) ticks.values.push_back(c);
  // Either plain numbers everywhere or powers of ten everywhere.
  const bool plain = ticks.low >= 0.99e-4 && ticks.high < 1.01e5;
  for (const double v : ticks.values)
    ticks.labels.push_back(plain ? printed_number(v, 1) : printed_power(v, 1));
  for (int e = first - 1; e <= last + 1; ++e)
    for (int factor = 1; factor < 10; ++factor) {
      const double v = value(e, factor);
      const bool labelled = std::find(ticks.values.begin(), ticks.values.end(), v) != ticks.values.end();
      if (!labelled && (stride == 1 || factor == 1) && v > ticks.low && v < ticks.high)
        ticks.minor.push_back(v);
    }
  return ticks;
}

}  // namespace seedflow
