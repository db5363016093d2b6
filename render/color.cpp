/// Sources: WCAG 2.2 (relative luminance, contrast ratio); G. M. Machado, M. M. Oliveira,
/// L. A. F. Fernandes, "A Physiologically-based Model for Simulation of Color Vision Deficiency",
/// IEEE TVCG 15(6), 2009, matrices of severity 1.0; CIE 1976 L*a*b* with the D65 white point.

#include "render/color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace merge2d {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

constexpr Matrix kXyz = {{{0.4124564, 0.3575761, 0.1804375},
                          {0.2126729, 0.7151522, 0.0721750},
                          {0.0193339, 0.1191920, 0.9503041}}};
constexpr Triple kWhitePoint = {0.95047, 1.0, 1.08883};

constexpr std::array<Matrix, 4> kVision = {{
    {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
    {{{0.152286, 1.052583, -0.204868},
      {0.114503, 0.786281, 0.099216},
      {-0.003882, -0.048116, 1.051998}}},
    {{{0.367322, 0.860646, -0.227968},
      {0.280085, 0.672501, 0.047413},
      {-0.011820, 0.042940, 0.968881}}},
    {{{1.255528, -0.076749, -0.178779},
      {-0.078411, 0.930809, 0.147602},
      {0.004733, 0.691367, 0.303900}}},
}};

double linear(std::uint8_t channel) {
  const double x = channel / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

Triple linear(Color c) { return {linear(c.r), linear(c.g), linear(c.b)}; }

Triple operator*(const Matrix& m, const Triple& v) {
  Triple out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

Triple lab(Triple rgb) {
  for (double& x : rgb) x = std::clamp(x, 0.0, 1.0);
  Triple f = kXyz * rgb;
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = f[i] / kWhitePoint[i];
    f[i] = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  }
  return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

std::uint8_t toByte(double x) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0, 255.0)));
}

}  // namespace

Color withAlpha(Color color, double alpha) {
  color.a = toByte(255.0 * alpha);
  return color;
}

Color mix(Color a, Color b, double t) {
  return {toByte(a.r + t * (b.r - a.r)), toByte(a.g + t * (b.g - a.g)),
          toByte(a.b + t * (b.b - a.b)), toByte(a.a + t * (b.a - a.a))};
}

double luminance(Color color) { return (kXyz * linear(color))[1]; }

double contrast(Color a, Color b) {
  const double la = luminance(a), lb = luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

double difference(Color a, Color b, Vision vision) {
  const Matrix& m = kVision[static_cast<std::size_t>(vision)];
  const Triple p = lab(m * linear(a)), q = lab(m * linear(b));
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

}  // namespace merge2d
