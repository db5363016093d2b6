#pragma once
/// Pictures as the drawn scenes need them.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace merge2d {

/// Eight bits per channel, not multiplied by alpha; rows from the top.
struct Image {
  struct Pixel {
    std::uint8_t r = 255, g = 255, b = 255, a = 255;
  };
  int width = 0;
  int height = 0;
  std::vector<Pixel> pixels;

  const Pixel& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// "PNG", "JPEG", "GIF", "BMP" or "WebP" by the first bytes, whatever the file is called; empty for
/// anything else.
std::string_view pictureKind(std::string_view bytes);

/// Any PNG: grey, palette, 16 bits, interlaced. Throws an InputError that begins with `name` when
/// the bytes are not a whole PNG, or when it has more than `SceneLimits::kDrawingPixels`; that is
/// known before anything is allocated.
Image decodePng(const std::string& bytes, const std::string& name);

}  // namespace merge2d
