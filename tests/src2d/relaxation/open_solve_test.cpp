#include "src2d/relaxation/open_solve.h"

#include <gtest/gtest.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

const std::string kTwoBricks = kGround + R"(
[[body]]
name = "b0"
at = [0, 0.25]
box = [1, 0.5]
[[body]]
name = "b1"
at = [0, 0.75]
box = [1, 0.5]
)";

/// Three bricks that two springs press together in free space; a disc flies at the end of one.
const std::string kStruckInSpace = R"(
format = 1
gravity = [0, 0]
[material]
friction = 0.5
[[body]]
name = "low"
at = [0, 0]
box = [1, 0.4]
[[body]]
name = "middle"
at = [0, 0.4]
box = [1, 0.4]
[[body]]
name = "high"
at = [0, 0.8]
box = [1, 0.4]
[[spring]]
body = "low"
anchor = [-0.3, 0]
to_body = "high"
to_anchor = [-0.3, 0]
stiffness = 60
damping = 2
rest_length = 0.5
[[spring]]
body = "low"
anchor = [0.3, 0]
to_body = "high"
to_anchor = [0.3, 0]
stiffness = 60
damping = 2
rest_length = 0.5
[[body]]
name = "disc"
at = [0.4, 6]
circle = 0.2
velocity = [0, -4]
)";

TEST(OpenSolve, KeepsMomentumAndAngularMomentumInAHit) {
  Simulation run(kStruckInSpace, Mode::Merge);
  const Stats before = run.now().stats;
  run.until(1.0);
  ASSERT_TRUE(run.merged("low"));
  while (run.world().time() < 3.0) {
    run.steps(1);
    const Stats now = run.now().stats;
    ASSERT_NEAR((now.momentum - before.momentum).norm(), 0.0, 1e-9);
    ASSERT_NEAR(now.angular_momentum, before.angular_momentum, 1e-8);
  }
  EXPECT_GT(run.body("high").v.norm(), 0.1) << "it was hit";
}

/// A brick in a stack of three is hit: all are as fast as in the reference.
TEST(OpenSolve, ABlowMovesWhatItMovesInTheReference) {
  const std::string scene = kTwoBricks + R"(
[[body]]
name = "b2"
at = [0, 1.25]
box = [1, 0.5]
)";
  const auto struck = [&](Mode mode) {
    Simulation run(scene, mode);
    run.until(1.0);
    run.kick("b1", {1.5, 0.0});
    run.steps(1);
    return std::array{run.body("b0").v.x(), run.body("b1").v.x(), run.body("b2").v.x()};
  };
  const auto merged = struck(Mode::Merge), reference = struck(Mode::Reference);
  ASSERT_GT(reference[1], 1.0);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(merged[i], reference[i], 0.05) << i;
}

TEST(OpenSolve, AGentleBlowLeavesAStackInOnePiece) {
  Simulation run(kTwoBricks, Mode::Merge);
  run.until(1.0);
  ASSERT_TRUE(run.merged("b1"));
  run.kick("b1", {0.01, 0.0});  // friction bears 0.029 N s in a step
  run.steps(20);
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
  EXPECT_NEAR(run.body("b1").v.norm(), 0.0, 1e-12);
}

/// The impulses of a blow are not taken for those that carry the load afterwards.
TEST(OpenSolve, TheForcesAfterABlowAreThoseBeforeIt) {
  Simulation run(kTwoBricks, Mode::Merge);
  const auto pressure = [&] {
    double sum = 0.0;
    const Snapshot now = run.now();
    for (const ContactView& c : now.contacts) {
      if (c.a == run.id("b0") && c.b == run.id("b1")) sum += c.lambda_n;
    }
    return sum;
  };
  run.until(1.0);
  const double before = pressure();
  EXPECT_NEAR(before, 0.5 * 9.81 * 0.01, 1e-5);
  run.kick("b1", {0.0, -3.0});
  run.steps(6);
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
  EXPECT_NEAR(pressure(), before, 1e-4);
}

}  // namespace
}  // namespace merge2d
