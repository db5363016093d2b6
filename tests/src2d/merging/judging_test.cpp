/// Judging only where something is new against judging everything from nothing in every step, and
/// how much is judged where nothing is new.

#include <fmt/format.h>

#include "src2d/collections/parts.h"
#include "src2d/cycles/held_groups.h"
#include "src2d/merging/ready_pairs.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

using Pairs = std::set<std::pair<BodyId, BodyId>>;

std::string listed(const Pairs& pairs) {
  std::string text;
  for (const auto& [a, b] : pairs) text += fmt::format("{}-{} ", index(a), index(b));
  return text;
}

/// The pairs among these that are held in one group.
Pairs heldOf(const State& state, const MergeGraph& graph, const std::vector<ReadyPair>& pairs) {
  const Groups group =
      heldGroups(graph.nodes(), graph.pinsOf(pairs), state.settings.merging.cycles);
  Pairs held;
  for (const ReadyPair& edge : pairs) {
    if (group[edge.node_a] == group[edge.node_b]) held.insert({edge.pair.a, edge.pair.b});
  }
  return held;
}

/// Judges all that there is, before Merge.
class FullJudge : public Observer {
 public:
  void afterStage(Stage stage, const State& state, const Scratch& scratch) override {
    if (stage == Stage::AdvancePositions) beforeMerge(state, scratch);
    if (stage == Stage::Merge) afterMerge(state);
  }

  int refused = 0;   ///< pairs that were ready and not held, over all steps
  int left_out = 0;  ///< pairs that were ready and not judged again
  int welded = 0;

 private:
  /// What is judged gives what judging all ready pairs gives.
  void beforeMerge(const State& state, const Scratch& scratch) {
    Scratch own;
    own.pairs = scratch.pairs;
    const MergeGraph graph(state);
    listReadyPairs(state, own, graph);
    const std::vector<ReadyPair> judged = pairsToJudge(state, own, graph);
    full_ = heldOf(state, graph, own.ready);
    const Pairs some = heldOf(state, graph, judged);
    EXPECT_EQ(some, full_) << "step " << state.step << ": " << listed(some) << "instead of "
                           << listed(full_);
    ready_.clear();
    for (const ReadyPair& edge : own.ready) ready_.insert({edge.pair.a, edge.pair.b});
    refused += static_cast<int>(ready_.size() - full_.size());
    left_out += static_cast<int>(own.ready.size() - judged.size());
    welded += static_cast<int>(full_.size());
  }

  /// The stage did what full judging says.
  void afterMerge(const State& state) {
    for (const auto& [a, b] : ready_) {
      const Rigid &ra = state.rigid(a), &rb = state.rigid(b);
      const bool fixed = !ra.floating() && !rb.floating();
      if (fixed && ra.anchor != rb.anchor) continue;  // two frames never merge
      const bool together = &ra == &rb || (fixed && ra.anchor == rb.anchor);
      EXPECT_EQ(together, full_.contains({a, b}))
          << "step " << state.step << ": " << index(a) << " and " << index(b);
    }
  }

  Pairs ready_, full_;
};

/// Discs, boxes and triangles in a pit.
std::string pile(std::uint32_t seed) {
  std::uint32_t random = 2654435761u * (seed + 1);
  const auto unit = [&] {
    random = random * 1664525u + 1013904223u;
    return static_cast<double>(random >> 8u) / (1u << 24u);
  };
  std::string toml = kGround +
                     "[[body]]\nmotion = \"pinned\"\nat = [-3.5, 5]\nbox = [1, 12]\n"
                     "[[body]]\nmotion = \"pinned\"\nat = [3.5, 5]\nbox = [1, 12]\n";
  for (int i = 0; i < 40; ++i) {
    const double size = 0.5 + 0.4 * unit();
    toml += fmt::format("[[body]]\nat = [{}, {}]\nangle = {}\n", i % 5 * 1.1 - 2.2 + 0.1 * unit(),
                        0.7 + i / 5 * 1.1, 360.0 * unit());
    const double kind = unit();
    if (kind < 0.4) {
      toml += fmt::format("circle = {}\n", 0.5 * size);
    } else if (kind < 0.7) {
      toml += fmt::format("box = [{}, {}]\n", size, 0.7 * size);
    } else {
      toml +=
          fmt::format("polygon = [[-{0}, -{1}], [{0}, -{1}], [0, {0}]]\n", 0.5 * size, 0.3 * size);
    }
  }
  return toml;
}

struct Kind {
  std::string scene;  ///< built in, or empty: a pile
  std::uint32_t seed = 0;
  std::string criterion;

  Scene load() const {
    const Overrides overrides{{"merging.cycles", criterion}};
    return scene.empty() ? parseScene(pile(seed), "pile.toml", overrides)
                         : loadScene(scene, overrides);
  }
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << (kind.scene.empty() ? fmt::format("pile {}", kind.seed) : kind.scene) << ", "
       << kind.criterion;
}

class Judges : public testing::TestWithParam<Kind> {};

TEST_P(Judges, WhatIsNewGivesTheVerdictsOfJudgingEverything) {
  Simulation run(GetParam().load(), Mode::Merge);
  FullJudge judge;
  run.world().observe(&judge);
  run.steps(600, [&] {
    if (run.world().steps() % 150 == 0 && GetParam().scene.empty()) {  // and all over again
      run.world().applyImpulse(BodyId{10}, run.now().bodies[10].x, {1.0, 2.0});
    }
  });
  run.world().observe(nullptr);
  EXPECT_GT(judge.welded, 0);
  if (!GetParam().scene.empty()) return;
  EXPECT_GT(run.count(EventType::Unmerge), 0);
  if (GetParam().criterion == "off") {
    EXPECT_EQ(judge.refused, 0);
  } else {
    EXPECT_GT(judge.refused, 0);
    EXPECT_GT(judge.left_out, 0);
  }
}

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  for (const std::string criterion : {"off", "triangle", "rigid"}) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) all.push_back({"", seed, criterion});
    for (const std::string scene : {"truss-arch", "three-discs", "tripod", "planks", "ladder",
                                    "box-on-points", "tower-platform", "wagon", "ferry", "swing"}) {
      all.push_back({scene, 0, criterion});
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Judges, testing::ValuesIn(kinds()), [](const auto& of) {
  std::string name =
      of.param.scene.empty() ? fmt::format("pile_{}", of.param.seed) : of.param.scene;
  name += "_" + of.param.criterion;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// Steps in which something was judged, among the last `last` of `steps`.
int judgedSteps(const Scene& scene, int steps, int last, bool& refuses) {
  Simulation run(scene, Mode::Merge, true);
  int judged = 0;
  run.steps(steps, [&] {
    if (run.world().steps() <= steps - last) return;
    judged += run.world().notes().judged > 0 ? 1 : 0;
    for (const Decision& d : run.world().notes().decisions) {
      refuses |= d.stage == "Merge" && d.criterion == "cycle" && d.verdict == "wait";
    }
  });
  return judged;
}

TEST(Judging, JudgesNothingWhereNothingIsNew) {
  for (const std::string scene : {"truss-arch", "tripod", "box-on-points", "planks"}) {
    for (const std::string criterion : {"off", "triangle", "rigid"}) {
      bool refuses = false;
      EXPECT_EQ(judgedSteps(loadScene(scene, {{"merging.cycles", criterion}}), 1000, 200, refuses),
                0)
          << scene << ", " << criterion;
    }
  }
}

TEST(Judging, APairThatStaysRefusedIsJudgedOnce) {
  // A disc on the ground is ready, and free to roll.
  const Scene scene = parseScene(kGround + R"(
[[body]]
at = [0, 0.5]
circle = 0.5
)",
                                 "disc.toml");
  bool refuses = false;
  EXPECT_EQ(judgedSteps(scene, 300, 250, refuses), 0);
  EXPECT_TRUE(refuses);
  EXPECT_EQ(judgedSteps(scene, 300, 300, refuses), 1);
}

}  // namespace
}  // namespace merge2d
