#include "seedflow/output/radar_plot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

TEST(RadarPlot, HasEverySpokeAndCurve) {
  RadarPlot plot{"Drag", {"0 s", "1 s", "2 s", "3 s"}, "N"};
  plot.series = {{"A", {1, 2, 3, 4}}, {"B <alone>", {0, 0, 0, 0}}};
  const std::string svg = plot.svg();
  for (const char* text : {"Drag [N]", "0 s", "3 s", "A", "B &lt;alone&gt;"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(RadarPlot, RefusesWhatCannotBeDrawn) {
  RadarPlot plot{"Drag", {"0", "1", "2"}};
  plot.series = {{"A", {1, 2}}};
  EXPECT_THROW(plot.svg(), RunError);
  plot.series = {{"A", {1, 2, std::nan("")}}};
  EXPECT_THROW(plot.svg(), RunError);
  plot.series = {{"A", {1, 2, -1}}};
  EXPECT_THROW(plot.svg(), RunError);
  plot.spokes = {"0", "1"};
  plot.series.clear();
  EXPECT_THROW(plot.svg(), RunError);
}

}  // namespace
}  // namespace seedflow
