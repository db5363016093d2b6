#include "src2d/merging/cycles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace merge2d {
namespace {

using testing::ElementsAre;
using Edges = std::vector<ContactEdge>;

std::vector<std::uint32_t> triangle(std::uint32_t nodes, const Edges& edges) {
  return rigidGroups(nodes, edges, CycleCriterion::Triangle);
}

TEST(Cycles, TwoContactsHold) { EXPECT_THAT(triangle(2, {{0, 1, 2}}), ElementsAre(0, 0)); }

TEST(Cycles, OneContactIsAPivot) { EXPECT_THAT(triangle(2, {{0, 1, 1}}), ElementsAre(0, 1)); }

TEST(Cycles, OneContactHoldsWhenTheCriterionIsOff) {
  EXPECT_THAT(rigidGroups(3, Edges{{0, 1, 1}}, CycleCriterion::Off), ElementsAre(0, 0, 2));
}

TEST(Cycles, ThreeBodiesOfOneContactEachHold) {
  EXPECT_THAT(triangle(4, {{0, 1, 1}, {1, 2, 1}, {0, 2, 1}}), ElementsAre(0, 0, 0, 3));
}

TEST(Cycles, FourBodiesInASquareDoNot) {
  EXPECT_THAT(triangle(4, {{0, 1, 1}, {1, 2, 1}, {2, 3, 1}, {0, 3, 1}}), ElementsAre(0, 1, 2, 3));
}

TEST(Cycles, ASquareWithOneFirmSideIsATriangle) {
  EXPECT_THAT(triangle(4, {{0, 1, 2}, {1, 2, 1}, {2, 3, 1}, {0, 3, 1}}), ElementsAre(0, 0, 0, 0));
}

TEST(Cycles, SingleContactsOfOneBodyWithAFirmGroupAddUp) {
  // A disc in a groove of two boxes that are welded to each other.
  EXPECT_THAT(triangle(3, {{0, 1, 2}, {0, 2, 1}, {1, 2, 1}}), ElementsAre(0, 0, 0));
  // Two contacts of a pair in two entries are two contacts.
  EXPECT_THAT(triangle(2, {{0, 1, 1}, {1, 0, 1}}), ElementsAre(0, 0));
}

TEST(Cycles, TrianglesInARowGrowOneGroup) {
  EXPECT_THAT(triangle(5, {{0, 1, 1}, {1, 2, 1}, {0, 2, 1}, {2, 3, 1}, {1, 3, 1}, {3, 4, 1}}),
              ElementsAre(0, 0, 0, 0, 4));
}

TEST(Cycles, OfNothingAreSingleBodies) { EXPECT_THAT(triangle(3, {}), ElementsAre(0, 1, 2)); }

Edges anyEdges(std::uint32_t nodes) {
  Edges edges(*rc::gen::inRange<std::size_t>(0, 14));
  for (ContactEdge& e : edges) {
    e.a = *rc::gen::inRange<std::uint32_t>(0, nodes);
    e.b = *rc::gen::inRange<std::uint32_t>(0, nodes);
    e.contacts = *rc::gen::inRange(1, 3);
  }
  return edges;
}

RC_GTEST_PROP(Cycles, DoNotDependOnTheOrderOfTheContacts, ()) {
  const auto nodes = *rc::gen::inRange<std::uint32_t>(2, 8);
  Edges edges = anyEdges(nodes);
  const auto groups = triangle(nodes, edges);
  std::reverse(edges.begin(), edges.end());
  for (ContactEdge& e : edges) std::swap(e.a, e.b);
  RC_ASSERT(triangle(nodes, edges) == groups);
}

RC_GTEST_PROP(Cycles, OneMoreContactNeverPartsAGroup, ()) {
  const auto nodes = *rc::gen::inRange<std::uint32_t>(2, 8);
  Edges edges = anyEdges(nodes);
  const auto before = triangle(nodes, edges);
  edges.push_back({0, nodes - 1, 1});
  const auto after = triangle(nodes, edges);
  for (std::uint32_t a = 0; a < nodes; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      RC_ASSERT(before[a] != before[b] || after[a] == after[b]);
    }
  }
}

RC_GTEST_PROP(Cycles, EachGroupIsNamedByItsSmallestNode, ()) {
  const auto nodes = *rc::gen::inRange<std::uint32_t>(2, 8);
  const auto groups = triangle(nodes, anyEdges(nodes));
  for (std::uint32_t n = 0; n < nodes; ++n) {
    RC_ASSERT(groups[n] <= n);
    RC_ASSERT(groups[groups[n]] == groups[n]);
  }
}

}  // namespace
}  // namespace merge2d
