#pragma once

#include <functional>
#include <string>
#include <vector>

#include "seedflow/output/plot.h"
#include "seedflow/output/svg.h"
#include "seedflow/output/ticks.h"

namespace seedflow {

/// Colours, dashes and marks that tell series apart: the palette of Okabe and Ito (2008), made for
/// colour-blind readers, without its yellow (too faint on white); the dashes and marks differ too, for print
/// in grey.
struct SeriesStyle {
  explicit SeriesStyle(int number);
  std::string colour, dash;
  int mark;
};
/// Draws the mark of a series, centred.
void draw_mark(Svg& svg, double x, double y, const SeriesStyle& style, double size = 4);

/// Smallest and largest of the finite values seen.
struct Extent {
  double low = 1e308, high = -1e308;
  void add(double value);
  bool empty() const { return low > high; }
};

/// Ticks for an axis over the data, with its given bounds kept.
Ticks axis_ticks(const Axis& axis, Extent extent, int wanted);

/// One entry of the legend: how its sample is drawn at (x, y) with the given width.
struct LegendEntry {
  std::string label;
  std::function<void(Svg&, double x, double y, double width)> sample;
};

/// Everything of a plot except its data: title, legend in rows above the axes, axes with ticks and titles,
/// grid, reference lines with their labels in the margin (pushed apart where they would meet). Nothing of it
/// ever covers the rectangle of the data but the grid and the reference lines themselves.
class PlotFrame {
 public:
  struct Content {
    std::string title;
    Axis x, y;
    Ticks x_ticks, y_ticks;
    std::vector<LegendEntry> legend = {};
    std::vector<ReferenceLine> horizontal = {}, vertical = {};
    bool x_grid = true, x_marks = true;
    double extra_right = 0;                  ///< room right of the axes for a colour bar [px]
    double extra_bottom = 0;                 ///< room below the axes for labels of groups [px]
    double plot_width = 0, plot_height = 0;  ///< of the data rectangle [px]; 0: chosen
    std::string note = "";                   ///< a line at the very bottom
  };
  explicit PlotFrame(const Content& content);

  double x(double value) const { return left + position(value, content.x, content.x_ticks) * width; }
  double y(double value) const { return top + (1 - position(value, content.y, content.y_ticks)) * height; }
  Svg& svg() { return drawing; }
  /// The reference lines and their labels; below or above the data, as the plot decides.
  void draw_references();
  /// Draws the axes and closes the drawing.
  std::string finish();

  double left = 0, top = 0, width = 0, height = 0;  ///< the data rectangle [px]

 private:
  static double position(double value, const Axis& axis, const Ticks& ticks);
  void place_legend();
  void place_vertical_labels();
  void draw_title_and_legend();
  void draw_grid();
  void draw_axes();

  struct VerticalLabel {
    double at = 0;     ///< its line [px]
    double reach = 0;  ///< height of its top above the data rectangle [px]
    bool inside = true;
    std::vector<std::string> lines;
  };

  Content content;
  std::vector<VerticalLabel> vertical_labels;
  double total_width = 0, total_height = 0;
  double title_height = 0, legend_height = 0, vertical_label_height = 0, right_margin = 0;
  std::vector<std::pair<double, double>> legend_places;  ///< left end and middle of each entry [px]
  std::vector<std::string> x_title_lines;
  Svg drawing;
};

}  // namespace seedflow
