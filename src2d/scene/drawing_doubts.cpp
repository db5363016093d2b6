#include "src2d/scene/drawing_doubts.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>

#include "src2d/scene/ink.h"

namespace merge2d {
namespace {

/// Pixels of one kind: the first of them, from the top, and how many there are.
struct Pixels {
  int x = 0, y = 0, count = 0;

  void add(int at_x, int at_y) {
    if (count++ == 0) x = at_x, y = at_y;
  }
};

/// "pixel (3, 0) of colour #f6f6f6 is taken as empty, but …"
std::string sentence(const Image& image, const Pixels& pixels, const std::string& but) {
  const Image::Pixel& p = image.at(pixels.x, pixels.y);
  const std::string more = pixels.count == 1 ? "" : fmt::format(" ({} such pixels)", pixels.count);
  return fmt::format("pixel ({}, {}) of colour #{:02x}{:02x}{:02x} is taken as {}, but is {}{}",
                     pixels.x, pixels.y, p.r, p.g, p.b, describe(inkOf(p)), but, more);
}

/// Whether it lies between its neighbours on both sides in a row, a column or a diagonal.
bool isBlendAt(const Image& image, int x, int y) {
  if (x == 0 || y == 0 || x + 1 == image.width || y + 1 == image.height) return false;
  for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1), std::pair(1, -1)})
    if (isBlend(image.at(x, y), image.at(x - dx, y - dy), image.at(x + dx, y + dy))) return true;
  return false;
}

}  // namespace

std::vector<std::string> doubtsAboutColours(const Image& image) {
  std::map<std::pair<Ink, Ink>, Pixels> doubtful;
  Pixels blends;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Image::Pixel& pixel = image.at(x, y);
      if (const auto other = doubtfulInk(pixel)) {
        doubtful[{inkOf(pixel), *other}].add(x, y);
      } else if (isBlendAt(image, x, y)) {
        blends.add(x, y);
      }
    }
  }
  std::vector<std::string> out;
  for (const auto& [inks, pixels] : doubtful) {
    out.push_back(sentence(image, pixels, fmt::format("nearly {}", describe(inks.second))));
  }
  if (blends.count > 0) {
    out.push_back(sentence(image, blends,
                           "a mixture of what is beside it: draw without smoothed borders "
                           "(anti-aliasing)"));
  }
  return out;
}

}  // namespace merge2d
