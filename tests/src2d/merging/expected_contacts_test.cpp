/// Bodies that an impulse drives against others of their collection.

#include "src2d/merging/expected_contacts.h"

#include <gtest/gtest.h>

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
