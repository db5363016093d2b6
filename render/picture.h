#pragma once
/// Pictures in memory.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/color.h"

namespace merge2d {

/// Rows from the top, straight (not premultiplied) RGBA.
struct Picture {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  std::vector<std::uint8_t> rgba;

  Picture() = default;
  /// Transparent.
  Picture(int w, int h)
      : width(w), height(h), rgba(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  Picture(int w, int h, Color fill) : Picture(w, h) {
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
      rgba[i] = fill.r, rgba[i + 1] = fill.g, rgba[i + 2] = fill.b, rgba[i + 3] = fill.a;
    }
  }

  std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x));
  }
  Color at(int x, int y) const {
    const std::uint8_t* p = rgba.data() + offset(x, y);
    return {p[0], p[1], p[2], p[3]};
  }
};

/// The next even number that is not smaller: H.264 wants even sizes.
constexpr int evenSize(int pixels) { return pixels + pixels % 2; }

}  // namespace merge2d
