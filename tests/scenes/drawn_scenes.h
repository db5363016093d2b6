#pragma once
/// Scenes as people draw them, drawn in a test: '#' is matter, 'b' pinned, 'e' pinned for two
/// seconds, 'r' a spring, 'c' an end of the ground's line. A pixel is 0.1 m.

#include <cctype>

#include "tests/scenes/drawing_testing.h"
#include "tests/src2d/scene/png_testing.h"
#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {

using Rows = std::vector<std::string>;

/// The lines of a drawing, of one length.
inline Rows rowsOf(const std::string& picture) {
  Rows rows;
  std::istringstream in(picture);
  for (std::string row; std::getline(in, row);) {
    if (!row.empty()) rows.push_back(row);
  }
  std::size_t width = 0;
  for (const std::string& row : rows) width = std::max(width, row.size());
  for (std::string& row : rows) row.resize(width, '.');
  return rows;
}

/// The bits of a pixel: red, green, blue.
inline std::string colorOf(char letter) {
  static const std::map<char, std::array<bool, 3>> kColors = {
      {'.', {true, true, true}},   {'#', {false, false, false}}, {'b', {false, false, true}},
      {'e', {false, true, false}}, {'r', {true, false, false}},  {'c', {false, true, true}}};
  std::string bits;
  for (const bool channel : kColors.at(letter)) bits += std::string(8, channel ? '1' : '0');
  return bits;
}

inline Scene drawn(const std::string& name, const Rows& rows) {
  const auto sample = [&](std::uint32_t x, std::uint32_t y) { return colorOf(rows[y][x]); };
  const std::string png = encodePng(static_cast<std::uint32_t>(rows[0].size()),
                                    static_cast<std::uint32_t>(rows.size()), {.color = 2}, sample);
  return loadScene(TemporaryFile(name + ".png", png).path().string());
}

/// A drawing over a pinned floor, from wall to wall.
inline Rows boxed(Rows rows) {
  const std::size_t width = rows[0].size();
  for (std::string& row : rows) row = "b." + row + ".b";
  rows.push_back("b" + std::string(width + 2, '.') + "b");
  rows.push_back(std::string(width + 4, 'b'));
  return rows;
}
inline Rows boxed(const std::string& picture) { return boxed(rowsOf(picture)); }

}  // namespace merge2d
