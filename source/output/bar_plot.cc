#include <algorithm>
#include <cmath>

#include "plot_frame.h"
#include "seedflow/base/error.h"

namespace seedflow {

namespace {

constexpr double label_size = 12, line_height = 16, value_size = 11;

void validate(const BarPlot& plot) {
  for (const BarSeries& s : plot.series) {
    if (s.values.size() != plot.groups.size() || (!s.error.empty() && s.error.size() != s.values.size()))
      throw RunError("The bars '" + s.label + "' cannot be plotted: " + std::to_string(s.values.size()) +
                     " values for " + std::to_string(plot.groups.size()) + " groups.");
    for (const double value : s.values)
      if (std::isinf(value) || (plot.y.logarithmic && value <= 0))
        throw RunError("The bars '" + s.label + "' cannot be plotted: a value is " + printed_number(value) +
                       ".");
  }
}

}  // namespace

std::string BarPlot::svg() const {
  validate(*this);
  Extent extent;
  if (!y.logarithmic) extent.add(0);
  for (const BarSeries& s : series)
    for (std::size_t g = 0; g < s.values.size(); ++g) {
      const double error = s.error.empty() || !std::isfinite(s.error[g]) ? 0 : s.error[g];
      extent.add(s.values[g] + error);
      if (!y.logarithmic || s.values[g] > error) extent.add(s.values[g] - error);
    }
  for (const ReferenceLine& r : horizontal) extent.add(r.value);
  // Room for the values written above the bars.
  if (show_values && !extent.empty() && !y.high)
    extent.high = y.logarithmic ? extent.high * 1.5 : extent.high + 0.12 * (extent.high - extent.low);
  // A logarithmic axis has no zero to begin the bars at; the smallest must still be seen.
  if (y.logarithmic && !extent.empty()) extent.low /= 2;

  PlotFrame::Content content;
  content.title = title;
  content.y = y;
  content.x_ticks.low = 0;
  content.x_ticks.high = std::max<double>(1, static_cast<double>(groups.size()));
  content.y_ticks = axis_ticks(y, extent, 6);
  content.horizontal = horizontal;
  content.x_grid = content.x_marks = false;
  if (series.size() > 1)
    for (std::size_t i = 0; i < series.size(); ++i)
      content.legend.push_back({series[i].label, [style = SeriesStyle(static_cast<int>(i))](
                                                     Svg& svg, double at, double middle, double w) {
                                  svg.rectangle(at + w / 4, middle - 6, w * 0.75, 12, style.colour);
                                }});
  // Names of groups are broken into lines as wide as a group; the room is known only with the frame's width,
  // so the narrowest it can be (labels in the margin) is taken.
  const double group_room = (horizontal.empty() ? 650.0 : 500.0) / content.x_ticks.high - 6;
  std::size_t lines = 1;
  for (const std::string& group : groups)
    lines = std::max(lines, wrapped(group, group_room, label_size).size());
  content.extra_bottom = 8 + line_height * static_cast<double>(lines);

  PlotFrame frame(content);
  Svg& svg = frame.svg();
  const double slot = frame.width / content.x_ticks.high;
  const double bar =
      std::min(60.0, 0.8 * slot / static_cast<double>(std::max<std::size_t>(1, series.size())));
  const double base = frame.y(
      std::clamp(y.logarithmic ? content.y_ticks.low : 0.0, content.y_ticks.low, content.y_ticks.high));
  const auto y_of = [&](double v) {
    return frame.y(std::clamp(v, content.y_ticks.low, content.y_ticks.high));
  };
  struct Label {
    double middle, bottom;
    std::string words;
  };
  std::vector<Label> labels;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double middle = frame.left + slot * (static_cast<double>(g) + 0.5);
    const auto name = wrapped(groups[g], group_room, label_size);
    Svg::Font group_font;
    group_font.size = label_size;
    group_font.anchor = Svg::Anchor::middle;
    for (std::size_t k = 0; k < name.size(); ++k)
      svg.text(middle, frame.top + frame.height + 18 + line_height * static_cast<double>(k), name[k],
               group_font);
    for (std::size_t i = 0; i < series.size(); ++i) {
      const double bar_left =
          middle + bar * (static_cast<double>(i) - 0.5 * static_cast<double>(series.size()));
      const double bar_middle = bar_left + bar / 2;
      const double value = series[i].values[g];
      if (std::isnan(value)) {
        labels.push_back({bar_middle, base - 5, "n/a"});
        continue;
      }
      const double end = y_of(value);
      svg.rectangle(bar_left + 1, std::min(base, end), bar - 2, std::abs(base - end),
                    SeriesStyle(static_cast<int>(i)).colour);
      double reached = std::min(base, end);
      if (!series[i].error.empty() && std::isfinite(series[i].error[g])) {
        const double high = y_of(value + series[i].error[g]), low = y_of(value - series[i].error[g]);
        const Svg::Stroke stroke{"#1f2328", 1.3, ""};
        svg.line(bar_middle, low, bar_middle, high, stroke);
        svg.line(bar_middle - 4, low, bar_middle + 4, low, stroke);
        svg.line(bar_middle - 4, high, bar_middle + 4, high, stroke);
        reached = std::min(reached, high);
      }
      if (show_values) labels.push_back({bar_middle, reached - 5, printed_number(value, 3)});
    }
  }
  frame.draw_references();
  // The values stand upright on the bars if one of them is wider than its bar.
  Svg::Font value_font;
  value_font.size = value_size;
  value_font.halo = true;
  bool across = true;
  for (const Label& label : labels) across = across && text_width(label.words, value_size) <= bar;
  for (const Label& label : labels) {
    value_font.anchor = across ? Svg::Anchor::middle : Svg::Anchor::start;
    value_font.rotation = across ? 0 : -90;
    svg.text(label.middle + (across ? 0 : 0.35 * value_size), label.bottom, label.words, value_font);
  }
  if (base < frame.top + frame.height - 1) svg.line(frame.left, base, frame.left + frame.width, base, {});
  return frame.finish();
}

}  // namespace seedflow
