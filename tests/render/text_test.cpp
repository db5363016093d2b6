#include "render/text.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "src2d/core/error.h"

namespace merge2d {
namespace {

TEST(Text, DigitsAreAllOfOneWidth) {
  Text text;
  for (const char* digit : {"1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
    EXPECT_FLOAT_EQ(text.width(digit, {13}), text.width("0", {13}));
  }
}

TEST(Text, LettersBeyondAsciiAreOneGlyphEach) {
  Text text;
  std::vector<GlyphInstance> glyphs;
  text.set(glyphs, "λµ→", {14}, 0.0F, 20.0F, rgb(0));
  EXPECT_EQ(glyphs.size(), 3U);
}

TEST(Text, BytesThatAreNotUtf8AreShownAndDoNoHarm) {
  Text text;
  EXPECT_GT(text.width("a\xff\xc3", {13}), text.width("a", {13}));
  EXPECT_GT(text.width("\xe2\x82", {13}), 0.0F);
}

TEST(Text, ALongLineIsElidedToFit) {
  Text text;
  const std::string line = "Tower on a swinging platform, hit by a projectile";
  const std::string shown = text.elided(line, {13}, 120.0F);
  EXPECT_LE(text.width(shown, {13}), 120.0F);
  EXPECT_EQ(shown.substr(shown.size() - 3), "…");
  EXPECT_EQ(text.elided("short", {13}, 120.0F), "short");
  EXPECT_EQ(text.elided(line, {13}, 2.0F), "");
}

TEST(Text, GlyphsStandAtWholePixelsOnTheBaseline) {
  Text text;
  std::vector<GlyphInstance> glyphs;
  text.set(glyphs, "HH", {16}, 10.4F, 30.4F, rgb(0));
  ASSERT_EQ(glyphs.size(), 2U);
  EXPECT_EQ(glyphs[0].y + glyphs[0].height, 30);
  EXPECT_EQ(glyphs[0].height, text.capHeight({16}));
}

TEST(Text, TheAtlasGrowsWithoutMovingWhatIsThere) {
  Text text;
  std::vector<GlyphInstance> before, after;
  text.set(before, "A", {16}, 0.0F, 0.0F, rgb(0));
  for (int size = 10; size < 60; ++size) text.width("ABCDEFGHIJKLMNOPQRSTUVWXYZ", {size});
  text.set(after, "A", {16}, 0.0F, 0.0F, rgb(0));
  EXPECT_EQ(before[0].u, after[0].u);
  EXPECT_EQ(before[0].v, after[0].v);
  EXPECT_EQ(text.atlas().coverage.size(),
            static_cast<std::size_t>(text.atlas().height) * GlyphAtlas::kWidth);
}

TEST(FontFile, IsFound) {
  EXPECT_NO_THROW(fontFile(Weight::Regular));
  EXPECT_NO_THROW(fontFile(Weight::Bold));
}

}  // namespace
}  // namespace merge2d
