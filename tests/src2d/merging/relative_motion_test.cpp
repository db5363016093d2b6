#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// Friction bears 5.886 N. A push that is a little stronger parts the box from the ground, which
/// does not yet show in its speed; it ends, and the box is at rest again.
TEST(Merge, APairThatPartedSlowlyAndStoppedWaitsNoLonger) {
  for (const double lasts : {0.05, 0.2}) {
    Simulation run(kGround + fmt::format(R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
mass = 1
[[force]]
body = "box"
force = [5.896, 0]
from = 1
until = {}
)",
                                         1.0 + lasts),
                   Mode::Merge);
    run.until(1.0 + lasts);
    EXPECT_EQ(run.count(EventType::Unmerge), 1);
    EXPECT_FALSE(run.merged("box")) << "it still gains speed";
    run.until(1.0 + lasts + 0.3);
    EXPECT_TRUE(run.merged("box"));
  }
}

}  // namespace
}  // namespace merge2d
