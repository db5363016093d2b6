#include "src2d/merging/grip.h"

#include <gtest/gtest.h>

#include <map>

#include "src2d/merging/limits.h"
#include "src2d/scene/load.h"
#include "src2d/world.h"

namespace merge2d {
namespace {

/// Compares what is kept of pivots and blocks with what would be found anew, after each test of the
/// welds.
class Bookkeeping : public Observer {
 public:
  void afterStage(Stage stage, const State& state, const Scratch&) override {
    if (stage != Stage::Unmerge) return;
    for (const Collection& c : state.collections) {
      if (c.id == kNoCollection || c.stale) continue;
      if (!c.pivots_stale) comparePivots(state, c);
      compareWatches(state, c);
    }
  }

  int pivots = 0, joined_or_left = 0;
  int silent = 0;  ///< points that carry nothing, as ever, in blocks that are not tested

 private:
  void comparePivots(const State& state, const Collection& c) {
    Collection anew = c;
    listPivots(state, anew);
    ASSERT_EQ(c.pivots.size(), anew.pivots.size()) << "step " << state.step;
    for (std::size_t i = 0; i < c.pivots.size(); ++i) {
      EXPECT_EQ(c.pivots[i].weld, anew.pivots[i].weld) << "step " << state.step;
      EXPECT_EQ(c.pivots[i].reach, anew.pivots[i].reach) << "step " << state.step;
    }
    pivots += static_cast<int>(c.pivots.size());
    const auto [before, first] = last_.try_emplace(c.id, c.welds.size(), c.pivots.size());
    const std::pair now(c.welds.size(), c.pivots.size());
    joined_or_left += now.first == before->second.first && now != before->second ? 1 : 0;
    before->second = now;
  }

  void compareWatches(const State& state, const Collection& c) {
    for (std::size_t b = 0; b < c.blocks.size(); ++b) {
      const InternalContact& inner = c.contacts[c.block_contact[b]];
      for (int i = 0; i < inner.count; ++i) {
        const bool active = inner.watch[static_cast<std::size_t>(i)].active;
        EXPECT_EQ(c.watches[b].active(i), active) << "step " << state.step << ", block " << b;
        silent += !active && !c.watches[b].watched() ? 1 : 0;
      }
      if (b >= c.active_blocks || c.watches[b].watched()) continue;
      EXPECT_FALSE(asksForTest(c.blocks[b], c.watches[b]))
          << "step " << state.step << ", block " << b;
    }
  }

  std::map<CollectionId, std::pair<std::size_t, std::size_t>> last_;  ///< welds and pivots
};

TEST(Grip, WhatIsKeptOfPivotsAndBlocksIsWhatWouldBeFoundAnew) {
  Bookkeeping books;
  World world(loadScene("pile"), {.mode = Mode::Merge, .timings = false});
  world.observe(&books);
  for (int i = 0; i < 1500; ++i) world.step();
  EXPECT_GT(books.pivots, 1000);
  EXPECT_GT(books.joined_or_left, 5);
  EXPECT_GT(books.silent, 100);
}

TEST(Limits, APointThatNeverCarriedAForceAsksForNothingUntilItDoes) {
  ContactBlock k;
  k.count = 2;
  k.mu = 0.5;
  k.lambda = {1.0, 0.0, 0.1, 0.0};
  BlockWatch watch;
  watch.activate(0);
  EXPECT_FALSE(asksForTest(k, watch));
  k.lambda = {1.0, 0.2, 0.1, 0.0};
  EXPECT_TRUE(asksForTest(k, watch)) << "it carries its first force";
  watch.activate(1);
  EXPECT_FALSE(asksForTest(k, watch));
  k.lambda = {1.0, 0.0, 0.1, 0.0};
  EXPECT_TRUE(asksForTest(k, watch)) << "and has lost it";
  k.lambda = {1.0, 0.2, 0.5, 0.0};
  EXPECT_TRUE(asksForTest(k, watch)) << "the other is on the edge of its cone";
}

}  // namespace
}  // namespace merge2d
