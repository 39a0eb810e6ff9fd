#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "plot_frame.h"
#include "seedflow/base/error.h"

namespace seedflow {

namespace {

/// From dark blue through green to yellow with evenly rising lightness, so that it reads in grey and for
/// colour-blind eyes: samples of the map "viridis" (van der Walt and Smith 2015), linear in between.
std::string colour_of(double fraction) {
  static constexpr std::array<std::array<int, 3>, 9> samples = {{{68, 1, 84},
                                                                 {71, 44, 122},
                                                                 {59, 81, 139},
                                                                 {44, 113, 142},
                                                                 {33, 144, 141},
                                                                 {39, 173, 129},
                                                                 {92, 200, 99},
                                                                 {170, 220, 50},
                                                                 {253, 231, 37}}};
  const double at = std::clamp(fraction, 0.0, 1.0) * (samples.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), samples.size() - 2);
  const double t = at - static_cast<double>(i);
  char text[8];
  const auto channel = [&](int c) {
    return static_cast<int>(std::lround((1 - t) * samples[i][c] + t * samples[i + 1][c]));
  };
  std::snprintf(text, sizeof text, "#%02x%02x%02x", channel(0), channel(1), channel(2));
  return text;
}

constexpr double bar_width = 16, bar_gap = 24;

}  // namespace

std::string HeatMap::svg() const {
  if (nx <= 0 || ny <= 0 || values.size() != static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny))
    throw RunError("The map '" + title + "' cannot be plotted: " + std::to_string(values.size()) +
                   " values for " + std::to_string(nx) + " x " + std::to_string(ny) + " cells.");
  if (!x.low || !x.high || !y.low || !y.high || x.logarithmic || y.logarithmic)
    throw RunError("The map '" + title + "' cannot be plotted: linear axes with both bounds are needed.");
  Extent extent;
  for (const double value : values) {
    if (std::isinf(value) || (colour.logarithmic && value <= 0))
      throw RunError("The map '" + title + "' cannot be plotted: a value is " + printed_number(value) + ".");
    extent.add(value);
  }
  const Ticks scale = axis_ticks(colour, extent, 5);
  double label_width = 0;
  for (const std::string& label : scale.labels) label_width = std::max(label_width, text_width(label, 12));

  PlotFrame::Content content;
  content.title = title;
  content.x = x;
  content.y = y;
  content.x_ticks = axis_ticks(x, {}, equal_scale ? 4 : 8);
  content.y_ticks = axis_ticks(y, {}, 6);
  content.extra_right = bar_gap + bar_width + 10 + label_width + 26;
  if (equal_scale) {
    // The longer side decides; both stay within the page.
    const double ratio = (*x.high - *x.low) / (*y.high - *y.low);
    content.plot_height = std::clamp(560 / std::max(ratio, 1e-9), 60.0, 460.0);
    content.plot_width = std::max(40.0, content.plot_height * ratio);
    content.plot_height = content.plot_width / ratio;
  } else {
    content.plot_height = 320;
  }
  if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
    content.note = "Grey: no value.";

  PlotFrame frame(content);
  Svg& svg = frame.svg();
  const auto fraction = [&](double value) {
    return colour.logarithmic ? std::log(value / scale.low) / std::log(scale.high / scale.low)
                              : (value - scale.low) / (scale.high - scale.low);
  };
  const double w = frame.width / nx, h = frame.height / ny;
  svg.rectangle(frame.left, frame.top, frame.width, frame.height, "#d0d7de");
  for (int j = 0; j < ny; ++j) {
    const double* row = values.data() + static_cast<std::ptrdiff_t>(j) * nx;
    // Neighbours of one colour share a rectangle; a little overlap leaves no seam at any magnification.
    constexpr double seam = 0.5;
    for (int begin = 0, end = 0; begin < nx; begin = end) {
      const auto colour_at = [&](int i) { return std::isnan(row[i]) ? "" : colour_of(fraction(row[i])); };
      const std::string cell_colour = colour_at(begin);
      for (end = begin + 1; end < nx && colour_at(end) == cell_colour;) ++end;
      if (!cell_colour.empty())
        svg.rectangle(frame.left + begin * w, frame.top + frame.height - (j + 1) * h,
                      (end - begin) * w + (end < nx ? seam : 0), h + (j > 0 ? seam : 0), cell_colour);
    }
  }

  Svg::Font small, turned;
  small.size = 12;
  turned.anchor = Svg::Anchor::middle;
  turned.rotation = -90;
  const double bar_left = frame.left + frame.width + bar_gap;
  constexpr int bands = 64;
  const double band = frame.height / bands;
  for (int k = 0; k < bands; ++k)
    svg.rectangle(bar_left, frame.top + frame.height - (k + 1) * band, bar_width, band,
                  colour_of((k + 0.5) / bands));
  svg.rectangle(bar_left, frame.top, bar_width, frame.height, "none", {"#57606a", 1, ""});
  for (std::size_t k = 0; k < scale.values.size(); ++k) {
    const double at = frame.top + frame.height * (1 - fraction(scale.values[k]));
    svg.line(bar_left + bar_width, at, bar_left + bar_width + 5, at, {"#57606a", 1, ""});
    svg.text(bar_left + bar_width + 9, at + 4.2, scale.labels[k], small);
  }
  svg.text(bar_left + bar_width + 9 + label_width + 20, frame.top + frame.height / 2,
           with_unit(colour.title, colour.unit), turned);
  return frame.finish();
}

}  // namespace seedflow
