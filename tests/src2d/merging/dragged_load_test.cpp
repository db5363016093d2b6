/// Loads of collections that lie across two frames.

#include <fmt/format.h>

#include "tests/src2d/merging/merging_testing.h"

namespace merge2d {
namespace {

/// A lintel on two piers of three boxes that lie flat, each a little farther inward; the base of
/// the right one is drawn away.
std::string pierDrawnAway() {
  std::string toml =
      "format = 1\n[material]\nfriction = 0.7\n"
      "[[body]]\nname = \"left\"\nmotion = \"pinned\"\nat = [-1.7, -0.2]\nbox = [1.8, 0.4]\n"
      "[[body]]\nname = \"right\"\nmotion = \"scripted\"\nbox = [1.8, 0.4]\n"
      "script = { keyframes = [[0, 1.7, -0.2, 0], [2, 1.7, -0.2, 0], [25, 3, -0.2, 0]] }\n"
      "[[body]]\nname = \"lintel\"\nat = [0, 0.7]\nbox = [4.3, 0.2]\n";
  for (int row = 0; row < 3; ++row) {
    const double x = 1.7 - 0.12 * row, y = 0.1 + 0.2 * row;
    for (const auto& [name, side] : {std::pair("west", -1.0), std::pair("east", 1.0)}) {
      toml += fmt::format("[[body]]\nname = \"{}{}\"\nat = [{}, {}]\nbox = [1.2, 0.2]\n", name, row,
                          side * x, y);
    }
  }
  return toml;
}

/// Between two frames the impulses inside are found in the full solve alone. They go on from those
/// of the last step, not from a search whose load lacks the drag of the frame: the base slid away
/// under its pier.
TEST(SlowLoad, APierFollowsItsBaseAndTheLintelSlides) {
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    SCOPED_TRACE(name(mode));
    Simulation run(pierDrawnAway(), mode);
    run.until(4.0);
    const auto fromBase = [&](const std::string& box) -> Vec2 {
      return run.body(box).x - run.body("right").x;
    };
    EXPECT_GT(run.body("right").x.x(), 1.72);
    EXPECT_NEAR(fromBase("east0").x(), 0.0, 2e-3);
    EXPECT_NEAR(fromBase("east2").x(), -0.24, 2e-3);
  }
}

}  // namespace
}  // namespace merge2d
