#include "src2d/merging/parts.h"

#include <gtest/gtest.h>

#include "src2d/world.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

/// Takes each weld of each collection away, one at a time, and asks both ways what still holds.
class EachWeldCut : public Observer {
 public:
  void afterStage(Stage stage, const State& state, const Scratch&) override {
    if (stage != Stage::Merge) return;
    for (const Collection& c : state.collections) {
      if (c.id == kNoCollection) continue;
      for (std::size_t i = 0; i < c.welds.size(); ++i) {
        Collection without = c;
        without.welds[i].cut = true;
        const bool apart = fallsApart(state, without, partsWithoutCuts(state, without));
        const bool firm = holdsFirmly(state, without);
        EXPECT_FALSE(firm && apart) << "weld " << i << " of " << c.members.size() << " bodies";
        held += firm ? 1 : 0;
        parted += apart ? 1 : 0;
      }
    }
  }
  int held = 0, parted = 0;
};

TEST(Parts, WhatHoldsFirmlyDoesNotFallApart) {
  for (const Scene& scene : {wall(6, 5), column(5), pyramid(5)}) {
    EachWeldCut cut;
    World world(scene, {.mode = Mode::Merge, .timings = false});
    world.observe(&cut);
    for (int i = 0; i < 150; i++) world.step();
    EXPECT_GT(cut.held + cut.parted, 0);
  }
}

TEST(Parts, AWallHoldsFirmlyWithoutAnyOneWeldAndAColumnDoesNot) {
  const auto watched = [](const Scene& scene) {
    EachWeldCut cut;
    World world(scene, {.mode = Mode::Merge, .timings = false});
    for (int i = 0; i < 150; ++i) world.step();
    world.observe(&cut);
    world.step();
    return cut;
  };
  EXPECT_GT(watched(wall(6, 5)).held, 20);
  EXPECT_EQ(watched(column(5)).held, 0);
  EXPECT_EQ(watched(column(5)).parted, 5);
}

}  // namespace
}  // namespace merge2d
