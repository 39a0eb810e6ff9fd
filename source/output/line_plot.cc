#include <algorithm>
#include <cmath>

#include "plot_frame.h"
#include "seedflow/base/error.h"

namespace seedflow {

namespace {

using Draw = LineSeries::Draw;

void require(bool good, const LineSeries& series, const std::string& what) {
  if (!good) throw RunError("The series '" + series.label + "' cannot be plotted: " + what + ".");
}

void validate(const LinePlot& plot, const LineSeries& s) {
  const std::size_t n = s.x.size();
  require(s.y.size() == n, s, "x and y differ in length");
  require(s.error.empty() || s.error.size() == n, s, "the error bars differ in number from the points");
  require(s.band_low.size() == s.band_high.size() && (s.band_low.empty() || s.band_low.size() == n), s,
          "the band differs in length from the line");
  for (std::size_t i = 0; i < n; ++i) {
    require(std::isfinite(s.x[i]) && !std::isinf(s.y[i]), s, "point " + std::to_string(i) + " is not finite");
    require(!plot.x.logarithmic || s.x[i] > 0, s, "x must be above zero on a logarithmic axis");
    require(!plot.y.logarithmic || !(s.y[i] <= 0), s, "y must be above zero on a logarithmic axis");
  }
}

/// A long line reduced to the points it takes to stay within a tenth of a pixel of it (Ramer 1972; Douglas
/// and Peucker 1973): the drawing is the same, the file smaller.
std::vector<std::size_t> visible_points(const std::vector<double>& x, const std::vector<double>& y) {
  constexpr double tolerance = 0.1;
  const std::size_t n = x.size();
  std::vector<char> keep(n, n <= 2);
  std::vector<std::pair<std::size_t, std::size_t>> open;
  if (n > 2) open.emplace_back(0, n - 1), keep[0] = keep[n - 1] = 1;
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    const double dx = x[last] - x[first], dy = y[last] - y[first], square = dx * dx + dy * dy;
    double furthest = tolerance;
    std::size_t split = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double ex = x[i] - x[first], ey = y[i] - y[first];
      const double t = square > 0 ? std::clamp((ex * dx + ey * dy) / square, 0.0, 1.0) : 0;
      const double distance = std::hypot(ex - t * dx, ey - t * dy);
      if (distance > furthest) furthest = distance, split = i;
    }
    if (split == first) continue;
    keep[split] = 1;
    open.emplace_back(first, split);
    open.emplace_back(split, last);
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < n; ++i)
    if (keep[i]) kept.push_back(i);
  return kept;
}

void draw_line(PlotFrame& frame, const LineSeries& s, const SeriesStyle& style) {
  std::vector<double> x, y;
  const auto flush = [&] {
    std::vector<double> px, py;
    for (const std::size_t i : visible_points(x, y)) px.push_back(x[i]), py.push_back(y[i]);
    if (px.size() > 1) frame.svg().polyline(px, py, {style.colour, 2, style.dash});
    x.clear(), y.clear();
  };
  for (std::size_t i = 0; i < s.x.size(); ++i)
    if (std::isnan(s.y[i]))
      flush();
    else
      x.push_back(frame.x(s.x[i])), y.push_back(frame.y(s.y[i]));
  flush();
}

void draw_band(PlotFrame& frame, const LineSeries& s, const SeriesStyle& style, double lowest) {
  std::vector<double> x, y;
  const auto point = [&](std::size_t i, double value) {
    if (!std::isfinite(value)) return;
    x.push_back(frame.x(s.x[i])), y.push_back(frame.y(std::max(value, lowest)));
  };
  for (std::size_t i = 0; i < s.band_low.size(); ++i) point(i, s.band_low[i]);
  for (std::size_t i = s.band_high.size(); i-- > 0;) point(i, s.band_high[i]);
  if (x.size() > 2) frame.svg().polygon(x, y, style.colour, 0.18);
}

void draw_errors(PlotFrame& frame, const LineSeries& s, const SeriesStyle& style, double lowest) {
  const Svg::Stroke stroke{style.colour, 1.4, ""};
  for (std::size_t i = 0; i < s.error.size(); ++i) {
    if (!std::isfinite(s.error[i]) || std::isnan(s.y[i])) continue;
    const double x = frame.x(s.x[i]), high = frame.y(s.y[i] + s.error[i]),
                 low = frame.y(std::max(s.y[i] - s.error[i], lowest));
    frame.svg().line(x, low, x, high, stroke);
    frame.svg().line(x - 4, low, x + 4, low, stroke);
    frame.svg().line(x - 4, high, x + 4, high, stroke);
  }
}

}  // namespace

std::string LinePlot::svg() const {
  Extent x_extent, y_extent;
  std::size_t missing = 0;
  // On a logarithmic axis a band or an error bar may reach below zero; it then ends at the lower edge.
  const auto add_y = [&](double value) {
    if (!y.logarithmic || value > 0) y_extent.add(value);
  };
  for (const LineSeries& s : series) {
    validate(*this, s);
    for (const double value : s.x) x_extent.add(value);
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      missing += std::isnan(s.y[i]);
      add_y(s.y[i]);
      if (!s.error.empty()) add_y(s.y[i] + s.error[i]), add_y(s.y[i] - s.error[i]);
    }
    for (const double value : s.band_low) add_y(value);
    for (const double value : s.band_high) add_y(value);
  }
  for (const ReferenceLine& r : horizontal) y_extent.add(r.value);
  for (const ReferenceLine& r : vertical) x_extent.add(r.value);

  PlotFrame::Content content;
  content.title = title;
  content.x = x;
  content.y = y;
  content.x_ticks = axis_ticks(x, x_extent, 8);
  content.y_ticks = axis_ticks(y, y_extent, 6);
  content.horizontal = horizontal;
  content.vertical = vertical;
  if (missing > 0)
    content.note = std::to_string(missing) + (missing == 1 ? " value is" : " values are") + " missing.";
  const auto style_of = [&](std::size_t i) {
    return SeriesStyle(series[i].style.value_or(static_cast<int>(i)));
  };
  for (std::size_t i = 0; i < series.size(); ++i) {
    const LineSeries& s = series[i];
    if (s.label.empty()) continue;
    content.legend.push_back(
        {s.label, [&s, style = style_of(i)](Svg& svg, double at, double middle, double w) {
           if (!s.band_low.empty())
             svg.polygon({at, at + w, at + w, at}, {middle - 6, middle - 6, middle + 6, middle + 6},
                         style.colour, 0.18);
           if (s.draw != Draw::markers) svg.line(at, middle, at + w, middle, {style.colour, 2, style.dash});
           if (s.draw != Draw::line) draw_mark(svg, at + w / 2, middle, style);
         }});
  }

  PlotFrame frame(content);
  const double lowest = content.y_ticks.low;
  frame.draw_references();
  frame.svg().begin_clip(frame.left, frame.top, frame.width, frame.height);
  for (std::size_t i = 0; i < series.size(); ++i) draw_band(frame, series[i], style_of(i), lowest);
  for (std::size_t i = 0; i < series.size(); ++i)
    if (series[i].draw != Draw::markers) draw_line(frame, series[i], style_of(i));
  frame.svg().end_clip();
  // Marks may stand on the edge of the rectangle; those outside fixed bounds are left out.
  for (std::size_t i = 0; i < series.size(); ++i) {
    const LineSeries& s = series[i];
    LineSeries within = s;
    within.x.clear(), within.y.clear(), within.error.clear();
    for (std::size_t k = 0; k < s.x.size(); ++k) {
      if (s.x[k] < content.x_ticks.low || s.x[k] > content.x_ticks.high) continue;
      if (!(s.y[k] >= content.y_ticks.low && s.y[k] <= content.y_ticks.high)) continue;
      within.x.push_back(s.x[k]), within.y.push_back(s.y[k]);
      if (!s.error.empty()) within.error.push_back(s.error[k]);
    }
    frame.svg().begin_clip(frame.left - 5, frame.top, frame.width + 10, frame.height);
    draw_errors(frame, within, style_of(i), lowest);
    frame.svg().end_clip();
    if (s.draw != Draw::line)
      for (std::size_t k = 0; k < within.x.size(); ++k)
        draw_mark(frame.svg(), frame.x(within.x[k]), frame.y(within.y[k]), style_of(i));
  }
  return frame.finish();
}

}  // namespace seedflow
