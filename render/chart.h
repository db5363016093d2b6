#pragma once
/// Charts of a few quantities over time, for comparisons: lines, or areas on top of each other.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/canvas.h"
#include "render/theme.h"

namespace merge2d {

struct Series {
  std::string name;
  std::vector<double> x, y;  ///< of one length, x ascending
};

/// Something that happened: a thin upright line with a name, which is shortened where it is long.
struct ChartMark {
  double x = 0.0;
  std::string name;
};

struct Chart {
  std::string title;
  std::string x_label{}, y_label{};  ///< with their units: "time [s]"
  bool log_y = false;                ///< values that are not positive are left out
  bool whole = false;    ///< values are counts: no marks at the axis between whole numbers
  bool stacked = false;  ///< areas that add up, the first at the bottom; all share one x
  std::optional<double> x_low{}, x_high{};  ///< of the axis; default: what the series cover
  /// The axis ends here, and what is higher is cut off; stacks that go on have a tip on top.
  std::optional<double> y_high{};
  /// Of a logarithmic axis: what is less is drawn here, and the axis says so.
  std::optional<double> y_floor{};
  std::function<std::string(double)> y_text{};  ///< of a number at the axis; default: its digits
  /// Where the axis has numbers, and which; default: at round ones.
  std::vector<std::pair<double, std::string>> x_ticks{};
  bool points = false;  ///< every value has a dot
  std::vector<Series> series{};
  std::vector<ChartMark> marks{};
};

/// How the i-th of `count` lines is drawn: those below are wider and paler, so that one can see
/// where lines lie on top of each other.
struct LineStyle {
  Color color;
  float width = 1.0F;  ///< in units of the text's size
};
LineStyle lineStyle(const Theme& theme, std::size_t i, std::size_t count);

/// The shapes of a chart in a picture of this size; `text` must belong to the canvas that draws it.
Drawing composeCharts(Text& text, std::span<const Chart> charts, int columns, int width, int height,
                      const Theme& theme = lightTheme());

/// Fills the canvas. Each line has its name at its end; there are four colours (Theme::lines).
/// Areas have the colours of collections, and their names stand beside the chart. The text is as
/// large as the canvas is wide: in pictures that are shown at one width it has one size.
Picture drawChart(Canvas& canvas, const Chart& chart, const Theme& theme = lightTheme());

/// Several charts of one size in one picture, row by row. Those of one column share their margins,
/// so that one time is at one place in all of them.
Picture drawCharts(Canvas& canvas, std::span<const Chart> charts, int columns,
                   const Theme& theme = lightTheme());

}  // namespace merge2d
