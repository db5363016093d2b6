/// Weak pulls on merged bodies, under little weight or none.

#include <fmt/format.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// Two modules without weight that were pressed together; from 10 s on one of them is pulled away.
TEST(SlowLoad, AWeakPullPartsModulesInAWorldWithoutWeight) {
  constexpr double kMass = 1000.0, kTime = 20.0;
  for (const double pull : {1.0, 3.0}) {
    Simulation run(fmt::format(R"(
format = 1
gravity = [0, 0]
[[body]]
name = "one"
at = [0, 0]
box = [4, 3]
mass = 1000
[[body]]
name = "other"
at = [4, 0]
box = [4, 3]
mass = 1000
[[force]]
body = "one"
force = [100, 0]
until = 5
[[force]]
body = "other"
force = [-100, 0]
until = 5
[[force]]
body = "other"
force = [{}, 0]
from = 10
)",
                               pull),
                   Mode::Merge);
    run.until(9.9);
    ASSERT_TRUE(run.merged("other"));
    const double before = run.body("other").x.x();
    run.until(10.0 + kTime);
    const double way = 0.5 * pull / kMass * kTime * kTime;
    EXPECT_NEAR(run.body("other").x.x() - before, way, 0.02 * way) << pull;
  }
}

/// A box whose friction a pull exceeds by a third, where all weighs a two-thousandth.
TEST(SlowLoad, APullMovesABoxUnderWeakGravity) {
  constexpr double kGravityThere = 0.005, kFriction = 0.5, kTime = 40.0;
  constexpr double kPull = 4.0 / 3.0 * kFriction * kGravityThere;  // of 1 kg
  Simulation run(fmt::format("gravity = [0, {}]\n", -kGravityThere) + kGround +
                     "[[body]]\nname = \"box\"\nat = [0, 0.25]\nbox = [1, 0.5]\nmass = 1\n" +
                     fmt::format("[[force]]\nbody = \"box\"\nforce = [{}, 0]\nfrom = 5\n", kPull),
                 Mode::Merge, {{"material.friction", "0.5"}});
  run.until(4.9);
  ASSERT_TRUE(run.anchored("box"));
  run.until(5.0 + kTime);
  const double way = 0.5 * (kPull - kFriction * kGravityThere) * kTime * kTime;
  EXPECT_NEAR(run.body("box").x.x(), way, 0.03 * way);
}

}  // namespace
}  // namespace merge2d
