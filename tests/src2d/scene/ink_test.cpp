/// What a colour of a drawing means.

#include "src2d/scene/ink.h"

#include <gtest/gtest.h>

#include "tests/src2d/scene/palette.h"

namespace merge2d {
namespace {

TEST(Ink, ColoursAreComparedWithATolerance) {
  EXPECT_EQ(inkOf({255, 10, 10, 255}), Ink::Spring);
  EXPECT_EQ(inkOf({255, 30, 30, 255}), Ink::Matter);
  EXPECT_EQ(inkOf({0, 0, 163, 255}), Ink::Pinned);
  EXPECT_EQ(inkOf({165, 243, 165, 255}), Ink::Held);
  EXPECT_EQ(inkOf({185, 122, 87, 255}), Ink::Matter);
  EXPECT_EQ(inkOf({250, 250, 250, 255}), Ink::Empty);
  EXPECT_EQ(inkOf({240, 240, 240, 255}), Ink::Matter);
}

TEST(Ink, PlainColoursAreNotDoubtful) {
  for (const auto& [letter, pixel] : kColors) {
    const bool doubtful = letter == 'w' || letter == 'q';
    EXPECT_EQ(doubtfulInk(pixel).has_value(), doubtful) << letter;
  }
}

}  // namespace
}  // namespace merge2d
