/// Hits without restitution are followed in small islands, and are solved with all others in large
/// ones.

#include "src2d/contact/followed_hits.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "tests/support/merging_testing.h"
#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

/// A box flies obliquely onto a plank that bears `load` others, so that it slides by a hand's
/// breadth along the plank within the step in which they meet.
World onto(int load, double spin, double h, Mode mode) {
  Scene scene = noGravity();
  scene.step = h;
  BodyDesc hitter = named("hitter", moving(box(1, 1, {-3.0, -1.9}), {20, 10}));
  hitter.spin = spin;
  add(scene, hitter);
  add(scene, named("plank", box(30, 0.5, {0, 0})));
  for (int i = 0; i < load; ++i) add(scene, box(1, 1, {1.0 * i - 10.0, 0.75}));
  return World(scene, inMode(mode));
}

/// The normal of a hit turns with the bodies; a body that turns by nothing to speak of has another
/// normal than one that does not turn, and yet is to be hit alike.
TEST(FollowedHits, AHairOfSpinChangesNothing) {
  for (const int load : {0, 5, 20}) {
    for (const double h : kStepSizes) {
      for (const Mode mode : kAllModes) {
        SCOPED_TRACE(load);
        World straight = onto(load, 0.0, h, mode), turning = onto(load, 1e-7, h, mode);
        for (int i = 0; i < 30; ++i) {
          straight.step();
          turning.step();
          for (const char* name : {"hitter", "plank"}) {
            const BodyState a = see(straight, name), b = see(turning, name);
            ASSERT_NEAR((a.x - b.x).norm(), 0.0, 1e-4) << name << " in step " << i;
            ASSERT_NEAR((a.v - b.v).norm(), 0.0, 1e-3) << name << " in step " << i;
          }
        }
      }
    }
  }
}

/// A box lands on a stack of boxes that have merged with the ground.
World landing(const BodyDesc& lander, const std::vector<BodyDesc>& stack, double friction, double h,
              Mode mode, bool papers_rule = false) {
  Scene scene = onGround();
  scene.step = h;
  if (papers_rule) {
    scene.settings.merging.rule = MergingRule::Paper;
    scene.settings.unmerging.rule = UnmergingRule::Paper;
  }
  for (const BodyDesc& b : stack) add(scene, b);
  BodyDesc last = lander;
  last.pinned_until = 0.5;
  add(scene, last);
  for (BodyDesc& b : scene.bodies) b.friction = friction;
  return World(scene, inMode(mode));
}

/// One corner first, beyond the edge: it tips over, as it does on a box that is simulated by
/// itself.
TEST(FollowedHits, ABoxThatMeetsTheEdgeOfAMergedOneTips) {
  BodyDesc lander = named("lander", moving(box(0.6, 0.3, {-0.25, 0.7}), {-1.0, -2.5}));
  lander.angle = -1.6 * std::numbers::pi / 180.0;
  for (const double h : {1.0 / 60.0, 0.01, 0.005}) {
    std::map<Mode, BodyState> end;
    for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
      World world = landing(lander, {box(0.8, 0.3, {0, 0.15})}, 0.6, h, mode);
      runSeconds(world, 0.45);
      ASSERT_EQ(see(world, BodyId{1}).collection != kNoCollection, merges(mode));
      runSeconds(world, 0.35);
      end[mode] = see(world, "lander");
    }
    EXPECT_GT(end[Mode::Reference].angle, 0.8);
    World by_paper = landing(lander, {box(0.8, 0.3, {0, 0.15})}, 0.6, h, Mode::Merge, true);
    runSeconds(by_paper, 0.8);
    EXPECT_NEAR(see(by_paper, "lander").angle, end[Mode::Reference].angle, 0.05) << "h " << h;
    for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
      EXPECT_NEAR(end[mode].angle, end[Mode::Reference].angle, 0.05) << name(mode) << " h " << h;
      EXPECT_LT((end[mode].x - end[Mode::Reference].x).norm(), 0.01) << name(mode) << " h " << h;
    }
  }
}

/// Three boxes on a hinge and a rod clap together when a disc strikes them: one corner of two meets
/// in a step, and the other takes part in the full solve.
TEST(FollowedHits, ThoseOfOneCornerKeepTheAngularMomentum) {
  const Simulation clapper(R"(
format = 1
gravity = [0, 0]
[material]
friction = 0.3
[[body]]
name = "box"
box = [0.6, 0.3]
repeat = { count = [1, 3], spacing = [1, 0.3] }
mass = 1
[[joint]]
kind = "revolute"
bodies = ["box[0,0]", "box[0,1]"]
at = [0.1, 0.15]
[[joint]]
kind = "distance"
bodies = ["box[0,1]", "box[0,2]"]
at = [0.2, 0.3]
to = [0.2, 0.6]
[[spring]]
body = "box[0,0]"
to_body = "box[0,1]"
to_anchor = [0, 0]
stiffness = 60
[[spring]]
body = "box[0,1]"
to_body = "box[0,2]"
to_anchor = [0, 0]
stiffness = 300
[[body]]
name = "disc"
at = [2, 0.194]
circle = 0.15
mass = 0.425
velocity = [-1.034, 0]
spin = -30.5
)",
                           Mode::Reference);
  for (const Mode mode : kAllModes) {
    World world(clapper.world().scene(), inMode(mode));
    const Stats before = world.capture().stats;
    for (int i = 0; i < 300; ++i) {
      world.step();
      const Stats now = world.capture().stats;
      ASSERT_NEAR(now.angular_momentum, before.angular_momentum, 1e-10)
          << name(mode) << " in step " << i;
      ASSERT_LT((now.momentum - before.momentum).norm(), 1e-10);
    }
  }
}

/// Friction takes up to μ of the speed of the fall from its motion along the top: all that there
/// is.
TEST(FollowedHits, ABoxThatLandsFlatOnAMergedStackStopsAtOnce) {
  constexpr double kFriction = 0.3, kAcross = 0.67, kDown = 2.0, kFall = 0.1;
  const double time = (std::sqrt(kDown * kDown + 2.0 * kGravity * kFall) - kDown) / kGravity;
  const BodyDesc lander = named("lander", moving(box(0.3, 0.2, {0.1, 0.8}), {kAcross, -kDown}));
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    for (const int boxes : {1, 2, 4}) {
      std::vector<BodyDesc> stack;
      for (int i = 0; i < boxes; ++i) stack.push_back(box(0.6, 0.3, {0, 0.3 * i + 0.15}));
      BodyDesc high = lander;
      high.at.y() += 0.3 * (boxes - 2);
      World world = landing(high, stack, kFriction, 0.005, mode);
      runSeconds(world, 1.2);
      EXPECT_NEAR(see(world, "lander").x.x(), 0.1 + kAcross * time, 4e-3)
          << name(mode) << " on " << boxes;
    }
  }
}

}  // namespace
}  // namespace merge2d
