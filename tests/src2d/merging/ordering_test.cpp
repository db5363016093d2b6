#include "src2d/merging/ordering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

namespace merge2d {
namespace {

using testing::ElementsAre;
using Edges = std::vector<GraphEdge>;
using Indices = std::vector<std::uint32_t>;

Indices order(std::uint32_t nodes, const Edges& edges, const Indices& seeds) {
  return breadthFirst(nodes, edges, seeds);
}

//  0 ─0─ 1 ─1─ 2 ─2─ 3 ─3─ 4
const Edges kLine{{0, 1}, {1, 2}, {2, 3}, {3, 4}};

TEST(Ordering, WalksALineFromItsEnd) {
  EXPECT_THAT(order(5, kLine, {4}), ElementsAre(3, 2, 1, 0));
  EXPECT_THAT(order(5, kLine, {0}), ElementsAre(0, 1, 2, 3));
}

TEST(Ordering, WalksALineFromItsMiddleToBothSides) {
  EXPECT_THAT(order(5, kLine, {2}), ElementsAre(1, 2, 0, 3));
}

TEST(Ordering, WalksAStarFromItsCentreInTheOrderGiven) {
  const Edges star{{1, 0}, {0, 2}, {3, 0}, {0, 4}};
  EXPECT_THAT(order(5, star, {0}), ElementsAre(0, 1, 2, 3));
}

TEST(Ordering, WalksAStarFromALeaf) {
  const Edges star{{1, 0}, {0, 2}, {3, 0}, {0, 4}};
  EXPECT_THAT(order(5, star, {3}), ElementsAre(2, 0, 1, 3));
}

TEST(Ordering, TwoSeedsMeetHalfWay) {
  EXPECT_THAT(order(5, kLine, {0, 4}), ElementsAre(0, 3, 1, 2));
}

//  6 ─ 7 ─ 8        edges 0 … 5 are the rows, 6 … 11 the columns
//  3 ─ 4 ─ 5
//  0 ─ 1 ─ 2
const Edges kGrid{{0, 1}, {1, 2}, {3, 4}, {4, 5}, {6, 7}, {7, 8},
                  {0, 3}, {1, 4}, {2, 5}, {3, 6}, {4, 7}, {5, 8}};

TEST(Ordering, WalksAGridInRingsOfEqualDistance) {
  const Indices found = order(9, kGrid, {0});
  std::vector<int> distance;  // of the nearer end of each edge
  for (const std::uint32_t e : found) {
    const std::uint32_t near = std::min(kGrid[e].a, kGrid[e].b);
    distance.push_back(static_cast<int>(near % 3 + near / 3));
  }
  EXPECT_TRUE(std::is_sorted(distance.begin(), distance.end()));
  EXPECT_EQ(found.size(), kGrid.size());
}

TEST(Ordering, WhatTheWalkDoesNotReachFollowsInTheOrderGiven) {
  const Edges two{{3, 4}, {0, 1}, {4, 5}, {1, 2}};
  EXPECT_THAT(order(6, two, {2}), ElementsAre(3, 1, 0, 2));
  EXPECT_THAT(order(6, two, {}), ElementsAre(0, 1, 2, 3));
}

TEST(Ordering, GoesThroughTheGroundFromOneColumnToTheOther) {
  const Edges columns{{0, 3}, {3, 4}, {0, 1}, {1, 2}};
  EXPECT_THAT(order(5, columns, {2}), ElementsAre(3, 2, 0, 1));
  EXPECT_THAT(order(5, columns, {4}), ElementsAre(1, 0, 2, 3));
}

TEST(Ordering, OfAnEmptyGraphIsEmpty) {
  EXPECT_TRUE(order(3, {}, {1}).empty());
  EXPECT_TRUE(order(0, {}, {}).empty());
}

TEST(Ordering, SeedsGivenTwiceCountOnce) {
  EXPECT_EQ(order(5, kLine, {4, 4, 4}), order(5, kLine, {4}));
}

RC_GTEST_PROP(Ordering, TakesEachEdgeOnceAndNearEdgesFirst, ()) {
  const auto nodes = *rc::gen::inRange<std::uint32_t>(1, 12);
  const auto node = rc::gen::inRange<std::uint32_t>(0, nodes);
  Edges edges(*rc::gen::inRange<std::size_t>(0, 30));
  for (GraphEdge& e : edges) e = {*node, *node};
  const Indices seeds = *rc::gen::container<Indices>(node);
  const Indices found = order(nodes, edges, seeds);

  Indices sorted = found, all(edges.size());
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 0u);
  RC_ASSERT(sorted == all);

  // Distances by relaxation: independent of any queue.
  constexpr int kNever = 1000;
  std::vector<int> distance(nodes, kNever);
  for (const std::uint32_t s : seeds) distance[s] = 0;
  for (std::uint32_t round = 0; round < nodes; ++round) {
    for (const GraphEdge& e : edges) {
      distance[e.a] = std::min(distance[e.a], distance[e.b] + 1);
      distance[e.b] = std::min(distance[e.b], distance[e.a] + 1);
    }
  }
  std::vector<int> along;
  for (const std::uint32_t e : found) {
    along.push_back(std::min(distance[edges[e].a], distance[edges[e].b]));
  }
  RC_ASSERT(std::is_sorted(along.begin(), along.end()));
}

}  // namespace
}  // namespace merge2d
