#pragma once
/// A comparison as charts, in the manner of the paper's Figs. 5, 8, 11 and 12.

#include <filesystem>
#include <string>
#include <vector>

#include "app/comparison.h"
#include "render/theme.h"

namespace merge2d {

struct ChartStyle {
  /// Of each chart [px]. At kDotsPerInch a picture is as wide as a page between its margins, and
  /// its text has some six points.
  int width = 1920, height = 640;
  Theme theme = lightTheme();
  bool vector = false;  ///< SVG instead of PNG
};

inline constexpr double kDotsPerInch = 300.0;

/// time.png (stacked time per stage, a chart per mode; not without timings), counts.png (bodies,
/// contacts and events over time) and distance.png (from the reference); or the same as .svg.
std::vector<std::filesystem::path> chartFiles(const std::filesystem::path& folder, bool timings,
                                              bool vector);

/// Writes those files into the folder and returns their paths. Throws IoError.
std::vector<std::string> drawComparison(const Comparison& comparison,
                                        const std::filesystem::path& folder,
                                        const ChartStyle& style);

}  // namespace merge2d
