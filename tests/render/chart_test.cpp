#include "render/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace merge2d {
namespace {

TEST(Ticks, AreRoundNumbersInTheRange) {
  EXPECT_EQ(ticks(0.0, 10.0, 5), (std::vector<double>{0.0, 2.0, 4.0, 6.0, 8.0, 10.0}));
  const std::vector<double> small = ticks(0.0, 0.043, 4);
  EXPECT_GE(small.size(), 3U);
  EXPECT_LE(small.back(), 0.043);
  EXPECT_EQ(ticks(-1.0, 1.0, 2).front(), -1.0);
}

Chart sample() {
  Chart chart{.title = "Time per step", .x_label = "time [s]", .y_label = "ms", .series = {}};
  for (const char* name : {"reference", "sleep", "merge", "merge+sleep"}) {
    Series& s = chart.series.emplace_back(Series{name, {}, {}});
    const double scale = 4.0 / static_cast<double>(chart.series.size());
    for (int i = 0; i < 5000; ++i) {
      s.x.push_back(0.004 * i);
      s.y.push_back(scale * (1.0 + 0.1 * std::sin(0.3 * i)));
    }
  }
  return chart;
}

/// Rows with a pixel of this colour.
int rowsWith(const Picture& picture, Color color) {
  int rows = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (picture.at(x, y) != color) continue;
      ++rows;
      break;
    }
  }
  return rows;
}

TEST(Chart, DrawsALineForEachSeries) {
  Canvas canvas(640, 400);
  const Picture picture = drawChart(canvas, sample());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GT(rowsWith(picture, lightTheme().lines[i]), 8) << i;
  }
}

TEST(Chart, CanBeLogarithmicAndLeavesOutWhatHasNoLogarithm) {
  Canvas canvas(640, 400);
  Chart chart = sample();
  chart.log_y = true;
  chart.series[1].y[7] = 0.0;
  chart.series[1].y[8] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(rowsWith(drawChart(canvas, chart), lightTheme().lines[1]), 8);
}

/// How many pixels have this colour in the left half of the picture, where no names stand.
int pixelsOf(const Picture& picture, Color color) {
  int pixels = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width / 2; ++x) pixels += picture.at(x, y) == color;
  }
  return pixels;
}

Chart stackOf(double first, double second) {
  Chart chart;
  chart.stacked = true;
  chart.series = {{"first", {0.0, 1.0, 2.0}, {first, first, first}},
                  {"second", {0.0, 1.0, 2.0}, {second, second, second}}};
  return chart;
}

TEST(Chart, StacksAreasInProportionToTheirValues) {
  Canvas canvas(640, 400);
  const Picture picture = drawChart(canvas, stackOf(1.0, 3.0));
  const int first = pixelsOf(picture, lightTheme().collections[0].fill);
  const int second = pixelsOf(picture, lightTheme().collections[1].fill);
  EXPECT_GT(first, 1000);
  EXPECT_NEAR(static_cast<double>(second) / first, 3.0, 0.1);
}

TEST(Chart, CutsOffWhatIsAboveItsAxis) {
  Canvas canvas(640, 400);
  Chart chart = stackOf(1.0, 1e6);
  chart.y_high = 2.0;
  const Picture picture = drawChart(canvas, chart);
  EXPECT_NEAR(pixelsOf(picture, lightTheme().collections[0].fill),
              pixelsOf(picture, lightTheme().collections[1].fill), 400);
  EXPECT_EQ(picture.at(200, 54), lightTheme().background) << "above the axis";
}

TEST(Chart, MarksWhatHappens) {
  Canvas canvas(640, 400);
  Chart chart = sample();
  const int before = rowsWith(drawChart(canvas, chart), lightTheme().ink_soft);
  chart.marks = {{10.0, "impact"}, {1e9, "never"}};
  EXPECT_GT(rowsWith(drawChart(canvas, chart), lightTheme().ink_soft), before + 50);
}

TEST(Charts, StandInRowsAndColumns) {
  Canvas canvas(640, 800);
  const std::vector<Chart> charts = {stackOf(1.0, 1.0), stackOf(1.0, 1.0), stackOf(1.0, 1.0)};
  const Picture picture = drawCharts(canvas, charts, 2);
  const Color first = lightTheme().collections[0].fill;
  EXPECT_EQ(picture.at(100, 330), first);
  EXPECT_EQ(picture.at(420, 330), first);
  EXPECT_EQ(picture.at(100, 730), first);
  EXPECT_EQ(picture.at(420, 730), lightTheme().background) << "there are only three";
}

TEST(Chart, DoesWithoutData) {
  Canvas canvas(320, 200);
  EXPECT_EQ(drawChart(canvas, {}).width, 320);
  Chart chart;
  chart.series = {{"nothing", {}, {}}, {"one", {1.0}, {5.0}}, {"flat", {0.0, 1.0}, {0.0, 0.0}}};
  EXPECT_EQ(drawChart(canvas, chart).width, 320);
  chart.log_y = true;
  EXPECT_EQ(drawChart(canvas, chart).width, 320);
}

}  // namespace
}  // namespace merge2d
