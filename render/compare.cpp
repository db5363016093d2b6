#include "render/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "render/png.h"

namespace merge2d {
namespace {

/// The largest difference of a channel of one pixel.
int pixelDifference(const Picture& a, const Picture& b, std::size_t offset) {
  int largest = 0;
  for (std::size_t c = offset; c < offset + 4; ++c) {
    largest = std::max(largest, std::abs(int{a.rgba[c]} - int{b.rgba[c]}));
  }
  return largest;
}

}  // namespace

PictureDifference comparePictures(const Picture& a, const Picture& b, int tolerance) {
  PictureDifference out;
  out.same_size = a.width == b.width && a.height == b.height;
  if (!out.same_size) return {.same_size = false, .fraction = 1.0, .largest = 255};
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    const int difference = pixelDifference(a, b, i);
    out.largest = std::max(out.largest, difference);
    if (difference > tolerance) ++different;
  }
  const std::size_t pixels = std::max<std::size_t>(1, a.rgba.size() / 4);
  out.fraction = static_cast<double>(different) / static_cast<double>(pixels);
  return out;
}

Picture differencePicture(const Picture& a, const Picture& b, int tolerance) {
  Picture out(std::min(a.width, b.width), std::min(a.height, b.height));
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const Color p = a.at(x, y), q = b.at(x, y);
      const int difference = std::max(
          {std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b), std::abs(p.a - q.a)});
      const Color shown =
          difference > tolerance ? rgb(0xd00000) : mix(withAlpha(p, 1.0), rgb(0xffffff), 0.7);
      std::uint8_t* to = out.rgba.data() + out.offset(x, y);
      to[0] = shown.r, to[1] = shown.g, to[2] = shown.b, to[3] = 255;
    }
  }
  return out;
}

std::string compareWithReference(const Picture& picture, const std::filesystem::path& reference,
                                 const std::filesystem::path& out, double allowed_fraction) {
  std::filesystem::create_directories(out);
  const std::filesystem::path copy = out / reference.filename();
  if (!std::filesystem::exists(reference)) {
    savePng(copy, picture, {.alpha = true});
    return fmt::format("{} is missing; the picture is {}", reference.string(), copy.string());
  }
  const Picture expected = loadPng(reference);
  const PictureDifference found = comparePictures(expected, picture);
  if (found.same_size && found.fraction <= allowed_fraction) return {};
  savePng(copy, picture, {.alpha = true});
  std::filesystem::path where = copy;
  where.replace_extension(".difference.png");
  savePng(where, differencePicture(expected, picture));
  return fmt::format("{}: {:.2f}% of the pixels differ, by up to {} of 255; see {} and {}",
                     reference.string(), 100.0 * found.fraction, found.largest, copy.string(),
                     where.string());
}

}  // namespace merge2d
