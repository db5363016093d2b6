#include "render/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

namespace merge2d {
namespace {

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

/// How many pixels have this colour in the left half of the picture, where no names stand.
int pixelsOf(const Picture& picture, Color color) {
  int pixels = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width / 2; ++x) pixels += picture.at(x, y) == color;
  }
  return pixels;
}

TEST(Chart, DrawsALineForEachSeries) {
  Canvas canvas(640, 400);
  const Picture picture = drawChart(canvas, sample());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GT(rowsWith(picture, lineStyle(lightTheme(), i, 4).color), 8) << i;
  }
}

TEST(Chart, ShowsLinesThatLieOnTopOfEachOther) {
  Canvas canvas(1280, 800);
  Chart chart = sample();
  for (Series& series : chart.series) series.y = chart.series.front().y;
  const Picture picture = drawChart(canvas, chart);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GT(pixelsOf(picture, lineStyle(lightTheme(), i, 4).color), 100) << i;
  }
}

TEST(Chart, CanBeLogarithmicAndLeavesOutWhatHasNoLogarithm) {
  Canvas canvas(640, 400);
  Chart chart = sample();
  chart.log_y = true;
  chart.series[1].y[7] = 0.0;
  chart.series[1].y[8] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(rowsWith(drawChart(canvas, chart), lineStyle(lightTheme(), 1, 4).color), 8);
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
  EXPECT_EQ(picture.at(200, 40), lightTheme().background) << "above the axis";
}

/// The first and last column with this colour in the lower half of a chart.
std::pair<int, int> columnsOf(const Picture& picture, Color color) {
  std::pair<int, int> columns{picture.width, -1};
  for (int y = picture.height / 2; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (picture.at(x, y) != color) continue;
      columns.first = std::min(columns.first, x);
      columns.second = std::max(columns.second, x);
    }
  }
  return columns;
}

TEST(Chart, DrawsTheFirstAndLastAreaAsWideAsTheOthers) {
  Canvas canvas(960, 480);
  Chart chart = stackOf(1.0, 1.0);
  chart.series[0].y = {1.0, 0.0, 0.0};
  chart.series[1].y = {0.0, 1.0, 0.0};
  const Picture picture = drawChart(canvas, chart);
  const auto first = columnsOf(picture, lightTheme().collections[0].fill);
  const auto second = columnsOf(picture, lightTheme().collections[1].fill);
  EXPECT_NEAR(first.second - first.first, second.second - second.first, 2);
}

TEST(Chart, LeavesRoomBesideTheFirstValue) {
  Canvas canvas(960, 480);
  Chart chart;
  chart.series = {{"", {}, {}}, {"falls at once", {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}}};
  chart.x_low = 0.0, chart.x_high = 4.0;
  const Picture picture = drawChart(canvas, chart);
  int axis = 0;  // where it begins
  while (picture.at(axis, 428) != lightTheme().ink) ++axis;
  EXPECT_GT(columnsOf(picture, lightTheme().lines[1]).first, axis);
}

TEST(Chart, HasTextOfOneSizeInPicturesOfOneWidth) {
  const std::vector<Chart> charts(4, stackOf(1.0, 1.0));
  Canvas two(960, 2 * 320), four(960, 4 * 320);
  const Picture small = drawCharts(two, std::span(charts).first(2), 1);
  const Picture large = drawCharts(four, charts, 1);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) ASSERT_EQ(small.at(x, y), large.at(x, y));
  }
}

TEST(Chart, WritesNamesOfMarksThatAreCloseAboveEachOther) {
  Canvas canvas(960, 480);
  Chart chart = sample();
  chart.marks = {{10.0, "name"}};
  const int one = rowsWith(drawChart(canvas, chart), lightTheme().ink_soft);
  chart.marks = {{10.0, "name"}, {10.1, "name"}};
  EXPECT_GT(rowsWith(drawChart(canvas, chart), lightTheme().ink_soft), one);
  chart.marks = {{10.0, "name"}, {18.0, "name"}};
  EXPECT_EQ(rowsWith(drawChart(canvas, chart), lightTheme().ink_soft), one);
}

TEST(Chart, WritesNamesOfLateMarksBesideTheLegendAndNotOverIt) {
  Canvas canvas(960, 480);
  Chart chart = sample();
  chart.marks = {{19.9, "a name that is long"}, {19.95, "another one"}};
  const Picture picture = drawChart(canvas, chart);
  int last = 0;  // column of a name
  for (int y = 0; y < picture.height / 2; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (picture.at(x, y) == lightTheme().ink_soft) last = std::max(last, x);
    }
  }
  EXPECT_GT(last, 600) << "they are there";
  int end = picture.width - 1;  // of the axis
  while (picture.at(end, 428) != lightTheme().ink) --end;
  EXPECT_LE(last, end);
}

TEST(Chart, PutsATipOnWhatIsCutOff) {
  Canvas canvas(960, 480);
  Chart chart = stackOf(1.0, 1.0);
  chart.y_high = 3.0;
  const int whole = pixelsOf(drawChart(canvas, chart), lightTheme().ink);
  chart.y_high = 1.5;
  EXPECT_GT(pixelsOf(drawChart(canvas, chart), lightTheme().ink), whole);
}

TEST(Chart, DrawsWhatIsBelowALogarithmicFootAtIt) {
  Canvas canvas(960, 480);
  Chart chart;
  chart.series = {{"zero", {0.0, 1.0, 2.0}, {0.0, 1e-9, 1e-12}}, {"some", {0.0, 2.0}, {1.0, 10.0}}};
  chart.log_y = true;
  chart.y_floor = 1e-3;
  std::vector<double> numbers;
  chart.y_text = [&](double y) { return numbers.push_back(y), std::string("x"); };
  const Picture picture = drawChart(canvas, chart);
  EXPECT_GT(pixelsOf(picture, lineStyle(lightTheme(), 0, 2).color), 100);
  EXPECT_DOUBLE_EQ(*std::ranges::min_element(numbers), 1e-3);
  EXPECT_DOUBLE_EQ(*std::ranges::max_element(numbers), 10.0);
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

/// Where the axis at the foot of a chart begins and ends.
std::pair<int, int> axisOf(const Picture& picture, int from, int to) {
  std::pair<int, int> longest{0, 0};
  for (int y = from; y < to; ++y) {
    int begin = 0;
    for (int x = 0; x < picture.width; ++x) {
      if (picture.at(x, y) != lightTheme().ink) begin = x + 1;
      if (x - begin > longest.second - longest.first) longest = {begin, x};
    }
  }
  return longest;
}

TEST(Charts, OfOneColumnHaveTheirAxesInLine) {
  Canvas canvas(640, 800);
  Chart wide = sample(), narrow = sample();
  wide.y_text = [](double y) { return std::to_string(y) + " of a long unit"; };
  for (Series& series : narrow.series) series.name.resize(1);
  const std::array charts{wide, narrow};
  const Picture picture = drawCharts(canvas, charts, 1);
  EXPECT_EQ(axisOf(picture, 0, 400), axisOf(picture, 400, 800));
  const Picture alone = drawChart(canvas, narrow);
  EXPECT_LT(axisOf(alone, 0, 800).first, axisOf(picture, 400, 800).first);
}

TEST(Chart, OfCountsHasNoMarksBetweenWholeNumbers) {
  const Color grid = mix(lightTheme().background, lightTheme().ink, 0.12);
  Canvas canvas(640, 400);
  Chart chart{.title = "Events", .stacked = true, .series = {{"merges", {0, 1, 2}, {2, 0, 1}}}};
  const int all = rowsWith(drawChart(canvas, chart), grid);
  chart.whole = true;
  const int whole = rowsWith(drawChart(canvas, chart), grid);
  EXPECT_EQ(all, 4) << "0.5, 1, 1.5 and 2; the foot is the axis";
  EXPECT_EQ(whole, 2) << "1 and 2";
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
