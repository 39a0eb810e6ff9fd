#include "seedflow/output/radar_plot.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

const char* const colours[] = {"#2969b0", "#cc4330", "#438c54", "#8c5c99"};
const char* const dashes[] = {"", "7 4", "2 3", "9 3 2 3"};

/// The next of 1, 2, 5, 10, ... that is not smaller.
double round_up(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

}  // namespace

std::string RadarPlot::svg() const {
  const std::size_t n = spokes.size();
  double largest = 0;
  for (const RadarSeries& s : series) {
    if (s.values.size() != n)
      throw RunError("Radar plot '" + title + "': '" + s.label + "' has not one value for every spoke.");
    for (const double v : s.values) {
      if (!(std::isfinite(v) && v >= 0))
        throw RunError("Radar plot '" + title + "': '" + s.label +
                       "' has a value that is negative or no number.");
      largest = std::max(largest, v);
    }
  }
  if (n < 3) throw RunError("Radar plot '" + title + "' needs at least three spokes.");
  const double top = largest > 0 ? round_up(largest) : 1;
  const double head = 30 + 18 * static_cast<double>(series.size()), radius = 0.5 * size - 48;
  const double cx = 0.5 * size, cy = head + 0.5 * size;
  Svg svg(size, head + size, title);
  svg.text(6, 18, with_unit(title, unit), {14, "#1f2328", Svg::Anchor::start, true});
  const auto at = [&](std::size_t i, double value) {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(n), r = radius * value / top;
    return std::pair{cx + r * std::sin(angle), cy - r * std::cos(angle)};
  };
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < n; ++i)
      x.push_back(at(i, part * top).first), y.push_back(at(i, part * top).second);
    svg.polygon(x, y, "none", 1, {"#ccc", 1, ""});
    svg.text(cx + 4, cy - radius * part + 11, printed_number(part * top, 3),
             {10, "#555", Svg::Anchor::start, false, true});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto [x, y] = at(i, top);
    svg.line(cx, cy, x, y, {"#ddd", 1, ""});
    const auto [lx, ly] = at(i, 1.11 * top);
    svg.text(lx, ly + 4, spokes[i], {11, "#1f2328", Svg::Anchor::middle});
  }
  for (std::size_t k = 0; k < series.size(); ++k) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < n; ++i)
      x.push_back(at(i, series[k].values[i]).first), y.push_back(at(i, series[k].values[i]).second);
    const Svg::Stroke stroke{colours[k % 4], 2, dashes[k % 4]};
    svg.polygon(x, y, colours[k % 4], 0.08, stroke);
    const double row = 36 + 18 * static_cast<double>(k);
    svg.line(10, row - 4, 40, row - 4, stroke);
    svg.text(46, row, series[k].label, {12});
  }
  return svg.finish();
}

}  // namespace seedflow
