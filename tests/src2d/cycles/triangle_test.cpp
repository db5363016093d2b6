#include "src2d/cycles/triangle.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace merge2d {
namespace {

using Pins = std::vector<Pin>;

/// The criterion word for word, with no thought of speed: count contacts between groups, contract
/// one pair or one triangle, begin again.
Groups wordForWord(std::uint32_t nodes, const Pins& pins) {
  Groups group(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) group[i] = i;
  const auto count = [&](std::uint32_t a, std::uint32_t b) {
    return std::count_if(pins.begin(), pins.end(), [&](const Pin& p) {
      return std::minmax(group[p.a], group[p.b]) == std::minmax(a, b);
    });
  };
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t from = std::max(a, b), to = std::min(a, b);
    std::replace(group.begin(), group.end(), from, to);
  };
  const auto contractOne = [&] {
    for (std::uint32_t a = 0; a < nodes; ++a) {
      for (std::uint32_t b = a + 1; b < nodes; ++b) {
        if (count(a, b) >= 2) return join(a, b), true;
        for (std::uint32_t c = b + 1; c < nodes; ++c) {
          if (count(a, b) && count(b, c) && count(a, c)) return join(a, b), join(a, c), true;
        }
      }
    }
    return false;
  };
  while (contractOne()) {
  }
  return group;
}

RC_GTEST_PROP(Triangle, DoesWhatItsDefinitionSays, ()) {
  const auto nodes = *rc::gen::inRange<std::uint32_t>(2, 9);
  Pins pins(*rc::gen::inRange<std::size_t>(0, 14));
  for (Pin& p : pins) {
    p.a = *rc::gen::inRange<std::uint32_t>(0, nodes);
    p.b = (p.a + *rc::gen::inRange<std::uint32_t>(1, nodes)) % nodes;
  }
  RC_ASSERT(triangleGroups(nodes, pins).groups == wordForWord(nodes, pins));
}

TEST(Triangle, ATriangleIsOneNodeOfTheNext) {
  // 0, 1, 2 close a cycle; with 3 and 4 their group closes another, of one contact between each.
  const Pins pins{{0, 1}, {1, 2}, {0, 2}, {2, 3}, {3, 4}, {4, 0}};
  EXPECT_EQ(triangleGroups(5, pins).groups, Groups(5, 0));
  EXPECT_EQ(triangleGroups(5, pins).cycles.size(), 2u);
}

TEST(Triangle, LosingOneContactLosesWhatDependedOnIt) {
  const Pins pins{{1, 2}, {0, 2}, {2, 3}, {3, 4}, {4, 0}};  // as above without {0, 1}
  EXPECT_EQ(triangleGroups(5, pins).groups, (Groups{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace merge2d
