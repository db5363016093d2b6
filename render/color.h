#pragma once
/// Colours, and how well people can tell them apart.

#include <cstdint>

namespace merge2d {

/// Straight sRGB with alpha; the default is fully transparent.
struct Color {
  std::uint8_t r = 0, g = 0, b = 0, a = 0;

  friend bool operator==(const Color&, const Color&) = default;
};

/// An opaque colour from 0xRRGGBB.
constexpr Color rgb(std::uint32_t hex) {
  return {static_cast<std::uint8_t>(hex >> 16), static_cast<std::uint8_t>(hex >> 8 & 0xff),
          static_cast<std::uint8_t>(hex & 0xff), 255};
}

/// The same colour with the opacity `alpha` in [0, 1].
Color withAlpha(Color color, double alpha);

/// The point between `a` (t = 0) and `b` (t = 1), in sRGB.
Color mix(Color a, Color b, double t);

/// Relative luminance in [0, 1] (WCAG 2).
double luminance(Color color);

/// Contrast ratio from 1 to 21 (WCAG 2). Text wants 4.5, lines want 3.
double contrast(Color a, Color b);

/// How a colour looks to somebody without one kind of cone.
enum class Vision { Normal, Protanopia, Deuteranopia, Tritanopia };

/// CIE76 distance of two colours as seen with `vision`; about 2.3 is just noticeable side by side.
double difference(Color a, Color b, Vision vision = Vision::Normal);

}  // namespace merge2d
