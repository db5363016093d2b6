#pragma once
/// A quantity over two others as a field of colours, for studies.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/painter.h"
#include "render/theme.h"

namespace merge2d {

struct HeatMap {
  std::string title{};
  std::string x_label{}, y_label{};
  std::vector<std::string> x_values{},
      y_values{};  ///< one for each column; for each row, from below
  /// Row by row from below; nothing where there is no value.
  std::vector<std::optional<double>> cells{};
  std::function<std::string(double)> text{};  ///< of a value; default: its digits
  bool logarithmic = false;                   ///< colours by the logarithm, where all are positive
  double low = 0.0, high = 1.0;               ///< of the scale of colours
};

/// From pale for `low` to dark for `high`: it grows evenly to the eye, also without colour.
Color heatColor(const Theme& theme, double part);

/// Draws the map into the panel with the numbers in its cells, where there is room for them.
/// `unit`: design pixels to pixels.
void drawHeatMap(Painter& painter, const HeatMap& map, const Theme& theme, const PixelBox& panel,
                 float unit);

}  // namespace merge2d
