#pragma once

#include <vector>

namespace seedflow {

/// A record of vectors over time with bounded memory: recent samples are all kept, older ones are thinned so
/// that no interval is longer than 1/resolution of its age (unless it was longer when it was sampled). After
/// n equal steps about 2 resolution (1 + ln(n / resolution)) samples are left, and the error of reading the
/// record as piecewise linear falls like resolution^-2. A kernel of any shape, also one that changes with the
/// state, can be integrated over it.
///
/// A view on plain numbers that someone else owns (so that they can be saved and sent); the class keeps
/// nothing. Layout: samples one after the other, oldest first, each a time [s] and `width` values.
class ThinnedHistory {
 public:
  /// `numbers` from index `first` on belong to the record.
  ThinnedHistory(std::vector<double>& numbers, int first, int width)
      : numbers(numbers), first(first), width(width) {}

  int size() const { return (static_cast<int>(numbers.size()) - first) / (width + 1); }
  bool empty() const { return size() == 0; }
  double time(int i) const { return numbers[first + i * (width + 1)]; }
  const double* values(int i) const { return &numbers[first + i * (width + 1) + 1]; }

  /// Adds a sample later than all others and thins the older ones.
  void append(double time, const double* values, double resolution);

 private:
  std::vector<double>& numbers;
  int first, width;
};

}  // namespace seedflow
