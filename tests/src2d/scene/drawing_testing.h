#pragma once
/// Drawn scenes for tests: the pictures are drawn here, letter by letter.

#include <string>
#include <vector>

#include "tests/src2d/scene/palette.h"
#include "tests/src2d/scene/png_testing.h"
#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {

using Rows = std::vector<std::string>;

inline std::string bits(unsigned value, int count) {
  std::string result;
  for (int i = count - 1; i >= 0; --i)
    result += ((value >> static_cast<unsigned>(i)) & 1u) != 0 ? '1' : '0';
  return result;
}

/// The PNG file of these pixels.
inline std::string encode(const Rows& rows, bool interlaced = false) {
  const auto sample = [&](std::uint32_t x, std::uint32_t y) {
    const Image::Pixel p = kColors.at(rows[y][x]);
    return bits(p.r, 8) + bits(p.g, 8) + bits(p.b, 8) + bits(p.a, 8);
  };
  return encodePng(static_cast<std::uint32_t>(rows[0].size()),
                   static_cast<std::uint32_t>(rows.size()), {.interlaced = interlaced}, sample);
}

inline Scene draw(const Rows& rows, const Overrides& overrides = {}) {
  const TemporaryFile file("drawn.png", encode(rows));
  return loadScene(file.path().string(), overrides);
}

/// The InputError of a file with these bytes; its name is shortened.
inline std::string drawingError(const std::string& bytes) {
  const TemporaryFile file("bad.png", bytes);
  try {
    loadScene(file.path().string());
  } catch (const InputError& error) {
    const std::string what = error.what();
    const std::string path = file.path().string();
    return what.starts_with(path) ? "bad.png" + what.substr(path.size()) : what;
  }
  return "no error";
}

}  // namespace merge2d
