#include "src2d/merging/parts.h"

#include <gtest/gtest.h>

#include "src2d/merging/cycles.h"
#include "src2d/merging/grip.h"
#include "src2d/merging/spare_welds.h"
#include "tests/src2d/merging/merging_testing.h"

namespace merge2d {
namespace {

/// The groups that the criterion finds when it is asked about every contact of every weld, with a
/// node for each member and at last one for the frame.
Groups groupsOfAllPins(const State& state, const Collection& c) {
  const auto node = [&](BodyId b) {
    return state[b].rigid == c.rigid ? state[rigidOf(b)].member
                                     : static_cast<std::uint32_t>(c.members.size());
  };
  std::vector<Pin> pins;
  for (const Weld& weld : c.welds) {
    if (weld.cut) continue;
    forEachHeld(c, weld, [&](const InternalPoint& point) {
      pins.push_back({.a = node(weld.a), .b = node(weld.b), .at = point.position, .placed = true});
    });
  }
  return heldGroups(static_cast<std::uint32_t>(c.members.size() + 1), pins,
                    state.settings.merging.cycles);
}

/// Takes each weld of each collection away, one at a time, and asks what still holds.
class EachWeldCut : public Observer {
 public:
  void afterStage(Stage stage, const State& state, const Scratch&) override {
    if (stage != Stage::Merge) return;
    for (const Collection& c : state.collections) {
      if (c.id == kNoCollection) continue;
      for (std::size_t i = 0; i < c.welds.size(); ++i) {
        Collection without = c;
        without.welds[i].cut = true;
        without.cut_welds = {static_cast<std::uint32_t>(i)};
        without.stood.clear();
        const Parts parts = partsWithoutCuts(state, without);
        const bool apart = fallsApart(state, without, parts);
        parted += apart ? 1 : 0;
        Scratch scratch;
        listOthers(state, scratch, without);
        if (losesAMember(without, scratch)) {
          ++alone;
          EXPECT_TRUE(apart);
        }
        ++welds;
        expectEqual(parts, groupsOfAllPins(state, without), c.members.size());
      }
    }
  }
  static void expectEqual(const Parts& parts, const Groups& groups, std::size_t members) {
    for (std::size_t m = 0; m < members; ++m) {
      EXPECT_EQ(parts.anchored[parts.part[m]] != 0, groups[m] == groups[members]);
      for (std::size_t n = 0; n < m; ++n) {
        EXPECT_TRUE(parts.part[m] != parts.part[n] || groups[m] == groups[n]);
        // Through the frame alone nothing is joined.
        if (groups[m] != groups[members]) {
          EXPECT_EQ(groups[m] == groups[n], parts.part[m] == parts.part[n]);
        }
      }
    }
  }
  int welds = 0, parted = 0;
  int alone = 0;  ///< cuts that leave a member without anything that holds it
};

TEST(Parts, EqualTheGroupsOfAllContacts) {
  for (const Scene& scene : {wall(6, 5), column(5), pyramid(5)}) {
    EXPECT_GT(watched<EachWeldCut>(scene, 60).welds, 0);
  }
}

TEST(Parts, AColumnFallsApartAtAnyWeldAndAWallHardlyAnywhere) {
  const EachWeldCut in_column = watched<EachWeldCut>(column(5), 1);
  EXPECT_EQ(in_column.welds, 5);
  EXPECT_EQ(in_column.parted, 5);
  EXPECT_EQ(in_column.alone, 1) << "the uppermost";
  const EachWeldCut in_wall = watched<EachWeldCut>(wall(6, 5), 1);
  EXPECT_LT(in_wall.parted, in_wall.welds / 4);
}

}  // namespace
}  // namespace merge2d
