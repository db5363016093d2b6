#include "src2d/core/trig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace merge2d {
namespace {

/// The distance from the exact value, in units of the last place of the rounded one.
double unitsOff(double value, long double exact) {
  const double rounded = static_cast<double>(exact);
  const double unit = std::nextafter(std::abs(rounded), 1e300) - std::abs(rounded);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) / unit);
}

/// Angles of every size up to `largest`, and as many that lie evenly.
template <class Check>
void forAngles(double largest, int count, Check&& check) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> even(-largest, largest), power(-60.0, std::log2(largest));
  for (int i = 0; i < count; ++i) {
    check(even(random));
    const double size = std::exp2(power(random));
    check(i % 2 == 0 ? size : -size);
  }
}

double worst(double largest, int count) {
  double most = 0.0;
  forAngles(largest, count, [&](double a) {
    const SineCosine got = sineCosine(a);
    const auto exact = static_cast<long double>(a);
    most = std::max({most, unitsOff(got.s, sinl(exact)), unitsOff(got.c, cosl(exact))});
  });
  return most;
}

TEST(Trig, AMillionSinesAndCosinesAreWithinTheirBound) {
  EXPECT_LT(worst(4.0, 250'000), 0.8);
  EXPECT_LT(worst(1e6, 250'000), 0.8);
}

TEST(Trig, SinesOfHugeAnglesAreAsExact) {
  EXPECT_LT(worst(1e17, 50'000), 0.8);  // x87 reduces exactly enough up to 2^63
  for (const double angle : {1e22, -1e100, 1e300, 0x1.8p1023}) {
    EXPECT_LE(unitsOff(sineCosine(angle).s, std::sin(angle)), 1.0) << angle;
    EXPECT_LE(unitsOff(sineCosine(angle).c, std::cos(angle)), 1.0) << angle;
  }
}

/// The double nearest to a multiple of π/2 of all doubles.
TEST(Trig, ASineNextToZeroKeepsItsDigits) {
  const double hardest = 0x1.6ac5b262ca1ffp849;
  EXPECT_EQ(sineCosine(hardest).c, std::cos(hardest));
  EXPECT_EQ(sineCosine(std::numbers::pi).s, 1.2246467991473532e-16);
  EXPECT_EQ(sineCosine(std::numbers::pi / 2).c, 6.123233995736766e-17);
}

TEST(Trig, SinesOfQuarterTurnsAndOfNothing) {
  EXPECT_EQ(sineCosine(0.0).s, 0.0);
  EXPECT_TRUE(std::signbit(sineCosine(-0.0).s));
  EXPECT_EQ(sineCosine(0.0).c, 1.0);
  EXPECT_EQ(sineCosine(std::numbers::pi / 2).s, 1.0);
  EXPECT_EQ(sineCosine(std::numbers::pi).c, -1.0);
  EXPECT_EQ(sineCosine(-std::numbers::pi / 2).s, -1.0);
  EXPECT_TRUE(std::isnan(sineCosine(INFINITY).s));
  EXPECT_TRUE(std::isnan(sineCosine(NAN).c));
}

TEST(Trig, AMillionArcTangentsAreWithinTheirBound) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> even(-1.0, 1.0), power(-40.0, 40.0);
  double most = 0.0;
  for (int i = 0; i < 1'000'000; ++i) {
    double y = even(random), x = even(random);
    if (i % 2 == 1) y *= std::exp2(power(random));
    const long double exact = atan2l(static_cast<long double>(y), static_cast<long double>(x));
    most = std::max(most, unitsOff(arcTangent(y, x), exact));
  }
  EXPECT_LT(most, 0.55);
}

TEST(Trig, ArcTangentsOnTheAxesAreThoseOfTheCLibrary) {
  const double values[] = {0.0, -0.0, 1.0, -1.0, 5e-324, -1.7e308, INFINITY, -INFINITY};
  for (const double y : values) {
    for (const double x : values) {
      EXPECT_EQ(arcTangent(y, x), std::atan2(y, x)) << y << " " << x;
      EXPECT_EQ(std::signbit(arcTangent(y, x)), std::signbit(std::atan2(y, x))) << y << " " << x;
    }
  }
  EXPECT_TRUE(std::isnan(arcTangent(NAN, 1.0)));
}

TEST(Trig, TheArcTangentUndoesSineAndCosine) {
  forAngles(3.1, 10'000, [](double a) {
    const SineCosine sc = sineCosine(a);
    EXPECT_NEAR(arcTangent(sc.s, sc.c), a, 1e-15);
  });
}

}  // namespace
}  // namespace merge2d
