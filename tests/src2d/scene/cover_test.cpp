#include "src2d/scene/cover.h"

#include <gtest/gtest.h>

#include <random>
#include <string_view>

namespace merge2d {
namespace {

/// Rows of '#' (filled) and '.' (empty).
Mask maskOf(const std::vector<std::string_view>& rows) {
  Mask mask(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      mask.set(x, y, rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#');
    }
  }
  return mask;
}

/// Each filled pixel lies in exactly one rectangle, and nothing else does.
void expectExactCover(const Mask& mask, const std::vector<PixelRect>& rects) {
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      int times = 0;
      for (const PixelRect& r : rects) {
        times += x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height ? 1 : 0;
      }
      ASSERT_EQ(times, mask.filled(x, y) ? 1 : 0) << x << ", " << y;
    }
  }
}

TEST(Cover, ARectangleIsOneRectangle) {
  const auto rects = coverByRectangles(maskOf({"####", "####"}));
  ASSERT_EQ(rects.size(), 1u);
  EXPECT_EQ(rects[0].width, 4);
  EXPECT_EQ(rects[0].height, 2);
}

TEST(Cover, SimpleLettersTakeFewRectangles) {
  const std::vector<std::pair<std::vector<std::string_view>, std::size_t>> letters = {
      {{"#..", "#..", "###"}, 2}, {{"#.#", "#.#", "###"}, 3}, {{"###", ".#.", ".#."}, 2},
      {{".#.", "###", ".#."}, 3}, {{"###", "#.#", "###"}, 4},
  };
  for (const auto& [rows, count] : letters) {
    const Mask mask = maskOf(rows);
    const auto rects = coverByRectangles(mask);
    EXPECT_EQ(rects.size(), count) << rows[0];
    expectExactCover(mask, rects);
  }
}

TEST(Cover, AFlatSideIsNotCutWhenThatCanBeHelped) {
  const Mask table = maskOf({"########", "########", "#......#", "#......#"});
  const auto rects = coverByRectangles(table);
  expectExactCover(table, rects);
  EXPECT_EQ(rects.size(), 3u);
  bool whole_top = false;
  for (const PixelRect& r : rects) whole_top |= r.y == 0 && r.width == 8;
  EXPECT_TRUE(whole_top);
}

TEST(Cover, SideCutsAreCounted) {
  const Mask mask = maskOf({"####", "####"});
  EXPECT_EQ(sideCuts(mask, {{0, 0, 4, 2}}), 0);
  EXPECT_EQ(sideCuts(mask, {{0, 0, 2, 2}, {2, 0, 2, 2}}), 2) << "above and below";
  EXPECT_EQ(sideCuts(mask, {{0, 0, 4, 1}, {0, 1, 4, 1}}), 2) << "left and right";
}

TEST(Cover, RandomMasksAreCoveredExactly) {
  std::mt19937_64 engine{7};
  for (int i = 0; i < 300; ++i) {
    Mask mask(1 + static_cast<int>(engine() % 12), 1 + static_cast<int>(engine() % 12));
    const auto chance = engine() % 100;
    for (int y = 0; y < mask.height(); ++y) {
      for (int x = 0; x < mask.width(); ++x) mask.set(x, y, engine() % 100 < chance);
    }
    expectExactCover(mask, coverByRectangles(mask));
  }
}

TEST(Cover, ALargeCheckerboardTakesNoLongTime) {
  Mask mask(1000, 1000);
  for (int y = 0; y < 1000; ++y) {
    for (int x = 0; x < 1000; ++x) mask.set(x, y, (x + y) % 2 == 0);
  }
  EXPECT_EQ(coverByRectangles(mask).size(), 500'000u);
}

}  // namespace
}  // namespace merge2d
