#include "src2d/cycles/rigid.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "src2d/cycles/pebble_game.h"
#include "src2d/cycles/triangle.h"
#include "tests/src2d/cycles/exact.h"

namespace merge2d {
namespace {

using Pins = std::vector<Pin>;

/// A few bodies and pins between them, some of them in places on a small grid, where degenerate
/// placements are frequent.
struct RandomGraph {
  std::uint32_t nodes = 0;
  Pins pins;

  RandomGraph(std::uint64_t seed, std::uint32_t grid) {
    std::mt19937_64 random(seed);
    const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
    nodes = 2 + below(6);
    pins.resize(below(2 * nodes + 1));
    for (Pin& p : pins) {
      p.a = below(nodes);
      p.b = (p.a + 1 + below(nodes - 1)) % nodes;
      p.placed = grid > 0;
      if (p.placed) p.at = {below(grid), below(grid)};
    }
  }
};

std::string describe(const RandomGraph& graph) {
  std::string text;
  for (const Pin& p : graph.pins) {
    text += fmt::format("{} {} 1 {},{}\n", p.a, p.b, p.at.x(), p.at.y());
  }
  return text;
}

bool refines(const Groups& finer, const Groups& coarser) {
  for (std::size_t i = 0; i < finer.size(); ++i) {
    if (coarser[i] != coarser[finer[i]]) return false;
  }
  return true;
}

TEST(Rigid, ThePebbleGameAgreesWithTheExactRankOfARandomRealisation) {
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const RandomGraph graph(seed, 0);
    ASSERT_EQ(genericGroups(graph.nodes, graph.pins), exactGroups(graph.nodes, graph.pins))
        << describe(graph);
  }
}

TEST(Rigid, DegeneratePlacementsAgreeWithTheExactRank) {
  for (const std::uint32_t grid : {2u, 3u, 5u, 40u}) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
      const RandomGraph graph(seed, grid);
      ASSERT_EQ(rigidGroups(graph.nodes, graph.pins), exactGroups(graph.nodes, graph.pins))
          << describe(graph);
    }
  }
}

RandomGraph anyGraph() {
  return {*rc::gen::arbitrary<std::uint64_t>(), *rc::gen::inRange<std::uint32_t>(0, 5)};
}

RC_GTEST_PROP(Rigid, DoesNotDependOnTheOrderOfTheContacts, ()) {
  RandomGraph graph = anyGraph();
  const auto groups = rigidGroups(graph.nodes, graph.pins);
  std::shuffle(graph.pins.begin(), graph.pins.end(),
               std::mt19937(*rc::gen::arbitrary<std::uint32_t>()));
  for (Pin& p : graph.pins) std::swap(p.a, p.b);
  RC_ASSERT(rigidGroups(graph.nodes, graph.pins) == groups);
}

RC_GTEST_PROP(Rigid, DoesNotDependOnTheNumbersOfTheBodies, ()) {
  const RandomGraph graph = anyGraph();
  const auto groups = rigidGroups(graph.nodes, graph.pins);
  Pins renamed = graph.pins;
  const auto rename = [&](std::uint32_t n) { return graph.nodes - 1 - n; };
  for (Pin& p : renamed) {
    p.a = rename(p.a);
    p.b = rename(p.b);
  }
  const auto again = rigidGroups(graph.nodes, renamed);
  for (std::uint32_t a = 0; a < graph.nodes; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      RC_ASSERT((groups[a] == groups[b]) == (again[rename(a)] == again[rename(b)]));
    }
  }
}

RC_GTEST_PROP(Rigid, OneMoreContactNeverPartsAGroup, ()) {
  RandomGraph graph = anyGraph();
  const auto before = rigidGroups(graph.nodes, graph.pins);
  const auto triangle_before = triangleGroups(graph.nodes, graph.pins).groups;
  Pin more = RandomGraph(*rc::gen::arbitrary<std::uint64_t>(), 4).pins.empty()
                 ? Pin{.a = 0, .b = 1, .at = {1, 2}, .placed = true}
                 : Pin{.a = 0, .b = graph.nodes - 1, .at = {2, 1}, .placed = true};
  graph.pins.push_back(more);
  RC_ASSERT(refines(before, rigidGroups(graph.nodes, graph.pins)));
  RC_ASSERT(refines(triangle_before, triangleGroups(graph.nodes, graph.pins).groups));
}

RC_GTEST_PROP(Rigid, BreakingAContactAndAddingItAgainRestores, ()) {
  RandomGraph graph = anyGraph();
  if (graph.pins.empty()) return;
  const auto before = rigidGroups(graph.nodes, graph.pins);
  const auto broken = *rc::gen::inRange<std::size_t>(0, graph.pins.size());
  const Pin pin = graph.pins[broken];
  graph.pins.erase(graph.pins.begin() + static_cast<std::ptrdiff_t>(broken));
  RC_ASSERT(refines(rigidGroups(graph.nodes, graph.pins), before));
  graph.pins.push_back(pin);
  RC_ASSERT(rigidGroups(graph.nodes, graph.pins) == before);
}

RC_GTEST_PROP(Rigid, IncludesWhatTheTriangleCriterionFinds, ()) {
  const RandomGraph graph = anyGraph();
  RC_ASSERT(refines(triangleGroups(graph.nodes, graph.pins).groups,
                    genericGroups(graph.nodes, graph.pins)));
}

RC_GTEST_PROP(Rigid, APlacementNeverHoldsMoreThanAGeneralOne, ()) {
  const RandomGraph graph = anyGraph();
  RC_ASSERT(refines(rigidGroups(graph.nodes, graph.pins), genericGroups(graph.nodes, graph.pins)));
}

/// A rectangular grid of bodies, each pinned to its four neighbours: rigid only as a whole.
Pins grid(std::uint32_t side, bool skew) {
  std::mt19937_64 random(5);
  const auto shift = [&] {
    return skew ? 0.3 * (static_cast<double>(random() >> 11u) * 0x1p-53) : 0;
  };
  Pins pins;
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const std::uint32_t id = i * side + j;
      if (i + 1 < side) pins.push_back({id, id + side, {i + 0.5, j + shift()}, true});
      if (j + 1 < side) pins.push_back({id, id + 1, {i + shift(), j + 0.5}, true});
    }
  }
  return pins;
}

TEST(Rigid, ASkewGridIsRigidAsAWhole) {
  EXPECT_EQ(rigidGroups(900, grid(30, true)), Groups(900, 0));
}

/// In a grid without skew every body can turn against its neighbours, each the other way.
TEST(Rigid, ASquareGridTurnsInItself) {
  Groups single(900);
  for (std::uint32_t i = 0; i < 900; ++i) single[i] = i;
  EXPECT_EQ(genericGroups(900, grid(30, false)), Groups(900, 0));
  EXPECT_EQ(rigidGroups(900, grid(30, false)), single);
}

TEST(Rigid, TakesAsMuchNothingAsItGets) {
  EXPECT_EQ(rigidGroups(0, {}), Groups{});
  EXPECT_EQ(rigidGroups(2, {}), (Groups{0, 1}));
  EXPECT_EQ(rigidGroups(1, Pins{{0, 0, {1, 1}, true}}), Groups{0});
}

}  // namespace
}  // namespace merge2d
