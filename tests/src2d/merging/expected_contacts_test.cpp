/// Bodies that an impulse drives against others of their collection.

#include "src2d/merging/expected_contacts.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// Two boxes 2 cm apart, held together by the ground and a plate; after 1.5 s `a` is struck.
const std::string kNeighbours = kGround + R"(
[[body]]
name = "a"
at = [0, 0.5]
box = [1, 1]
[[body]]
name = "b"
at = [1.02, 0.5]
box = [1, 1]
[[body]]
name = "plate"
at = [0.5, 1.1]
box = [2.2, 0.2]
)";

TEST(ExpectedContacts, ABodyPushesANeighbourThatItDoesNotTouchYet) {
  for (const char* rule : {"\"default\"", "\"paper\""}) {
    const Overrides overrides{{"unmerging.rule", rule}};
    Simulation run(kNeighbours, Mode::Merge, overrides), reference(kNeighbours, Mode::Reference);
    for (Simulation* s : {&run, &reference}) {
      s->until(1.5);
      s->kick("a", {150.0, 0.0});
      s->steps(1);
    }
    EXPECT_GT(reference.body("b").v.x(), 70.0);
    EXPECT_NEAR(run.body("a").v.x(), reference.body("a").v.x(), 2.0) << rule;
    EXPECT_NEAR(run.body("b").v.x(), reference.body("b").v.x(), 2.0) << rule;
    EXPECT_LT(run.body("a").x.x() + 1.0, run.body("b").x.x() + 0.01) << "they do not overlap";
  }
}

TEST(ExpectedContacts, TwoThatAreDrivenAtEachOtherMeetWhicheverIsFaster) {
  for (const auto& [left, right] : {std::pair(150.0, -1.0), {1.0, -150.0}, {100.0, -100.0}}) {
    SCOPED_TRACE(left);
    Simulation run(kNeighbours, Mode::Merge), reference(kNeighbours, Mode::Reference);
    for (Simulation* s : {&run, &reference}) {
      s->until(1.5);
      s->kick("a", {left, 0.0});
      s->kick("b", {right, 0.0});
      s->steps(1);
    }
    for (const char* name : {"a", "b"}) {
      EXPECT_NEAR(run.body(name).v.x(), reference.body(name).v.x(), 2.0) << name;
    }
    EXPECT_LT(run.body("a").x.x() + 1.0, run.body("b").x.x() + 0.01) << "they do not overlap";
  }
}

/// On one floor two stacks are two collections, and detection looks at no pair of them.
TEST(ExpectedContacts, ABodyPushesAStackBesideItsOwn) {
  const std::string stacks = kGround + R"(
[[body]]
name = "a"
at = [0, 0.5]
box = [1, 1]
repeat = {count = [1, 2], spacing = [1, 1]}
[[body]]
name = "b"
at = [1.02, 0.5]
box = [1, 1]
repeat = {count = [1, 2], spacing = [1, 1]}
)";
  Simulation run(stacks, Mode::Merge), reference(stacks, Mode::Reference);
  for (Simulation* s : {&run, &reference}) {
    s->until(1.5);
    s->kick("a[0,1]", {150.0, 0.0});
    s->steps(1);
  }
  EXPECT_GT(reference.body("b[0,1]").v.x(), 40.0);
  EXPECT_NEAR(run.body("b[0,1]").v.x(), reference.body("b[0,1]").v.x(), 2.0);
}

/// A blow in many parts is one blow, and others far from it do not meet it.
TEST(ExpectedContacts, ManySmallImpulsesAreOneLargeOne) {
  Simulation whole(kNeighbours, Mode::Merge), parts(kNeighbours, Mode::Merge);
  for (Simulation* s : {&whole, &parts}) s->until(1.5);
  whole.kick("a", {128.0, 0.0});
  for (int i = 0; i < 64; ++i) parts.kick("a", {2.0, 0.0});
  for (Simulation* s : {&whole, &parts}) s->steps(1);
  for (const char* name : {"a", "b", "plate"}) {
    EXPECT_NEAR(parts.body(name).v.x(), whole.body(name).v.x(), 1e-9) << name;
  }
}

TEST(ExpectedContacts, ABodyStopsAtAWallThatItDoesNotTouchYet) {
  Simulation run(kGround + R"(
[[body]]
name = "wall"
motion = "pinned"
at = [1.05, 1]
box = [1, 2]
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
)",
                 Mode::Merge);
  run.until(1.5);
  ASSERT_TRUE(run.merged("box"));
  run.kick("box", {60.0, 0.0});
  run.steps(2);
  EXPECT_LT(run.body("box").x.x(), 0.06);
  EXPECT_GT(run.body("box").x.x(), 0.04);
}

TEST(ExpectedContacts, WhatDidNotPartIsNoWeldAfterwards) {
  Simulation run(kNeighbours + "density = 200\n", Mode::Merge);
  run.until(1.5);
  ASSERT_TRUE(run.merged("a"));
  const std::size_t welds = run.now().welds.size();
  run.kick("a", {2.5, 0.0});  // friction holds
  run.steps(1);
  EXPECT_TRUE(run.merged("a"));
  EXPECT_EQ(run.now().welds.size(), welds);
  EXPECT_EQ(run.now().events.size(), 0u);
}

}  // namespace
}  // namespace merge2d
