#include "src2d/cycles/growth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "src2d/cycles/rigid.h"
#include "src2d/cycles/triangle.h"

namespace merge2d {
namespace {

using testing::Each;
using testing::ElementsAre;

constexpr PinRule kCounted;
constexpr PinRule kPlaced{.resolution = 1e-8};

Pin pin(std::uint32_t a, std::uint32_t b, double x, double y) { return {a, b, {x, y}, true}; }

TEST(Growth, ABodyWithTwoPinsOnTheGroupJoinsIt) {
  const std::vector<Pin> pins{pin(0, 1, 0, 0), pin(0, 1, 1, 0), pin(0, 2, 2, 0), pin(1, 2, 3, 1),
                              pin(2, 3, 5, 5)};
  EXPECT_THAT(grownGroup(4, pins, kCounted), ElementsAre(1, 1, 1, 0));
  EXPECT_THAT(grownGroup(4, pins, kPlaced), ElementsAre(1, 1, 1, 0));
}

TEST(Growth, TwoPinsInOneSpotAreOneWherePlacesCount) {
  const std::vector<Pin> pins{pin(0, 1, 2, 3), pin(0, 1, 2, 3)};
  EXPECT_THAT(grownGroup(2, pins, kCounted), ElementsAre(1, 1));
  EXPECT_THAT(grownGroup(2, pins, kPlaced), ElementsAre(1, 0));
}

TEST(Growth, TwoBodiesLinkedToTheGroupAndToEachOtherJoinIt) {
  const std::vector<Pin> pins{pin(0, 1, 0, 0), pin(0, 1, 4, 0), pin(0, 2, 0, 0), pin(0, 3, 1, 0),
                              pin(2, 3, 0.5, 1)};
  EXPECT_THAT(grownGroup(4, pins, kPlaced), Each(1));
}

TEST(Growth, UnlessTheThreePinsLieOnALine) {
  const std::vector<Pin> pins{pin(0, 1, 0, 1), pin(0, 1, 4, 0), pin(0, 2, 0, 0), pin(0, 3, 1, 0),
                              pin(2, 3, 0.5, 0)};
  EXPECT_THAT(grownGroup(4, pins, kPlaced), ElementsAre(1, 1, 0, 0));
  EXPECT_THAT(grownGroup(4, pins, kCounted), Each(1));
}

TEST(Growth, OfNothingIsNothing) {
  EXPECT_THAT(grownGroup(2, {}, kCounted), ElementsAre(0, 0));
  EXPECT_TRUE(grownGroup(0, {}, kCounted).empty());
}

/// What has grown is held together by the theory too.
RC_GTEST_PROP(Growth, StaysInsideOneGroup, ()) {
  const auto nodes = *rc::gen::inRange<std::uint32_t>(2, 12);
  std::vector<Pin> pins(*rc::gen::inRange<std::size_t>(0, 24));
  for (Pin& p : pins) {
    const auto a = *rc::gen::inRange<std::uint32_t>(0, nodes);
    const auto b = (a + *rc::gen::inRange<std::uint32_t>(1, nodes)) % nodes;
    p = pin(a, b, *rc::gen::inRange(0, 5), *rc::gen::inRange(0, 5));  // often degenerate
  }
  const auto together = [&](const std::vector<std::uint8_t>& inside, const Groups& groups) {
    std::uint32_t first = nodes;
    for (std::uint32_t i = 0; i < nodes; ++i) {
      if (inside[i] == 0) continue;
      if (first == nodes) first = groups[i];
      if (groups[i] != first) return false;
    }
    return true;
  };
  RC_ASSERT(together(grownGroup(nodes, pins, kCounted), triangleGroups(nodes, pins).groups));
  RC_ASSERT(together(grownGroup(nodes, pins, kPlaced), rigidGroups(nodes, pins)));
}

}  // namespace
}  // namespace merge2d
