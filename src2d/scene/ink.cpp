#include "src2d/scene/ink.h"

#include <algorithm>
#include <cmath>

namespace merge2d {
namespace {

/// From 0 to 1.
struct Color {
  double r, g, b;
};

/// The colour as seen on white paper.
Color onPaper(const Image::Pixel& p) {
  const double alpha = p.a / 255.0;
  const auto channel = [alpha](std::uint8_t value) { return 1 - alpha * (1 - value / 255.0); };
  return {channel(p.r), channel(p.g), channel(p.b)};
}

/// How far a colour may be from what it is compared with.
struct Tolerance {
  double white;   ///< distance from white
  double pure;    ///< distance from red, magenta, yellow and cyan
  double equal;   ///< difference of the two lower channels of blue and green
  double excess;  ///< least excess of their highest channel
};
constexpr Tolerance kUsual{0.05, 0.05, 0.05, 0.05};
constexpr Tolerance kStrict{0.02, 0.02, 0.02, 0.15};
constexpr Tolerance kLoose{0.1, 0.15, 0.1, 0.02};

double distance(const Color& c, const Color& d) {
  return std::max({std::abs(c.r - d.r), std::abs(c.g - d.g), std::abs(c.b - d.b)});
}

/// `high` exceeds `low1` and `low2`, which are equal.
bool stands(double high, double low1, double low2, const Tolerance& tolerance) {
  return std::abs(low1 - low2) <= tolerance.equal && high - std::max(low1, low2) > tolerance.excess;
}

Ink inkOf(const Color& c, const Tolerance& tolerance) {
  if (distance(c, {1, 1, 1}) <= tolerance.white) return Ink::Empty;
  if (distance(c, {1, 0, 0}) <= tolerance.pure) return Ink::Spring;
  if (distance(c, {1, 0, 1}) <= tolerance.pure) return Ink::Magnet;
  if (distance(c, {1, 1, 0}) <= tolerance.pure) return Ink::Joiner;
  if (distance(c, {0, 1, 1}) <= tolerance.pure) return Ink::Horizon;
  if (stands(c.b, c.r, c.g, tolerance)) return Ink::Pinned;
  if (stands(c.g, c.r, c.b, tolerance)) return Ink::Held;
  return Ink::Matter;
}

}  // namespace

Ink inkOf(const Image::Pixel& pixel) { return inkOf(onPaper(pixel), kUsual); }

std::optional<Ink> doubtfulInk(const Image::Pixel& pixel) {
  const Color color = onPaper(pixel);
  const Ink usual = inkOf(color, kUsual);
  for (const Tolerance& other : {kStrict, kLoose}) {
    if (inkOf(color, other) != usual) return inkOf(color, other);
  }
  return std::nullopt;
}

bool isBlend(const Image::Pixel& pixel, const Image::Pixel& one, const Image::Pixel& other) {
  const Ink ink = inkOf(pixel), a = inkOf(one), b = inkOf(other);
  if (a == b || ink == a || ink == b) return false;
  const Color p = onPaper(pixel), from = onPaper(one), to = onPaper(other);
  const double r = to.r - from.r, g = to.g - from.g, blue = to.b - from.b;
  const double part = (r * (p.r - from.r) + g * (p.g - from.g) + blue * (p.b - from.b)) /
                      (r * r + g * g + blue * blue);
  const Color on_line{from.r + part * r, from.g + part * g, from.b + part * blue};
  return part > 0.0 && part < 1.0 && distance(p, on_line) <= kUsual.pure;
}

double darkness(const Image::Pixel& pixel) {
  const Color c = onPaper(pixel);
  return std::clamp(1.0 - (0.30 * c.r + 0.59 * c.g + 0.11 * c.b), 0.0, 1.0);
}

std::string_view describe(Ink ink) {
  switch (ink) {
    case Ink::Empty:
      return "empty";
    case Ink::Matter:
      return "plain matter";
    case Ink::Pinned:
      return "pinned (blue)";
    case Ink::Held:
      return "pinned for a while (green)";
    case Ink::Spring:
      return "a spring (red)";
    case Ink::Magnet:
      return "a magnet (magenta)";
    case Ink::Joiner:
      return "a joint without matter (yellow)";
    case Ink::Horizon:
      return "the ground (cyan)";
  }
  return "?";
}

}  // namespace merge2d
