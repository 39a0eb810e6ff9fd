#include "seedflow/output/plot.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "demo_report.h"
#include "seedflow/output/svg.h"
#include "testing.h"
#include "xml.h"

namespace seedflow {
namespace {

const double nan_value = std::numeric_limits<double>::quiet_NaN();

struct Box {
  double left, right, top, bottom;
  std::string words;
};

/// The boxes of all texts that stand upright, with the estimated width of their words.
std::vector<Box> text_boxes(const std::vector<XmlElement>& elements) {
  std::vector<Box> boxes;
  for (const XmlElement& e : elements) {
    if (e.name != "text" || e.attributes.count("transform") > 0) continue;
    const double x = std::stod(e.attributes.at("x")), y = std::stod(e.attributes.at("y")),
                 size = std::stod(e.attributes.at("font-size"));
    const std::string words = unescaped(e.text);
    const double width = text_width(words, size);
    const auto anchor = e.attributes.find("text-anchor");
    const double left = anchor == e.attributes.end() ? x
                        : anchor->second == "middle" ? x - width / 2
                                                     : x - width;
    boxes.push_back({left, left + width, y - 0.75 * size, y + 0.2 * size, words});
  }
  return boxes;
}

std::vector<XmlElement> drawing_of(const std::string& svg) {
  std::string error;
  auto elements = elements_of(svg, error);
  EXPECT_EQ(error, "");
  return elements;
}

/// Nothing written meets anything else written or leaves the drawing.
void expect_no_overlap(const std::vector<XmlElement>& elements) {
  const auto boxes = text_boxes(elements);
  const double width = std::stod(elements[0].attributes.at("width")),
               height = std::stod(elements[0].attributes.at("height"));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& a = boxes[i];
    EXPECT_GE(a.left, -0.5) << a.words;
    EXPECT_LE(a.right, width + 0.5) << a.words;
    EXPECT_GE(a.top, 0) << a.words;
    EXPECT_LE(a.bottom, height) << a.words;
    for (std::size_t k = 0; k < i; ++k) {
      const Box& b = boxes[k];
      const bool apart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
      EXPECT_TRUE(apart) << "'" << a.words << "' covers '" << b.words << "'";
    }
  }
}

LinePlot simple_plot() {
  LinePlot plot{"A & B", {"time", "s"}, {"speed", "m/s"}};
  plot.series = {{"one", {0, 1, 2}, {0, 1, 4}}, {"two", {0, 1, 2}, {2, 2, 2}}};
  return plot;
}

std::vector<std::pair<double, double>> points_of(const XmlElement& polyline) {
  std::vector<std::pair<double, double>> points;
  std::istringstream text(polyline.attributes.at("points"));
  char comma = 0;
  for (double x, y; text >> x >> comma >> y;) points.emplace_back(x, y);
  return points;
}

std::vector<XmlElement> named(const std::vector<XmlElement>& elements, const std::string& name) {
  std::vector<XmlElement> found;
  for (const XmlElement& e : elements)
    if (e.name == name) found.push_back(e);
  return found;
}

TEST(LinePlot, DrawsValuesWhereTheAxisSaysTheyAre) {
  LinePlot plot = simple_plot();
  const auto elements = drawing_of(plot.svg());
  const auto lines = named(elements, "polyline");
  ASSERT_EQ(lines.size(), 2u);
  const auto points = points_of(lines[0]);
  ASSERT_EQ(points.size(), 3u);
  // The height of the mark "4" and "0" against that of the curve, within the 0.01 px of the file.
  const auto height_of_label = [&](const std::string& label) {
    for (const XmlElement& e : named(elements, "text"))
      if (e.text == label && e.attributes.at("text-anchor") == "end")
        return std::stod(e.attributes.at("y")) - 4.2;
    ADD_FAILURE() << label;
    return 0.0;
  };
  EXPECT_NEAR(points[2].second, height_of_label("4"), 0.02);
  EXPECT_NEAR(points[0].second, height_of_label("0"), 0.02);
  EXPECT_NEAR(points[1].second, height_of_label("1"), 0.02);
  EXPECT_NEAR(points[1].first - points[0].first, points[2].first - points[1].first, 0.02);
  EXPECT_NE(lines[0].attributes.at("stroke"), lines[1].attributes.at("stroke"));
  EXPECT_EQ(lines[0].attributes.count("stroke-dasharray"), 0u);
  EXPECT_EQ(lines[1].attributes.count("stroke-dasharray"), 1u) << "told apart in grey print too";
}

TEST(LinePlot, LogarithmicAxisTurnsPowersIntoStraightLines) {
  LinePlot plot{"Order", {"h", "m", true}, {"error", "1", true}};
  plot.series = {{"second order", {1, 0.1, 0.01}, {3, 0.03, 0.0003}, LineSeries::Draw::both}};
  plot.series[0].error = {0.1, 0.001, 0.00001};
  const auto points = points_of(named(drawing_of(plot.svg()), "polyline")[0]);
  // The middle point of a straight line is not needed.
  EXPECT_EQ(points.size(), 2u);
}

TEST(LinePlot, ALongLineIsThinnedByLessThanATenthOfAPixel) {
  LinePlot plot{"Long", {"time", "s", false, 0.0, 1.0}, {"signal", "1", false, -1.0, 1.0}};
  LineSeries line{"signal", {}, {}};
  for (int i = 0; i <= 50000; ++i)
    line.x.push_back(i / 50000.0), line.y.push_back(std::sin(30.0 * i / 50000));
  plot.series = {line};
  const auto points = points_of(named(drawing_of(plot.svg()), "polyline")[0]);
  EXPECT_LT(points.size(), 1000u);
  const double x0 = points.front().first, width = points.back().first - x0, y0 = points.front().second;
  for (std::size_t i = 0, p = 0; i < line.x.size(); i += 7) {
    const double x = x0 + width * line.x[i];
    while (p + 2 < points.size() && points[p + 1].first < x) ++p;
    const double t = (x - points[p].first) / (points[p + 1].first - points[p].first);
    const double y = points[p].second + t * (points[p + 1].second - points[p].second);
    // 150 px are one unit. The distance to a chord of slope up to 7 is a seventh of the vertical difference.
    const double slope =
        std::abs((points[p + 1].second - points[p].second) / (points[p + 1].first - points[p].first));
    EXPECT_NEAR(y, y0 - 150 * line.y[i], 0.13 * std::sqrt(1 + slope * slope));
  }
}

TEST(LinePlot, MissingValuesLeaveAGapAndAreCounted) {
  LinePlot plot = simple_plot();
  plot.series = {{"with a gap", {0, 1, 2, 3, 4}, {0, 1, nan_value, 3, 5}}};
  const auto elements = drawing_of(plot.svg());
  EXPECT_EQ(named(elements, "polyline").size(), 2u);
  EXPECT_EQ(named(elements, "text").back().text, "1 value is missing.");
}

TEST(LinePlot, WhatCannotBeDrawnIsAnErrorThatNamesTheSeries) {
  const auto message = [](LinePlot plot) { return message_of<RunError>([&] { plot.svg(); }); };
  LinePlot plot = simple_plot();
  plot.series[1].y[0] = std::numeric_limits<double>::infinity();
  EXPECT_CONTAINS(message(plot), "'two'");
  plot = simple_plot();
  plot.y.logarithmic = true;
  EXPECT_CONTAINS(message(plot), "above zero");
  plot = simple_plot();
  plot.series[0].y.pop_back();
  EXPECT_CONTAINS(message(plot), "differ in length");
  plot = simple_plot();
  plot.x.low = 3, plot.x.high = 1;
  EXPECT_CONTAINS(message(plot), "'time'");
}

TEST(LinePlot, EmptyAndConstantDataAreDrawn) {
  LinePlot plot{"Nothing yet", {"time", "s"}, {"speed", "m/s"}};
  drawing_of(plot.svg());
  plot.series = {{"one point", {0.5}, {0.2}, LineSeries::Draw::markers}};
  EXPECT_GE(named(drawing_of(plot.svg()), "circle").size(), 2u) << "in the plot and in the legend";
}

TEST(LinePlot, ReferenceLabelsNeverMeetEvenWhenTheirLinesDo) {
  LinePlot plot = simple_plot();
  for (int i = 0; i < 7; ++i)
    plot.horizontal.push_back({3.9 + 0.01 * i, "published value number " + std::to_string(i)});
  for (int i = 0; i < 6; ++i)
    plot.vertical.push_back({1.7 + 0.05 * i, "event with a long name " + std::to_string(i)});
  for (int i = 0; i < 9; ++i) plot.series.push_back({"another series " + std::to_string(i), {0, 1}, {1, 2}});
  const auto elements = drawing_of(plot.svg());
  expect_no_overlap(elements);
  // The samples of the legend stand in the 40 px before their words and meet no words either.
  const auto boxes = text_boxes(elements);
  for (const Box& sample : boxes) {
    if (sample.words.rfind("another series", 0) != 0) continue;
    for (const Box& words : boxes) {
      const bool beside = words.right <= sample.left - 40 || words.left >= sample.left;
      EXPECT_TRUE(beside || words.bottom <= sample.top || words.top >= sample.bottom) << words.words;
    }
  }
}

TEST(LinePlot, AReferenceOutsideFixedBoundsIsSaidNotDrawn) {
  LinePlot plot = simple_plot();
  plot.y.low = 0, plot.y.high = 4;
  plot.horizontal = {{25, "limit"}};
  EXPECT_CONTAINS(plot.svg(), "limit (25, outside)");
}

TEST(BarPlot, HeightsAreProportionalAndBeginAtZero) {
  BarPlot plot{"Bars", {"a", "b"}, {"speed", "m/s"}};
  plot.series = {{"one", {2, 4}}};
  const auto bars = named(drawing_of(plot.svg()), "rect");
  ASSERT_EQ(bars.size(), 2u);
  EXPECT_NEAR(std::stod(bars[1].attributes.at("height")) / std::stod(bars[0].attributes.at("height")), 2.0,
              1e-3);
  EXPECT_NEAR(std::stod(bars[0].attributes.at("y")) + std::stod(bars[0].attributes.at("height")),
              std::stod(bars[1].attributes.at("y")) + std::stod(bars[1].attributes.at("height")), 0.02);
}

TEST(BarPlot, MissingValuesSayNotAvailable) {
  BarPlot plot{"Bars", {"a", "b", "c"}, {"speed", "m/s"}};
  plot.series = {{"one", {2, nan_value, -1}, {0.1, 0.1, 0.1}}, {"two", {1, 1, 1}}};
  plot.horizontal = {{1.5, "limit"}};
  const auto elements = drawing_of(plot.svg());
  EXPECT_EQ(named(elements, "rect").size(), 2u + 5u);
  EXPECT_CONTAINS(plot.svg(), ">n/a<");
  plot.series[0].values.pop_back();
  EXPECT_CONTAINS(message_of<RunError>([&] { plot.svg(); }), "2 values for 3 groups");
}

TEST(HeatMap, CellsLieFromTheLowerLeftAndEqualScaleIsEqual) {
  HeatMap map{"Map", {"x", "m", false, 0.0, 2.0}, {"y", "m", false, 0.0, 3.0}, {"T", "K", false, 0.0, 1.0}, 2,
              3};
  map.values = {0, 1, 0.5, nan_value, 0.25, 0.75};
  map.equal_scale = true;
  const auto elements = drawing_of(map.svg());
  const auto cells = named(elements, "rect");
  const auto of = [](const XmlElement& e, const char* key) { return std::stod(e.attributes.at(key)); };
  // The first rectangle is the grey ground, then the cells with a value in rows from below.
  EXPECT_NEAR(of(cells[0], "width") / of(cells[0], "height"), 2.0 / 3, 1e-4);
  EXPECT_EQ(cells[1].attributes.at("fill"), "#440154");
  EXPECT_EQ(cells[2].attributes.at("fill"), "#fde725");
  EXPECT_NEAR(of(cells[1], "y") + of(cells[1], "height"), of(cells[0], "y") + of(cells[0], "height"), 0.02);
  EXPECT_LT(of(cells[3], "y"), of(cells[1], "y"));
  EXPECT_CONTAINS(map.svg(), "Grey: no value.");
  map.values.pop_back();
  EXPECT_THROW(map.svg(), RunError);
}

TEST(Plots, OfTheDemonstrationAreWellFormedAndNothingWrittenOverlaps) {
  const std::string html = demo_report().html();
  int n_plots = 0;
  for (std::size_t begin = html.find("<figure>\n<svg"); begin != std::string::npos;
       begin = html.find("<figure>\n<svg", begin + 1)) {
    const std::size_t end = html.find("<figcaption>", begin);
    expect_no_overlap(drawing_of(html.substr(begin + 9, end - begin - 9)));
    ++n_plots;
  }
  EXPECT_EQ(n_plots, 7);
}

}  // namespace
}  // namespace seedflow
