#pragma once
/// Sets of pixels as few rectangles.

#include <cstdint>
#include <vector>

namespace merge2d {

/// Which pixels of a small picture are filled; rows from the top.
class Mask {
 public:
  Mask(int width, int height)
      : width_(width),
        height_(height),
        filled_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  int width() const { return width_; }
  int height() const { return height_; }
  /// Outside everything is empty.
  bool filled(int x, int y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_ && filled_[at(x, y)] != 0;
  }
  void set(int x, int y, bool filled) { filled_[at(x, y)] = filled ? 1 : 0; }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_, height_;
  std::vector<std::uint8_t> filled_;
};

/// Pixels x … x + width − 1, y … y + height − 1.
struct PixelRect {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Rectangles without overlap that fill exactly the mask. Of a few ways to cut, the one that cuts
/// the fewest flat outer sides into pieces, since a body that lies on a flat side should lie on one
/// shape; then the one of fewest rectangles.
std::vector<PixelRect> coverByRectangles(const Mask& mask);

/// How many cuts between rectangles end on a flat outer side.
int sideCuts(const Mask& mask, const std::vector<PixelRect>& rectangles);

}  // namespace merge2d
