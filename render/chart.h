#pragma once
/// Line charts: a few quantities over time, for comparisons.

#include <string>
#include <vector>

#include "render/canvas.h"
#include "render/theme.h"

namespace merge2d {

struct Series {
  std::string name;
  std::vector<double> x, y;  ///< of one length, x ascending
};

struct Chart {
  std::string title;
  std::string x_label, y_label;  ///< with their units: "time [s]"
  bool log_y = false;            ///< values that are not positive are left out
  std::vector<Series> series;
};

/// Round numbers with equal steps (1, 2 or 5 times a power of ten) that lie in [low, high], about
/// `wanted` of them.
std::vector<double> ticks(double low, double high, int wanted);

/// Fills the canvas. Each line has its name at its end; there are four colours (Theme::lines).
Picture drawChart(Canvas& canvas, const Chart& chart, const Theme& theme = lightTheme());

}  // namespace merge2d
