#pragma once

#include <string>
#include <vector>

namespace seedflow {

/// The marks of an axis: round numbers (1, 2 or 5 times a power of ten; powers of ten on a logarithmic axis,
/// with 2 and 5 between them where there is room) and the bounds of the axis.
struct Ticks {
  double low = 0, high = 1;
  std::vector<double> values;       ///< inside [low, high], ascending
  std::vector<std::string> labels;  ///< one per value, all with the same number of decimals
  std::vector<double> minor;        ///< unlabelled marks of a logarithmic axis
};

/// About `wanted` marks for data from `low` to `high`. A bound that is not fixed is moved outwards to a mark.
/// An empty interval is widened about its value. Errors: RunError if a bound is not finite.
Ticks linear_ticks(double low, double high, int wanted, bool fix_low = false, bool fix_high = false);
/// The same for a logarithmic axis. Errors: RunError if low <= 0.
Ticks logarithmic_ticks(double low, double high, int wanted, bool fix_low = false, bool fix_high = false);

}  // namespace seedflow
