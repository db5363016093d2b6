#pragma once
/// How values are spread in a few groups, for studies: every value as a dot, and above them where
/// the middle half of them lies.

#include <functional>
#include <string>
#include <vector>

#include "render/painter.h"
#include "render/theme.h"

namespace merge2d {

struct Distribution {
  struct Group {
    std::string name{};
    Color color;
    std::vector<double> values{};
  };
  std::string title{}, x_label{};
  bool logarithmic = false;  ///< the axis; values that are not positive are left out
  std::function<std::string(double)> text{};  ///< of a number at the axis; default: its digits
  std::vector<Group> groups{};
};

/// How high a panel of so many groups should be, in design pixels.
float heightOf(const Distribution& distribution);

/// The values of a group at 0, 1/4, 1/2, 3/4 and 1 of them, in between by interpolation.
std::vector<double> quartiles(std::vector<double> values);

/// Draws into the panel. `unit`: design pixels to pixels.
void drawDistribution(Painter& painter, const Distribution& distribution, const Theme& theme,
                      const PixelBox& panel, float unit);

}  // namespace merge2d
