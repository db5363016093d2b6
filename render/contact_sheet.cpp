#include "render/contact_sheet.h"

#include <algorithm>
#include <array>

namespace merge2d {
namespace {

/// The mean of a block of pixels; colours count by how opaque they are.
Color meanOf(const Picture& picture, int left, int top, int side) {
  std::array<int, 4> sum{};
  for (int y = top; y < top + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      const Color c = picture.at(x, y);
      sum[0] += c.r * c.a, sum[1] += c.g * c.a, sum[2] += c.b * c.a, sum[3] += c.a;
    }
  }
  if (sum[3] == 0) return {};
  const auto channel = [&](int total) {
    return static_cast<std::uint8_t>((total + sum[3] / 2) / sum[3]);
  };
  const int pixels = side * side;
  return {channel(sum[0]), channel(sum[1]), channel(sum[2]),
          static_cast<std::uint8_t>((sum[3] + pixels / 2) / pixels)};
}

void put(Picture& picture, int x, int y, Color color) {
  std::uint8_t* p = picture.rgba.data() + picture.offset(x, y);
  p[0] = color.r, p[1] = color.g, p[2] = color.b, p[3] = color.a;
}

}  // namespace

Picture shrunk(const Picture& picture, int width) {
  const int factor = std::max(1, (picture.width + width - 1) / width);
  if (factor == 1) return picture;
  Picture small(picture.width / factor, picture.height / factor);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      put(small, x, y, meanOf(picture, x * factor, y * factor, factor));
    }
  }
  return small;
}

Picture contactSheet(std::span<const Picture> pictures, int columns, Color background) {
  if (pictures.empty()) return {};
  const int count = static_cast<int>(pictures.size());
  const int across = std::min(columns, count), down = (count + columns - 1) / columns;
  const int width = pictures[0].width, height = pictures[0].height;
  Picture sheet(across * width + (across - 1) * kSheetGap, down * height + (down - 1) * kSheetGap,
                background);
  for (int i = 0; i < count; ++i) {
    const int left = i % columns * (width + kSheetGap), top = i / columns * (height + kSheetGap);
    const Picture& from = pictures[static_cast<std::size_t>(i)];
    for (int y = 0; y < height; ++y) {
      std::copy_n(from.rgba.begin() + static_cast<std::ptrdiff_t>(from.offset(0, y)), 4 * width,
                  sheet.rgba.begin() + static_cast<std::ptrdiff_t>(sheet.offset(left, top + y)));
    }
  }
  return sheet;
}

}  // namespace merge2d
