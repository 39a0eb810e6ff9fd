#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace seedflow {

/// An axis of a plot. Bounds left open follow the data, extended to round numbers.
struct Axis {
  std::string title;
  std::string unit = "1";  ///< shown in brackets behind the title unless "1"
  bool logarithmic = false;
  std::optional<double> low = std::nullopt, high = std::nullopt;
};

/// A straight line across the plot with a label beside it: a published value, a limit, an event.
struct ReferenceLine {
  double value = 0;
  std::string label;
};

/// One curve or set of points. NaN in y is a missing value: the line has a gap there, and the plot says how
/// many values are missing. Errors (of svg()): RunError for infinite values, different lengths, or values <=
/// 0 on a logarithmic axis.
struct LineSeries {
  enum class Draw { line, markers, both };

  std::string label;
  std::vector<double> x, y;
  Draw draw = Draw::line;
  std::vector<double> error = {};                     ///< half lengths of vertical error bars, or empty
  std::vector<double> band_low = {}, band_high = {};  ///< a shaded band (confidence, scatter), or empty
  std::optional<int> style = std::nullopt;  ///< colour, dash and marker; default: its number in the plot
};

/// A line plot as SVG: several series told apart by colour (colour-blind-safe), dash and marker; the legend
/// stands above the axes and the labels of reference lines in the margin, so neither covers data.
struct LinePlot {
  std::string title;
  Axis x, y;
  std::vector<LineSeries> series = {};
  std::vector<ReferenceLine> horizontal = {};  ///< at values of y
  std::vector<ReferenceLine> vertical = {};    ///< at values of x
  std::string caption = "";

  std::string svg() const;
};

/// One set of bars: a value for every group.
struct BarSeries {
  std::string label;
  std::vector<double> values;      ///< one per group; NaN: no bar, "n/a" is written in its place
  std::vector<double> error = {};  ///< half lengths of error bars, or empty
};

/// Bars side by side in groups, from zero (from the lower bound on a logarithmic axis).
struct BarPlot {
  std::string title;
  std::vector<std::string> groups;
  Axis y;
  std::vector<BarSeries> series = {};
  std::vector<ReferenceLine> horizontal = {};
  bool show_values = true;  ///< write each value above its bar where it fits
  std::string caption = "";

  std::string svg() const;
};

/// A field of nx * ny equal cells in colour, with a colour bar.
struct HeatMap {
  std::string title;
  Axis x, y;    ///< low and high are the edges of the field and must be given
  Axis colour;  ///< what the values are; bounds default to their extremes
  int nx = 0, ny = 0;
  std::vector<double> values =
      {};                    ///< values[j * nx + i], i along x from low to high, j along y; NaN: left grey
  bool equal_scale = false;  ///< one unit of x as long as one of y (maps of space)
  std::string caption = "";

  std::string svg() const;
};

}  // namespace seedflow
