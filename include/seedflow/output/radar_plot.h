#pragma once

#include <string>
#include <vector>

namespace seedflow {

/// One closed curve of a radar plot: a value for every spoke.
struct RadarSeries {
  std::string label;
  std::vector<double> values;  ///< >= 0
};

/// Values against something that goes around, such as the times of a cycle: spokes begin at the top and go
/// clockwise, the distance from the centre is the value, linear from zero.
struct RadarPlot {
  std::string title;
  std::vector<std::string> spokes;  ///< labels, at least three
  std::string unit = "1";
  std::vector<RadarSeries> series = {};
  double size = 420;  ///< [px]

  /// Errors: RunError for less than three spokes, or values that are missing, negative or not finite.
  std::string svg() const;
};

}  // namespace seedflow
