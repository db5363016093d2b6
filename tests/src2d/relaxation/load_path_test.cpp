#include "src2d/relaxation/load_path.h"

#include <stdexcept>

#include "src2d/collections/collection.h"
#include "src2d/proofs/load_certificate.h"
#include "src2d/setup.h"
#include "src2d/state_file.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

constexpr double kTolerance = 1e-6;  // m/s

/// A scene whose boxes have merged on the ground, to look into.
class Merged {
 public:
  explicit Merged(const Scene& scene) {
    Simulation run(scene, Mode::Merge);
    run.until(2.0);
    setUp(run.world().scene(), Mode::Merge, setup_);
    restoreState(run.world().save(), "world", run.world().scene(), setup_);
    scratch_.open.assign(state().bodies.size(), 0);
    bringBlocksBack(state(), collection());
    writeImpulses(collection());
    listWeldsOfMembers(collection());
    layOutPush(state(), collection());
  }

  State& state() { return setup_.state; }
  Collection& collection() {
    for (Collection& c : state().collections) {
      if (c.id != kNoCollection) return c;
    }
    throw std::logic_error("nothing has merged");
  }
  std::uint32_t last() { return static_cast<std::uint32_t>(collection().members.size()) - 1; }
  LoadPath path() { return {state(), scratch_, collection()}; }
  void open(std::uint32_t member) { scratch_.open[index(collection().members[member])] = 1; }

  bool carriesOnTop(const Twist& gain) { return path().find(last(), gain, kTolerance); }

 private:
  merge2d::Setup setup_;
  Scratch scratch_;
};

TEST(LoadPath, AColumnCarriesWhatFallsOnIt) {
  Merged merged(column(4));
  EXPECT_TRUE(merged.carriesOnTop({0.0, -9.0, 0.0}));
  EXPECT_TRUE(merged.carriesOnTop({0.0, -9.0, 20.0})) << "a moment of 3.3 N m s, 37 cm off";
  EXPECT_FALSE(merged.carriesOnTop({0.0, -9.0, 40.0})) << "beside the foot";
}

TEST(LoadPath, AColumnIsLiftedByNoMoreThanItsWeight) {
  Merged merged(column(4));
  EXPECT_TRUE(merged.carriesOnTop({0.0, 0.09, 0.0}));
  EXPECT_FALSE(merged.carriesOnTop({0.0, 0.11, 0.0}));
}

/// Two loads cannot both use the weight that a contact bears.
TEST(LoadPath, WaysThatAreAddedMeetEachOther) {
  Merged merged(column(4));
  Collection& c = merged.collection();
  const Impulses foot = c.blocks.front().lambda;
  LoadPath path = merged.path();
  const Twist lift{0.0, 0.06, 0.0};
  ASSERT_TRUE(path.find(merged.last(), lift, kTolerance));
  EXPECT_TRUE(path.find(merged.last(), lift, kTolerance)) << "not added yet";
  path.apply(c);
  EXPECT_FALSE(path.find(merged.last(), lift, kTolerance));
  EXPECT_NE(c.blocks.front().lambda, foot);
  path.restore(c);
  EXPECT_EQ(c.blocks.front().lambda, foot);
  EXPECT_TRUE(path.find(merged.last(), lift, kTolerance));
}

TEST(LoadPath, APushBeyondFrictionIsNotCarried) {
  Merged merged(column(4));
  EXPECT_FALSE(merged.carriesOnTop({8.0, -9.0, 0.0}));
}

TEST(LoadPath, ABodyOnItsOwnTakesNothing) {
  Merged merged(column(4));
  merged.open(1);
  EXPECT_FALSE(merged.carriesOnTop({0.0, -9.0, 0.0}));
}

/// Its impulses balance the load, and nothing else.
TEST(LoadPath, TheImpulsesOfAWayMoveTheLoadedBodyAlone) {
  Merged merged(wall(8, 6));
  Collection& c = merged.collection();
  const std::vector<Twist> before = c.push;
  const std::uint32_t top = merged.last() - 2;
  LoadPath path = merged.path();
  ASSERT_TRUE(path.find(top, {0.1, -2.0, 0.3}, kTolerance));
  path.apply(c);
  layOutPush(merged.state(), c);
  for (std::uint32_t m = 0; m < c.members.size(); ++m) {
    const double x = m == top ? -0.1 : 0.0, y = m == top ? 2.0 : 0.0, spin = m == top ? -0.3 : 0.0;
    EXPECT_NEAR(c.push[m].vx - before[m].vx, x, 1e-5);
    EXPECT_NEAR(c.push[m].vy - before[m].vy, y, 1e-5);
    EXPECT_NEAR(c.push[m].omega - before[m].omega, spin, 1e-5);
  }
  for (const ContactBlock& k : c.blocks) {
    for (int i = 0; i < k.count; ++i) {
      EXPECT_GE(k.lambda_n(i), -1e-12);
      EXPECT_LE(std::abs(k.lambda_t(i)), k.mu * k.lambda_n(i) + 1e-9);
    }
  }
}

}  // namespace
}  // namespace merge2d
