/// The same welds are found cut in step after step: what was found of them holds until something
/// else gives.

#include "src2d/merging/spare_welds.h"

#include <gtest/gtest.h>

#include "src2d/merging/weld_checks.h"
#include "src2d/world.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

/// Takes each weld of a standing wall away that others hold around, asks about it twice, and then
/// once more after a contact elsewhere has opened.
class EachWeldAskedTwice : public Observer {
 public:
  void afterStage(Stage stage, const State& state, const Scratch& scratch) override {
    if (stage != Stage::Unmerge) return;
    for (const Collection& c : state.collections) {
      if (c.id == kNoCollection) continue;
      for (std::uint32_t weld = 0; weld < c.welds.size(); ++weld) {
        Scratch own;
        own.sweep_u = scratch.sweep_u;
        own.disturbed = scratch.disturbed;
        ask(state, own, c, weld);
      }
    }
  }

  int held = 0, opened = 0;

 private:
  void ask(const State& state, Scratch& own, const Collection& c, std::uint32_t weld) {
    Collection without = c;
    without.judged = true;
    without.spare.clear();
    without.loosened.clear();
    without.stood.clear();
    without.welds[weld].cut = true;
    without.cut_welds = {weld};
    listOthers(state, own, without);
    ASSERT_EQ(own.others, without.cut_welds);
    if (losesAMember(without, own) || partsAtCuts(state, own, without, false)) return;
    ++held;
    listOthers(state, own, without);
    EXPECT_TRUE(own.others.empty()) << "nothing has changed";
    openOne(state, own, without, weld);
  }

  void openOne(const State& state, Scratch& own, Collection& c, std::uint32_t but) {
    for (std::uint32_t b = 0; b < c.active_blocks; ++b) {
      InternalContact& inner = c.contacts[c.block_contact[b]];
      if (inner.weld == but || !inner.watch[0].holds()) continue;
      c.blocks[b].lambda = {};
      c.watches[b].watch(true);
      inner.watch[0].opening = {1.0F, 1};  // [m/s], far too much
      WeldTest(state, own, c, false).testAll();
      ASSERT_TRUE(inner.watch[0].lost);
      listOthers(state, own, c);
      EXPECT_FALSE(own.others.empty()) << "another contact holds no more";
      ++opened;
      return;
    }
  }
};

TEST(SpareWelds, AreAskedAboutAgainOnceAContactHasOpened) {
  EachWeldAskedTwice twice;
  World world(wall(6, 5), {.mode = Mode::Merge, .timings = false});
  for (int i = 0; i < 150; ++i) world.step();
  world.observe(&twice);
  world.step();
  EXPECT_GT(twice.held, 10);
  EXPECT_EQ(twice.opened, twice.held);
}

}  // namespace
}  // namespace merge2d
