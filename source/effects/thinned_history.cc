#include "seedflow/effects/thinned_history.h"

#include <algorithm>

namespace seedflow {

void ThinnedHistory::append(double now, const double* values, double resolution) {
  numbers.push_back(now);
  numbers.insert(numbers.end(), values, values + width);

  // From old to new: a sample goes if the interval that closes over it is short against its age. The oldest
  // and the newest sample stay, and the sample before a dropped one is the last that was kept.
  const int n = size(), stride = width + 1;
  int kept = 1;
  for (int i = 1; i < n; ++i) {
    const bool newest = i + 1 == n;
    if (!newest && (time(i + 1) - time(kept - 1)) * resolution <= now - time(i + 1)) continue;
    if (kept != i)
      std::copy_n(numbers.begin() + first + i * stride, stride, numbers.begin() + first + kept * stride);
    ++kept;
  }
  numbers.resize(first + kept * stride);
}

}  // namespace seedflow
