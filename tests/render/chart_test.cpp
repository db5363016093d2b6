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
