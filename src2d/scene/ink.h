#pragma once
/// The meaning of the colours of a drawn scene.

#include <optional>
#include <string_view>

#include "src2d/scene/image.h"

namespace merge2d {

enum class Ink {
  Empty,    ///< white, or transparent
  Matter,   ///< any other colour: the darker, the denser
  Pinned,   ///< blue: red equals green, both below blue
  Held,     ///< green: red equals blue, both below green
  Spring,   ///< red
  Magnet,   ///< magenta
  Joiner,   ///< yellow: connects, without matter
  Horizon,  ///< cyan: two of them span the ground
};

/// Colours are compared with a tolerance of 0.05 (of 1).
Ink inkOf(const Image::Pixel& pixel);

/// The other ink that the pixel might mean, when it is near the border of two.
std::optional<Ink> doubtfulInk(const Image::Pixel& pixel);

/// Whether a pixel of a third meaning lies between two others, as those of a smoothed border do.
bool isBlend(const Image::Pixel& pixel, const Image::Pixel& one, const Image::Pixel& other);

/// Mass relative to black, 1 - (0.30 r + 0.59 g + 0.11 b): between 0 and 1.
double darkness(const Image::Pixel& pixel);

/// "empty", "matter", "a spring", …
std::string_view describe(Ink ink);

}  // namespace merge2d
