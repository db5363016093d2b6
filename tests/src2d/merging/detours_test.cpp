#include "src2d/merging/detours.h"

#include <gtest/gtest.h>

#include "src2d/merging/parts.h"
#include "tests/src2d/merging/merging_testing.h"

namespace merge2d {
namespace {

/// Takes each weld of each collection away, one at a time: what a way around it holds does not
/// part.
class EachWeldAvoided : public Observer {
 public:
  void afterStage(Stage stage, const State& state, const Scratch&) override {
    if (stage != Stage::Merge) return;
    for (const Collection& c : state.collections) {
      if (c.id == kNoCollection) continue;
      for (std::uint32_t i = 0; i < c.welds.size(); ++i) {
        Collection without = c;
        without.welds[i].cut = true;
        const bool apart = fallsApart(state, without, partsWithoutCuts(state, without));
        const bool held = heldByDetours(state, without, {&i, 1});
        EXPECT_FALSE(held && apart) << "weld " << i << " of " << c.members.size() << " bodies";
        avoided += held ? 1 : 0;
        ++welds;
      }
    }
  }
  int avoided = 0, welds = 0;
};

TEST(Detours, WhatAWayAroundHoldsDoesNotFallApart) {
  for (const Scene& scene : {wall(6, 5), column(5), pyramid(5)}) {
    EXPECT_GT(watched<EachWeldAvoided>(scene, 150).welds, 0);
  }
}

TEST(Detours, LeadAroundMostWeldsOfAWallAndNoneOfAColumn) {
  const EachWeldAvoided in_wall = watched<EachWeldAvoided>(wall(6, 5), 1);
  EXPECT_GT(in_wall.avoided, in_wall.welds / 2);
  const EachWeldAvoided in_column = watched<EachWeldAvoided>(column(5), 1);
  EXPECT_EQ(in_column.welds, 5);
  EXPECT_EQ(in_column.avoided, 0);
}

TEST(Detours, DoNotLeadThroughTheGround) {
  // A plank on two pillars: without the weld to one of them it hangs on the other.
  Scene scene = onGround();
  add(scene, box(0.4, 1, {-1, 0.5}));
  add(scene, box(0.4, 1, {1, 0.5}));
  add(scene, box(3, 0.2, {0, 1.1}));
  const EachWeldAvoided of_portal = watched<EachWeldAvoided>(scene, 1);
  EXPECT_EQ(of_portal.welds, 4);
  // The pillars' welds with the ground have a way around, by plank and other pillar; those of the
  // plank would need the ground.
  EXPECT_EQ(of_portal.avoided, 2);
}

}  // namespace
}  // namespace merge2d
