#pragma once
/// Sine, cosine and arc tangent. Those of C libraries differ in the last place from one library,
/// compiler or processor to the next, and a run would differ with them.
///
/// Errors: below 0.8 units in the last place, 0.55 for the arc tangent; the tests compare a million
/// values of each function with long double. The series are Taylor's, on intervals so short that
/// the terms left out are below a thousandth of a unit.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace merge2d {

struct SineCosine {
  double s = 0.0, c = 1.0;
};

namespace trig {

/// A number as the sum of two doubles, the second below the last place of the first.
struct Pair {
  double high = 0.0, low = 0.0;
};

/// The exact sum of two doubles, the first being the larger one (Dekker 1971).
inline Pair exactSum(double large, double small) {
  const double sum = large + small;
  return {sum, small - (sum - large)};
}

/// The upper half of the digits of a double: products of such halves are exact (Veltkamp 1968).
inline double upperHalf(double a) {
  const double scaled = (0x1p27 + 1.0) * a;
  return scaled - (scaled - a);
}

/// The exact product of two doubles (Dekker 1971).
inline Pair exactProduct(double a, double b) {
  const double product = a * b;
  const double au = upperHalf(a), ad = a - au, bu = upperHalf(b), bd = b - bu;
  return {product, ((au * bu - product) + au * bd + ad * bu) + ad * bd};
}

/// An angle as a number of quarter turns, modulo 4, and the rest, within an eighth of a turn.
struct Reduced {
  Pair rest;
  unsigned quarters = 0;
};

/// Payne and Hanek 1983: the digits of angle · 2/π around the binary point, in integers.
[[gnu::cold, gnu::noinline]] inline Reduced reduceLarge(double angle) {
  // 2/π in binary.
  constexpr std::array<std::uint32_t, 40> kTwoOverPi = {
      0xA2F9836Eu, 0x4E441529u, 0xFC2757D1u, 0xF534DDC0u, 0xDB629599u, 0x3C439041u, 0xFE5163ABu,
      0xDEBBC561u, 0xB7246E3Au, 0x424DD2E0u, 0x06492EEAu, 0x09D1921Cu, 0xFE1DEB1Cu, 0xB129A73Eu,
      0xE88235F5u, 0x2EBB4484u, 0xE99C7026u, 0xB45F7E41u, 0x3991D639u, 0x835339F4u, 0x9C845F8Bu,
      0xBDF9283Bu, 0x1FF897FFu, 0xDE05980Fu, 0xEF2F118Bu, 0x5A0A6D1Fu, 0x6D367ECFu, 0x27CB09B7u,
      0x4F463F66u, 0x9E5FEA2Du, 0x7527BAC7u, 0xEBE5F17Bu, 0x3D0739F7u, 0x8A5292EAu, 0x6BFB5FB1u,
      0x1F8D5D08u, 0x56033046u, 0xFC7B6BABu, 0xF0CFBC20u, 0x9AF4361Du};
  constexpr std::size_t kWords = 7;
  const auto bits = std::bit_cast<std::uint64_t>(angle);
  const int exponent = static_cast<int>(bits >> 52 & 0x7FFu) - 1075;  // of the last digit
  const std::uint64_t digits = (bits & 0xFFFFFFFFFFFFFu) | 0x10000000000000u;
  // Words of 2/π further up give multiples of 4 quarters.
  const int skipped = exponent > 2 ? (exponent - 2) / 32 : 0;
  const int shift = exponent - 32 * skipped;  // below 34
  // The product, modulo 2^(32 · kWords), the lowest word first. Its last digit weighs
  // 2^(shift − 32 · kWords).
  std::array<std::uint32_t, kWords + 2> product{};
  for (std::size_t i = 0; i < kWords; ++i) {
    const std::uint64_t word = kTwoOverPi[static_cast<std::size_t>(skipped) + kWords - 1 - i];
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < 2; ++j) {
      const std::uint64_t half = j == 0 ? digits & 0xFFFFFFFFu : digits >> 32;
      carry += product[i + j] + word * half;
      product[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    product[i + 2] += static_cast<std::uint32_t>(carry);
  }
  // 64 digits from one that weighs 2^weight down to that place.
  const auto digitsFrom = [&](int weight) {
    std::uint64_t out = 0;
    for (int k = 0; k < 64; ++k) {
      const int at = weight - k - shift + 32 * static_cast<int>(kWords);
      const bool inside = at >= 0 && at < 32 * static_cast<int>(product.size());
      out = out << 1 | (inside ? product[static_cast<std::size_t>(at) / 32] >> (at % 32) & 1u : 0u);
    }
    return out;
  };
  unsigned quarters = static_cast<unsigned>(digitsFrom(63) & 3u);
  std::uint64_t upper = digitsFrom(-1), lower = digitsFrom(-65);
  const bool nearer = upper >> 63 != 0;  // to the next quarter
  if (nearer) {
    quarters += 1;
    lower = ~lower + 1;
    upper = ~upper + (lower == 0 ? 1 : 0);
  }
  // Three pieces of 40 digits, each exact as a double.
  const double first = std::ldexp(static_cast<double>(upper >> 24), -40);
  const double second =
      std::ldexp(static_cast<double>((upper & 0xFFFFFFu) << 16 | lower >> 48), -80);
  const double third = std::ldexp(static_cast<double>(lower << 16 >> 24), -120);
  const Pair tail = exactSum(second, third);
  const Pair turn = exactSum(first, tail.high);
  const Pair fraction = exactSum(turn.high, turn.low + tail.low);
  // Times π/2, exactly up to the second double.
  constexpr Pair kHalfPi{0x1.921fb54442d18p0, 0x1.1a62633145c07p-54};
  const Pair scaled = exactProduct(fraction.high, kHalfPi.high);
  Pair rest = exactSum(scaled.high,
                       scaled.low + (fraction.high * kHalfPi.low + fraction.low * kHalfPi.high));
  if (nearer) rest = {-rest.high, -rest.low};
  if (angle < 0.0) return {{-rest.high, -rest.low}, (4u - quarters) & 3u};
  return {rest, quarters & 3u};
}

/// Cody and Waite 1980: π/2 in parts whose products with a number below 2²⁰ are exact.
inline Reduced reduce(double angle) {
  constexpr double kLargest = 0x1p20;  // rad
  constexpr double kQuartersPerRadian = 0x1.45f306dc9c883p-1;
  constexpr std::array<double, 4> kHalfPi = {0x1.921fb544p0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69,
                                             0x1.b839a252049c1p-104};
  if (!(std::abs(angle) < kLargest)) return reduceLarge(angle);
  const double n = std::nearbyint(angle * kQuartersPerRadian);
  const double above = angle - n * kHalfPi[0], taken = n * kHalfPi[1];  // both exact
  const double rest = above - taken;
  const double part = above - rest;  // Knuth: either may be the larger one
  const double lost = (above - (rest + part)) + (part - taken);
  return {exactSum(rest, lost - (n * kHalfPi[2] + n * kHalfPi[3])),
          static_cast<unsigned>(static_cast<std::int64_t>(n)) & 3u};
}

/// (sin x − x) / x³ and cos x − 1 + x²/2, of z = x².
inline double sineTail(double z) {
  return -1.0 / 6 +
         z * (1.0 / 120 + z * (-1.0 / 5040 +
                               z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                        z * (1.0 / 6227020800 +
                                                             z * (-1.0 / 1307674368000 +
                                                                  z * (1.0 / 355687428096000)))))));
}
inline double cosineTail(double z) {
  return z * z *
         (1.0 / 24 +
          z * (-1.0 / 720 +
               z * (1.0 / 40320 +
                    z * (-1.0 / 3628800 +
                         z * (1.0 / 479001600 +
                              z * (-1.0 / 87178291200 +
                                   z * (1.0 / 20922789888000 + z * (-1.0 / 6402373705728000))))))));
}

/// Both within an eighth of a turn.
inline double sineOf(const Pair& x) {
  const double z = x.high * x.high;
  return x.high + (x.low * (1.0 - 0.5 * z) + x.high * z * sineTail(z));
}
inline double cosineOf(const Pair& x) {
  const Pair z = exactProduct(x.high, x.high);
  const Pair lead = exactSum(1.0, -0.5 * z.high);
  return lead.high + (lead.low + (cosineTail(z.high) - (x.high * x.low + 0.5 * z.low)));
}

/// (atan t − t) / t³, of z = t², for |t| up to 1/16.
inline double arcTail(double z) {
  return -1.0 / 3 +
         z * (1.0 / 5 +
              z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11 + z * (1.0 / 13 + z * (-1.0 / 15))))));
}

/// The arc whose tangent is small/large, for 0 <= small <= large: that of the nearest k/8, and the
/// one that is left.
inline Pair arcOf(double small, double large) {
  constexpr std::array<Pair, 9> kArcs = {{{0.0, 0.0},
                                          {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                          {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                          {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                          {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                          {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                          {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                          {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                          {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}};
  const double eighths = std::nearbyint(8.0 * (small / large)), k = 0.125 * eighths;
  // t = (small − k large) / (large + k small), its second double by a step of Newton. Products of k
  // and a half are exact.
  const double large_up = upperHalf(large), small_up = upperHalf(small);
  const double above = small - k * large_up, taken = k * (large - large_up);
  const double whole = large + k * small;
  const double whole_low = ((large - whole) + k * small_up) + k * (small - small_up);
  const double t = (above - taken) / whole;
  const Pair back = exactProduct(t, whole);
  const double missing = ((above - back.high) - taken) - back.low - t * whole_low;
  const double z = t * t;
  const Pair& arc = kArcs[static_cast<std::size_t>(eighths)];
  const Pair sum = exactSum(arc.high, t);
  const double rest = arc.low + (missing / whole + t * z * arcTail(z));
  return exactSum(sum.high, sum.low + rest);
}

}  // namespace trig

/// Sine and cosine of an angle [rad]; NaN when it is not finite.
inline SineCosine sineCosine(double angle) {
  if (!std::isfinite(angle)) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    return {kNaN, kNaN};
  }
  if (std::abs(angle) < 0x1p-27) return {angle, 1.0};  // and the sign of zero
  const trig::Reduced r = trig::reduce(angle);
  double s = trig::sineOf(r.rest), c = trig::cosineOf(r.rest);
  if (r.quarters % 2 == 1) s = std::exchange(c, -s);
  return r.quarters < 2 ? SineCosine{s, c} : SineCosine{-s, -c};
}

/// The angle of (x, y) from the x axis [rad], from −π to π; signs of zero count as in std::atan2.
inline double arcTangent(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  constexpr trig::Pair kPi{0x1.921fb54442d18p1, 0x1.1a62633145c07p-53};
  double ax = std::abs(x), ay = std::abs(y);
  if (std::isinf(ax) || std::isinf(ay)) {
    ax = std::isinf(ax) ? 1.0 : 0.0;
    ay = std::isinf(ay) ? 1.0 : 0.0;
  }
  // Far from the ends of the range, so that nothing overflows, nor loses digits.
  const double largest = std::max(ax, ay);
  const double scale = largest > 0x1p900 ? 0x1p-120 : largest < 0x1p-900 ? 0x1p120 : 1.0;
  ax *= scale;
  ay *= scale;
  trig::Pair arc;
  if (ay <= ax) {
    if (ay > 0.0) arc = trig::arcOf(ay, ax);
  } else {
    const trig::Pair other = ax > 0.0 ? trig::arcOf(ax, ay) : trig::Pair{};
    const trig::Pair sum = trig::exactSum(0.5 * kPi.high, -other.high);
    arc = trig::exactSum(sum.high, sum.low + (0.5 * kPi.low - other.low));
  }
  if (std::signbit(x)) {
    const trig::Pair sum = trig::exactSum(kPi.high, -arc.high);
    arc = trig::exactSum(sum.high, sum.low + (kPi.low - arc.low));
  }
  return std::copysign(arc.high + arc.low, y);
}

}  // namespace merge2d
