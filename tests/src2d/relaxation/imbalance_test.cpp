#include "src2d/relaxation/imbalance.h"

#include <gtest/gtest.h>

#include "src2d/collections/inner_push.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/relaxation/region_members.h"
#include "tests/src2d/relaxation/merged_testing.h"

namespace merge2d {
namespace {

const Vec2 kNothing{0.0, 0.0};

/// The members that a load moves, by a look at each.
std::vector<std::uint32_t> movedBy(Merged& merged, const CollectionLoad& load) {
  Collection& c = merged.collection();
  std::vector<Twist> gains;
  loadMembers(merged.state(), c, load, gains);
  c.push.forget();
  layOutPush(merged.state(), c);
  std::vector<std::uint32_t> moved;
  for (std::uint32_t m = 0; m < gains.size(); ++m) {
    const double speed = cornerSpeed(merged.state(), c, m, leftOver(c, m, gains[m]));
    if (speed > cutSpeed(merged.state())) moved.push_back(m);
  }
  return moved;
}

std::vector<std::uint32_t> fastOf(Merged& merged, const Collection& c, const Imbalance& imbalance) {
  std::vector<std::uint32_t> fast;
  for (const MemberLoad& one : imbalance.unbalanced()) {
    const double speed = cornerSpeed(merged.state(), c, one.member, one.gain);
    if (speed > cutSpeed(merged.state())) fast.push_back(one.member);
  }
  return fast;
}

/// Takes the weight off one contact of a member.
void lift(Collection& c, std::uint32_t member) {
  const Weld& weld = c.welds[c.welds_of[member].front()];
  c.blocks[c.contacts[weld.first].block].lambda = {};
}

TEST(Imbalance, AWallAtRestIsInBalance) {
  Merged merged(wall(8, 6));
  const CollectionLoad load = merged.loadWith(merged.last(), kNothing);
  const Imbalance imbalance(merged.state(), merged.collection(), load);
  EXPECT_TRUE(fastOf(merged, merged.collection(), imbalance).empty());
  EXPECT_LE(imbalance.fastestOfOthers(), cutSpeed(merged.state()));
}

TEST(Imbalance, AForceOnAMemberMovesThatOneAlone) {
  Merged merged(wall(8, 6));
  const CollectionLoad load = merged.loadWith(merged.last() - 2, {0.0, -0.5});
  const Imbalance imbalance(merged.state(), merged.collection(), load);
  EXPECT_EQ(fastOf(merged, merged.collection(), imbalance),
            std::vector<std::uint32_t>{merged.last() - 2});
  const double mass = merged.state()[merged.collection().members[merged.last() - 2]].mass;
  EXPECT_NEAR(imbalance.of(merged.last() - 2).vy, -0.5 / mass, 1e-4);
}

/// Some are remembered from an earlier look.
TEST(Imbalance, ImpulsesThatHaveChangedAreSeen) {
  Merged merged(wall(8, 6));
  Collection& c = merged.collection();
  const CollectionLoad load = merged.loadWith(merged.last(), kNothing);
  EXPECT_TRUE(fastOf(merged, c, Imbalance(merged.state(), c, load)).empty());
  lift(c, 20);
  const Weld& weld = c.welds[c.welds_of[20].front()];
  std::vector<std::uint32_t> ends;
  for (const std::uint32_t end : {weld.node_a, weld.node_b}) {
    if (!isFrame(c, end)) ends.push_back(end);
  }
  renewPush(merged.state(), c, ends);
  const auto seen = fastOf(merged, c, Imbalance(merged.state(), c, load));
  EXPECT_FALSE(seen.empty());
  EXPECT_EQ(seen, movedBy(merged, load));
}

/// The frame gives all of them a velocity.
TEST(Imbalance, AnotherMotionOfTheFrameIsLookedAtAnew) {
  Merged merged(wall(8, 6));
  Collection& c = merged.collection();
  CollectionLoad load = merged.loadWith(merged.last(), kNothing);
  EXPECT_TRUE(fastOf(merged, c, Imbalance(merged.state(), c, load)).empty());
  load.frame[0] += 0.1;
  EXPECT_EQ(fastOf(merged, c, Imbalance(merged.state(), c, load)).size(), c.members.size());
}

}  // namespace
}  // namespace merge2d
