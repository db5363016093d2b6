#pragma once
/// Where the names of a chart's marks stand: in a few rows above the plot, each at its line.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace merge2d {

/// A mark's line, and its name at one side of it: `magnet on` begins at the line, and what would
/// leave the plot at the right ends there.
struct PlacedMark {
  static constexpr std::size_t kRows = 4;

  std::string name;       ///< as it is written
  float column = 0.0F;    ///< of the line [px]
  float start = 0.0F;     ///< of the name [px]
  float width = 0.0F;     ///< of the name [px]
  std::size_t row = 0;    ///< of the name, from below; the line is drawn up to it
  bool named = false;     ///< there was room for the name
  bool at_right = false;  ///< the name ends at the line
};

/// Finds the places of the names; the columns ascend. No name touches another, at a distance of
/// `gap`, or is crossed by a line. Where there is no room for all of a crowd, its first are named.
void placeNames(std::span<PlacedMark> marks, float left, float right, float gap);

/// The text, or its beginning and "…": at most so many characters.
std::string shortened(std::string_view text, std::size_t characters);

}  // namespace merge2d
