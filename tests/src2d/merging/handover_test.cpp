/// Forces are handed over between the full solve, the sweep, merges and unmerges without a jump.

#include <gtest/gtest.h>

#include <numeric>

#include "src2d/begin_step.h"
#include "src2d/collections/collection.h"
#include "src2d/contact/detection.h"
#include "src2d/dynamics/integrate.h"
#include "src2d/dynamics/solver.h"
#include "src2d/merging/disturbance.h"
#include "src2d/merging/merge.h"
#include "src2d/merging/relative_motion.h"
#include "src2d/merging/sweep.h"
#include "src2d/merging/unmerge.h"
#include "src2d/merging/warm_start.h"
#include "src2d/setup.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// Algorithm 1 without sleep, in which somebody may reach in after Unmerge.
class Steps {
 public:
  explicit Steps(const Scene& scene) { setUp(scene, Mode::Merge, setup_); }

  State& state() { return setup_.state; }

  void until(double time) {
    while (state().time < time - 1e-9) step(Hand::Away);
  }

  enum class Hand { Away, TakesApart, TakesApartAndForgets };

  /// One step, in which all collections may be taken to pieces before the full solve.
  void step(Hand hand) {
    State& s = state();
    beginStep(s, setup_.actions, scratch_);
    detectContacts(s, scratch_);
    orderContacts(s, scratch_);
    warmStartSweep(s, scratch_);
    sweepCollections(s, scratch_);
    unmerge(s, scratch_);
    if (hand != Hand::Away) takeApart();
    if (hand == Hand::TakesApartAndForgets) forgetForces();
    solveContacts(s, scratch_);
    advanceVelocities(s, scratch_);
    accumulateRelativeMotion(s, scratch_);
    advancePositions(s, scratch_);
    merge(s, scratch_);
    s.step += 1;
    s.time = static_cast<double>(s.step) * s.h;
  }

 private:
  void takeApart() {
    State& s = state();
    const std::size_t slots = s.collections.size();
    for (std::size_t slot = 0; slot < slots; ++slot) {
      const Collection& c = s.collections[slot];
      if (c.id == kNoCollection) continue;
      std::vector<std::uint32_t> part(c.members.size());
      std::iota(part.begin(), part.end(), 0u);
      splitCollection(s, c.rigid, part, std::vector<std::uint8_t>(part.size(), 0));
    }
    layOutCollections(s);
    collectPairs(s, scratch_);
  }

  void forgetForces() {
    for (Contact& contact : state().contacts.slots) {
      for (ContactPoint& p : contact.points) p.lambda_n = p.lambda_t = 0.0;
    }
  }

  merge2d::Setup setup_;
  Scratch scratch_;
};

/// How far the velocities of the bodies are from those of a frame, at most [m/s].
double fastestAgainst(State& state, const Vec2& v) {
  double fastest = 0.0;
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
    const Rigid& r = state.rigid(BodyId{i});
    if (state[rigidOf(BodyId{i})].anchor != kFloating) continue;
    fastest = std::max(fastest, (r.velocityAt(state.pose(BodyId{i}).position) - v).norm());
  }
  return fastest;
}

/// Merges when it has settled; until then it sinks into its soft contacts, and what merges early
/// goes on sinking when it parts.
Scene mergingLate(Scene scene) {
  scene.settings.merging.steps = 300;
  return scene;
}

TEST(Handover, AnUnmergeAtRestLeavesAColumnAtRest) {
  Steps run(mergingLate(column(10)));
  run.until(6.0);
  ASSERT_EQ(run.state().collections.size(), 1u);
  run.step(Steps::Hand::TakesApart);
  EXPECT_LT(fastestAgainst(run.state(), Vec2::Zero()), 1e-6);
}

TEST(Handover, AnUnmergeInMidSwingLeavesAWallOnItsPlatform) {
  const auto speedAfter = [](Steps::Hand hand) {
    Steps run(mergingLate(wallOnSwingingPlatform(10, 10, 0.4, 4.0)));
    run.until(8.5);
    run.step(hand);
    return fastestAgainst(run.state(), run.state()[RigidId{0}].v);
  };
  EXPECT_LT(speedAfter(Steps::Hand::TakesApart), 5e-3);
  EXPECT_GT(speedAfter(Steps::Hand::TakesApartAndForgets), 0.02) << "the forces are what holds it";
}

/// Normal impulses by bodies and features [N s].
std::vector<double> normalImpulses(const World& world) {
  std::vector<double> impulses;
  for (const ContactView& c : world.capture().contacts) impulses.push_back(c.lambda_n);
  return impulses;
}

TEST(Handover, AMergeAtRestChangesNoForce) {
  World world(mergingLate(column(10)), inMode(Mode::Merge));
  std::vector<double> before;
  while (world.stats().collections == 0 && world.time() < 10.0) {
    before = normalImpulses(world);
    world.step();
  }
  world.step();  // the first sweep inside
  const std::vector<double> after = normalImpulses(world);
  ASSERT_EQ(after.size(), 20u);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_NEAR(after[i] / before[i], 1.0, 1e-5) << i;
  }
}

}  // namespace
}  // namespace merge2d
