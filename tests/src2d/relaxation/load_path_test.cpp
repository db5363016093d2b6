#include "src2d/relaxation/load_path.h"

#include "src2d/relaxation/open_region.h"
#include "tests/src2d/relaxation/merged_testing.h"

namespace merge2d {
namespace {

constexpr double kTolerance = 1e-6;  // m/s

bool carriesOnTop(Merged& merged, const Twist& gain) {
  return merged.path().find({merged.last(), gain}, kTolerance);
}

TEST(LoadPath, AColumnCarriesWhatFallsOnIt) {
  Merged merged(column(4));
  EXPECT_TRUE(carriesOnTop(merged, {0.0, -9.0, 0.0}));
  EXPECT_TRUE(carriesOnTop(merged, {0.0, -9.0, 20.0})) << "a moment of 3.3 N m s, 37 cm off";
  EXPECT_FALSE(carriesOnTop(merged, {0.0, -9.0, 40.0})) << "beside the foot";
}

TEST(LoadPath, AColumnIsLiftedByNoMoreThanItsWeight) {
  Merged merged(column(4));
  EXPECT_TRUE(carriesOnTop(merged, {0.0, 0.09, 0.0}));
  EXPECT_FALSE(carriesOnTop(merged, {0.0, 0.11, 0.0}));
}

/// Two loads cannot both use the weight that a contact bears.
TEST(LoadPath, WaysThatAreAddedMeetEachOther) {
  Merged merged(column(4));
  Collection& c = merged.collection();
  const Impulses foot = c.blocks.front().lambda;
  LoadPath path = merged.path();
  const Twist lift{0.0, 0.06, 0.0};
  ASSERT_TRUE(path.find({merged.last(), lift}, kTolerance));
  EXPECT_TRUE(path.find({merged.last(), lift}, kTolerance)) << "not added yet";
  path.apply(c);
  EXPECT_FALSE(path.find({merged.last(), lift}, kTolerance));
  EXPECT_NE(c.blocks.front().lambda, foot);
  path.restore(c);
  EXPECT_EQ(c.blocks.front().lambda, foot);
  EXPECT_TRUE(path.find({merged.last(), lift}, kTolerance));
}

TEST(LoadPath, APushBeyondFrictionIsNotCarried) {
  Merged merged(column(4));
  EXPECT_FALSE(carriesOnTop(merged, {8.0, -9.0, 0.0}));
}

TEST(LoadPath, ABodyOnItsOwnTakesNothing) {
  Merged merged(column(4));
  merged.open(1);
  EXPECT_FALSE(carriesOnTop(merged, {0.0, -9.0, 0.0}));
}

/// Its impulses balance the load, and nothing else.
TEST(LoadPath, TheImpulsesOfAWayMoveTheLoadedBodyAlone) {
  Merged merged(wall(8, 6));
  Collection& c = merged.collection();
  const std::vector<Twist> before = c.push.of;
  const std::uint32_t top = merged.last() - 2;
  LoadPath path = merged.path();
  ASSERT_TRUE(path.find({top, {0.1, -2.0, 0.3}}, kTolerance));
  path.apply(c);
  renewPush(merged.state(), c, path.members());
  for (std::uint32_t m = 0; m < c.members.size(); ++m) {
    const double x = m == top ? -0.1 : 0.0, y = m == top ? 2.0 : 0.0, spin = m == top ? -0.3 : 0.0;
    EXPECT_NEAR(c.push.of[m].vx - before[m].vx, x, 1e-5);
    EXPECT_NEAR(c.push.of[m].vy - before[m].vy, y, 1e-5);
    EXPECT_NEAR(c.push.of[m].omega - before[m].omega, spin, 1e-5);
  }
  merged.expectAdmissible();
}

/// The weights of two bricks go down together.
TEST(LoadPath, LoadsArePassedOnAtOnce) {
  Merged merged(wall(8, 6));
  Collection& c = merged.collection();
  const std::vector<Twist> before = c.push.of;
  const std::vector<MemberLoad> loads{{merged.last() - 1, {0.0, -0.1, 0.0}},
                                      {merged.last() - 2, {0.0, -0.2, 0.0}}};
  LoadPath path = merged.path();
  ASSERT_TRUE(path.find(loads, {0.0, -0.1, 0.0, 0.0, 0.0}, kTolerance));
  path.apply(c);
  renewPush(merged.state(), c, path.members());
  for (const MemberLoad& load : loads) {
    EXPECT_NEAR(c.push.of[load.member].vy - before[load.member].vy, -load.gain.vy, 1e-5);
  }
  EXPECT_NEAR(c.push.of[0].vy - before[0].vy, 0.0, 1e-5);
  merged.expectAdmissible();
}

/// A region that began before the way was found puts its impulses back.
TEST(LoadPath, ThePushIsRenewedWhereARegionTakesImpulsesBack) {
  Merged merged(wall(8, 6));
  Collection& c = merged.collection();
  LoadPath path = merged.path();
  ASSERT_TRUE(path.find({merged.last() - 2, {0.1, -2.0, 0.3}}, kTolerance));
  OpenRegion region;
  for (std::uint32_t i = 0; i < c.blocks.size(); ++i)
    region.before.emplace_back(i, c.blocks[i].lambda);
  const std::vector<Twist> before = c.push.of;
  path.apply(c);
  renewPush(merged.state(), c, path.members());
  EXPECT_NE(c.push.of[merged.last() - 2].vy, before[merged.last() - 2].vy);
  Witness none;
  restoreImpulses(merged.state(), c, region, none);
  for (std::uint32_t m = 0; m < c.members.size(); ++m) {
    EXPECT_EQ(c.push.of[m].vx, before[m].vx);
    EXPECT_EQ(c.push.of[m].vy, before[m].vy);
    EXPECT_EQ(c.push.of[m].omega, before[m].omega);
  }
}

}  // namespace
}  // namespace merge2d
