#include "plot_frame.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

// Measures in px. Width and height fit a page of text; type is that of the text around the plot.
constexpr double default_width = 760, default_plot_height = 300, edge = 6;
constexpr double title_size = 15, axis_size = 13, small_size = 12, line_height = 16;
constexpr double legend_sample = 32, legend_gap = 22, legend_row = 20;
constexpr double reference_label_width = 150;

const Svg::Stroke grid_stroke{"#e4e7eb", 1, ""};
const Svg::Stroke minor_grid_stroke{"#f1f3f5", 1, ""};
const Svg::Stroke axis_stroke{"#57606a", 1, ""};
const Svg::Stroke reference_stroke{"#6e7781", 1.2, "6 3"};
const Svg::Stroke leader_stroke{"#8c959f", 0.8, ""};
const std::string quiet_text = "#444c56";

Svg::Font font(double size, Svg::Anchor anchor, const std::string& colour = "#1f2328") {
  Svg::Font f;
  f.size = size;
  f.anchor = anchor;
  f.colour = colour;
  return f;
}

/// A block of lines of text with its first line's top at y.
void draw_lines(Svg& svg, double x, double y, const std::vector<std::string>& lines, const Svg::Font& f) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    svg.text(x, y + static_cast<double>(i) * line_height + 0.8 * f.size, lines[i], f);
}

double widest(const std::vector<std::string>& lines, double size) {
  double width = 0;
  for (const std::string& line : lines) width = std::max(width, text_width(line, size));
  return width;
}

double clamped(double value, const Ticks& ticks) {
  return std::clamp(value, ticks.low, ticks.high);
}

bool inside(double value, const Ticks& ticks) {
  return value >= ticks.low && value <= ticks.high;
}

/// The label of a reference line; one that the fixed bounds of the axis leave outside says so.
std::vector<std::string> label_lines(const ReferenceLine& r, const Ticks& ticks) {
  return wrapped(inside(r.value, ticks) ? r.label : r.label + " (" + printed_number(r.value) + ", outside)",
                 reference_label_width, small_size);
}

}  // namespace

SeriesStyle::SeriesStyle(int number) {
  static const char* const colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                        "#56B4E9", "#E69F00", "#24292f"};
  static const char* const dashes[] = {"", "9 4", "2.5 3", "10 3 2.5 3", "16 4", "5 2.5", "1.5 5"};
  const int kind = (number % 7 + 7) % 7;
  colour = colours[kind];
  // From the eighth series on colours return with another dash.
  dash = dashes[(kind + number / 7) % 7];
  mark = (kind + number / 7) % 7;
}

void draw_mark(Svg& svg, double x, double y, const SeriesStyle& style, double s) {
  const Svg::Stroke outline{"#ffffff", 0.8, ""}, thick{style.colour, 2, ""};
  const double t = 1.2 * s;
  switch (style.mark) {
    case 0:
      return svg.circle(x, y, s, style.colour, outline);
    case 1:
      return svg.rectangle(x - 0.9 * s, y - 0.9 * s, 1.8 * s, 1.8 * s, style.colour, outline);
    case 2:
      return svg.polygon({x, x + t, x - t}, {y - t, y + 0.8 * t, y + 0.8 * t}, style.colour, 1, outline);
    case 3:
      return svg.polygon({x, x + t, x, x - t}, {y - t, y, y + t, y}, style.colour, 1, outline);
    case 4:
      return svg.polygon({x, x + t, x - t}, {y + t, y - 0.8 * t, y - 0.8 * t}, style.colour, 1, outline);
    case 5:
      svg.line(x - s, y - s, x + s, y + s, thick);
      return svg.line(x - s, y + s, x + s, y - s, thick);
    default:
      svg.line(x - t, y, x + t, y, thick);
      return svg.line(x, y - t, x, y + t, thick);
  }
}

void Extent::add(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

Ticks axis_ticks(const Axis& axis, Extent extent, int wanted) {
  if (extent.empty()) extent = axis.logarithmic ? Extent{1, 10} : Extent{0, 1};
  const double low = axis.low.value_or(extent.low), high = axis.high.value_or(extent.high);
  if (axis.low && axis.high && !(low < high))
    throw RunError("The axis '" + axis.title + "' is to run from " + printed_number(low) + " to " +
                   printed_number(high) + ".");
  return (axis.logarithmic ? logarithmic_ticks : linear_ticks)(low, high, wanted, axis.low.has_value(),
                                                               axis.high.has_value());
}

double PlotFrame::position(double value, const Axis& axis, const Ticks& ticks) {
  return axis.logarithmic ? std::log(value / ticks.low) / std::log(ticks.high / ticks.low)
                          : (value - ticks.low) / (ticks.high - ticks.low);
}

PlotFrame::PlotFrame(const Content& content_) : content(content_), drawing(0, 0, "") {
  height = content.plot_height > 0 ? content.plot_height : default_plot_height;
  const double y_title_lines =
      content.y.title.empty()
          ? 0
          : static_cast<double>(
                wrapped(with_unit(content.y.title, content.y.unit), height, axis_size).size());
  left = y_title_lines * line_height + 6 + widest(content.y_ticks.labels, small_size) + 8;

  double labels = 0;
  for (const ReferenceLine& r : content.horizontal)
    labels = std::max(labels, widest(label_lines(r, content.y_ticks), small_size));
  right_margin = content.extra_right + (labels > 0 ? labels + 22 : 18);
  // The last tick label is centred on the end of the axis.
  if (!content.x_ticks.labels.empty())
    right_margin = std::max(right_margin, text_width(content.x_ticks.labels.back(), small_size) / 2 + edge);

  total_width = default_width;
  width = total_width - left - right_margin;
  if (content.plot_width > 0) {
    width = content.plot_width;
    total_width = left + width + right_margin;
  }
  // Labels of vertical lines begin at the line; the last ones may need more room on the right.
  for (int pass = 0; pass < 5; ++pass)
    for (const ReferenceLine& r : content.vertical) {
      const double missing = x(clamped(r.value, content.x_ticks)) +
                             widest(label_lines(r, content.x_ticks), small_size) + 10 - total_width;
      if (missing <= 0) continue;
      if (content.plot_width > 0)
        total_width += missing;
      else
        width -= missing;
    }

  const auto title_lines = wrapped(content.title, total_width, title_size);
  title_height = content.title.empty() ? 4 : 8 + 20 * static_cast<double>(title_lines.size());
  place_legend();

  place_vertical_labels();

  top = title_height + legend_height + vertical_label_height + 6;
  x_title_lines = content.x.title.empty()
                      ? std::vector<std::string>{}
                      : wrapped(with_unit(content.x.title, content.x.unit), width, axis_size);
  double bottom = (content.x_ticks.labels.empty() ? 4 : 22) + content.extra_bottom +
                  (line_height + 1) * static_cast<double>(x_title_lines.size()) + 4;
  if (!content.note.empty()) bottom += 18;
  total_height = top + height + bottom;
  drawing = Svg(total_width, total_height, content.title);
  draw_title_and_legend();
  draw_grid();
}

void PlotFrame::place_legend() {
  // In one row if it fits, otherwise in columns of equal width.
  const double room = total_width - left + legend_gap;
  std::vector<double> widths;
  double sum = 0, largest = 1;
  for (const LegendEntry& entry : content.legend) {
    widths.push_back(legend_sample + 8 + text_width(entry.label, small_size) + legend_gap);
    sum += widths.back();
    largest = std::max(largest, widths.back());
  }
  const bool one_row = sum <= room;
  const auto per_row =
      one_row ? widths.size() : static_cast<std::size_t>(std::max(1.0, std::floor(room / largest)));
  double at = left;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    if (i % per_row == 0) at = left;
    legend_places.emplace_back(at, title_height + legend_row * (static_cast<double>(i / per_row) + 0.5));
    at += one_row ? widths[i] : largest;
  }
  if (!widths.empty())
    legend_height = legend_row * static_cast<double>((widths.size() - 1) / per_row + 1) + 6;
}

void PlotFrame::place_vertical_labels() {
  // From right to left: a label that would run into labels to its right stands above them, so that no label
  // is crossed by the line of another.
  for (const ReferenceLine& r : content.vertical)
    vertical_labels.push_back({x(clamped(r.value, content.x_ticks)), 0, inside(r.value, content.x_ticks),
                               label_lines(r, content.x_ticks)});
  std::sort(vertical_labels.begin(), vertical_labels.end(),
            [](const VerticalLabel& a, const VerticalLabel& b) { return a.at > b.at; });
  for (VerticalLabel& label : vertical_labels) {
    const double end = label.at + widest(label.lines, small_size) + 10;
    double base = 0;
    for (const VerticalLabel* other = vertical_labels.data(); other != &label; ++other)
      if (other->at < end) base = std::max(base, other->reach);
    label.reach = base + line_height * static_cast<double>(label.lines.size()) + 3;
    vertical_label_height = std::max(vertical_label_height, label.reach);
  }
}

void PlotFrame::draw_title_and_legend() {
  Svg::Font bold = font(title_size, Svg::Anchor::start);
  bold.bold = true;
  const auto lines = wrapped(content.title, total_width, title_size);
  for (std::size_t i = 0; i < lines.size(); ++i)
    drawing.text(0, 18 + 20 * static_cast<double>(i), lines[i], bold);
  for (std::size_t i = 0; i < content.legend.size(); ++i) {
    const auto [at, middle] = legend_places[i];
    content.legend[i].sample(drawing, at, middle, legend_sample);
    drawing.text(at + legend_sample + 8, middle + 4.2, content.legend[i].label,
                 font(small_size, Svg::Anchor::start));
  }
}

void PlotFrame::draw_grid() {
  for (const double v : content.y_ticks.minor)
    drawing.line(left, y(v), left + width, y(v), minor_grid_stroke);
  if (content.x_grid)
    for (const double v : content.x_ticks.minor)
      drawing.line(x(v), top, x(v), top + height, minor_grid_stroke);
  for (const double v : content.y_ticks.values) drawing.line(left, y(v), left + width, y(v), grid_stroke);
  if (content.x_grid)
    for (const double v : content.x_ticks.values) drawing.line(x(v), top, x(v), top + height, grid_stroke);
}

void PlotFrame::draw_axes() {
  const double bottom = top + height;
  drawing.line(left, bottom, left + width, bottom, axis_stroke);
  drawing.line(left, top, left, bottom, axis_stroke);
  for (std::size_t i = 0; i < content.y_ticks.values.size(); ++i) {
    const double at = y(content.y_ticks.values[i]);
    drawing.line(left - 5, at, left, at, axis_stroke);
    drawing.text(left - 8, at + 4.2, content.y_ticks.labels[i], font(small_size, Svg::Anchor::end));
  }
  for (std::size_t i = 0; i < content.x_ticks.values.size(); ++i) {
    const double at = x(content.x_ticks.values[i]);
    if (content.x_marks) drawing.line(at, bottom, at, bottom + 5, axis_stroke);
    drawing.text(at, bottom + 18, content.x_ticks.labels[i], font(small_size, Svg::Anchor::middle));
  }
  const double title_top = bottom + (content.x_ticks.labels.empty() ? 4 : 22) + content.extra_bottom + 4;
  draw_lines(drawing, left + width / 2, title_top, x_title_lines, font(axis_size, Svg::Anchor::middle));
  if (!content.y.title.empty()) {
    Svg::Font turned = font(axis_size, Svg::Anchor::middle);
    turned.rotation = -90;
    const auto lines = wrapped(with_unit(content.y.title, content.y.unit), height, axis_size);
    for (std::size_t i = 0; i < lines.size(); ++i)
      drawing.text(11 + line_height * static_cast<double>(i), top + height / 2, lines[i], turned);
  }
  if (!content.note.empty())
    drawing.text(left, total_height - 5, content.note, font(small_size, Svg::Anchor::start, quiet_text));
}

void PlotFrame::draw_references() {
  struct Label {
    double at, top;
    std::vector<std::string> lines;
    double size() const { return line_height * static_cast<double>(lines.size()) + 3; }
  };
  std::vector<Label> labels;
  for (const ReferenceLine& r : content.horizontal) {
    const double at = y(clamped(r.value, content.y_ticks));
    if (inside(r.value, content.y_ticks)) drawing.line(left, at, left + width, at, reference_stroke);
    labels.push_back({at, 0, label_lines(r, content.y_ticks)});
  }
  // Beside their lines, pushed downwards where they would meet, then upwards from the bottom.
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.at < b.at; });
  double reached = top - 8;
  for (Label& label : labels) {
    label.top = std::max(reached, label.at - label.size() / 2);
    reached = label.top + label.size();
  }
  double floor = top + height + 14;
  for (auto label = labels.rbegin(); label != labels.rend(); ++label) {
    label->top = std::min(label->top, floor - label->size());
    floor = label->top;
  }
  const double margin = left + width;
  for (const Label& label : labels) {
    drawing.line(margin, label.at, margin + 11, label.top + label.size() / 2, leader_stroke);
    draw_lines(drawing, margin + 14, label.top + 3, label.lines,
               font(small_size, Svg::Anchor::start, quiet_text));
  }

  for (const VerticalLabel& label : vertical_labels) {
    if (label.inside) drawing.line(label.at, top, label.at, top + height, reference_stroke);
    drawing.line(label.at, top, label.at, top - label.reach, leader_stroke);
    draw_lines(drawing, label.at + 4, top - label.reach, label.lines,
               font(small_size, Svg::Anchor::start, quiet_text));
  }
}

std::string PlotFrame::finish() {
  draw_axes();
  return drawing.finish();
}

}  // namespace seedflow
