#include "render/color.h"

#include <gtest/gtest.h>

namespace merge2d {
namespace {

TEST(Color, BlackOnWhiteHasTheLargestContrast) {
  EXPECT_NEAR(contrast(rgb(0x000000), rgb(0xffffff)), 21.0, 1e-4);
  EXPECT_NEAR(contrast(rgb(0xffffff), rgb(0x000000)), 21.0, 1e-4);
  EXPECT_DOUBLE_EQ(contrast(rgb(0x336699), rgb(0x336699)), 1.0);
}

TEST(Color, ContrastAgreesWithPublishedValues) {
  // #767676 is the lightest grey that passes for text on white.
  EXPECT_NEAR(contrast(rgb(0x767676), rgb(0xffffff)), 4.54, 0.01);
  EXPECT_NEAR(contrast(rgb(0xff0000), rgb(0xffffff)), 4.00, 0.01);
}

TEST(Color, MixingStartsAtTheFirstAndEndsAtTheSecond) {
  EXPECT_EQ(mix(rgb(0x102030), rgb(0xf0e0d0), 0.0), rgb(0x102030));
  EXPECT_EQ(mix(rgb(0x102030), rgb(0xf0e0d0), 1.0), rgb(0xf0e0d0));
  EXPECT_EQ(mix(rgb(0x000000), rgb(0xffffff), 0.5), rgb(0x808080));
}

TEST(Color, BlackAndWhiteAreAHundredApartForEveryone) {
  for (const Vision vision :
       {Vision::Normal, Vision::Protanopia, Vision::Deuteranopia, Vision::Tritanopia}) {
    EXPECT_NEAR(difference(rgb(0x000000), rgb(0xffffff), vision), 100.0, 0.1);
  }
}

TEST(Color, RedAndGreenComeTogetherWithoutTheirCones) {
  const Color red = rgb(0xb00000), green = rgb(0x606000);
  EXPECT_LT(difference(red, green, Vision::Deuteranopia), 0.5 * difference(red, green));
  EXPECT_GT(difference(red, green, Vision::Tritanopia), 0.5 * difference(red, green));
}

}  // namespace
}  // namespace merge2d
