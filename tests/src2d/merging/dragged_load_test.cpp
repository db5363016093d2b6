/// Loads of collections that lie across two frames.

#include <fmt/format.h>

#include "tests/support/merging_testing.h"

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

/// A wall of 1,080 bricks, and a magnet above its middle that waits at a height of its lower face
/// until 3 s, comes down to the wall, and goes up again by 3 mm in 5 s.
std::string wallUnderAMagnet(double from, double to) {
  constexpr int kColumns = 30, kRows = 36;
  std::string toml = "format = 1\n[material]\nfriction = 0.6\n" + kGround.substr(12);
  for (int row = 0; row < kRows; ++row) {
    for (int i = 0; i < kColumns; ++i) {
      toml += fmt::format("[[body]]\nname = \"b{}_{}\"\nat = [{}, {}]\nbox = [0.4, 0.2]\n", i, row,
                          0.41 * i + 0.2 * (row % 2), 0.1 + 0.2 * row);
    }
  }
  return toml + fmt::format(
                    "[[body]]\nname = \"hook\"\nmotion = \"scripted\"\nbox = [0.3, 0.2]\n"
                    "script = {{ keyframes = [[0, 6.35, {0}, 0], [3, 6.35, {0}, 0], "
                    "[5, 6.35, {1}, 0], [7, 6.35, {1}, 0], [12, 6.35, {2}, 0]] }}\n"
                    "[[magnet]]\nbody = \"hook\"\n",
                    from + 0.1, to + 0.1, to + 0.103);
}

/// Between two frames only members on their own feel each other, in a large collection too.
TEST(SlowLoad, AMagnetTakesABrickSlowlyOffALargeWall) {
  Simulation before(wallUnderAMagnet(20.0, 20.0), Mode::Merge);
  before.until(2.9);
  const double top = before.body("b15_35").x.y() + 0.1;
  Simulation run(wallUnderAMagnet(7.5, top), Mode::Merge);
  run.until(11.5);
  EXPECT_NEAR(run.body("b15_35").x.y() + 0.1, run.body("hook").x.y() - 0.1, 5e-4);
}

/// Two columns of light boxes side by side on a heavy seat that a force drives along a rail: one
/// alone would tip.
std::string columnsOnARail() {
  std::string toml =
      "format = 1\n[material]\nfriction = 0.96\n"
      "[[body]]\nname = \"seat\"\nat = [0, 0]\nbox = [3, 0.2]\nmass = 30\n"
      "[[joint]]\nkind = \"prismatic\"\nbodies = [\"seat\"]\nat = [0, 0]\n"
      "axis = [1, 0]\n"
      "[[force]]\nbody = \"seat\"\nat = [0, 0]\nforce = [109.2, 0]\nfrom = 1\n";
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 2; ++column) {
      toml += fmt::format("[[body]]\nname = \"box{}{}\"\nat = [{}, {}]\nbox = [0.7, 0.5]\n", row,
                          column, -0.54 + 0.7 * column, 0.35 + 0.5 * row);
    }
  }
  return toml;
}

/// A collection moves as one body along its rail, also where it was opened in the full solve:
/// the sum of its members' momenta turned it by a little in each step, and the columns fell.
TEST(SlowLoad, ColumnsOnARailStandAsInTheReference) {
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    SCOPED_TRACE(name(mode));
    Simulation run(columnsOnARail(), mode);
    run.until(0.99);
    ASSERT_TRUE(!merges(mode) || run.merged("seat"));
    double turned = 0.0;
    run.steps(900, [&] { turned = std::max(turned, std::abs(run.body("seat").omega)); });
    EXPECT_LT(turned, merges(mode) ? 1e-6 : 2e-3);
    EXPECT_GT(run.body("seat").x.x(), 100.0);
    const Vec2 top = run.body("box40").x - run.body("seat").x;
    const double soft = merges(mode) ? 5e-3 : 0.1;  // contacts give way
    EXPECT_NEAR(top.x(), -0.54, soft);
    EXPECT_NEAR(top.y(), 2.35, soft);
  }
}

/// A wall of three columns and six rows; the last brick of the second row is drawn out from 2 s on.
std::string wallWithADrawnBrick() {
  std::string toml = "format = 1\n[material]\nfriction = 0.47\n" + kGround.substr(12);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 3; ++column) {
      const bool drawn = row == 1 && column == 2;
      toml += fmt::format("[[body]]\nname = \"brick{}{}\"\nbox = [0.5, 0.2]\n", column, row);
      const double x = -0.55 + 0.5 * column + 0.1 * (row % 2), y = 0.1 + 0.2 * row;
      toml += drawn ? fmt::format(
                          "motion = \"scripted\"\nscript = {{ keyframes = [[0, {0}, {2}, 0], "
                          "[2, {0}, {2}, 0], [13.6, {1}, {2}, 0]] }}\n",
                          x, x + 0.6, y)
                    : fmt::format("at = [{}, {}]\n", x, y);
    }
  }
  return toml;
}

/// Where rows begin to act between two frames they go on from what was borne before they merged:
/// the overlap of that moment, which nothing deepens any more, asked for less.
TEST(SlowLoad, AFrameBearsWhatItBoreWhenItBeginsToMove) {
  Simulation run(wallWithADrawnBrick(), Mode::Merge);
  const auto borne = [&] {
    double sum = 0.0;
    for (const ContactView& c : run.now().contacts) {
      if (c.a == run.id("brick21") && c.b == run.id("brick22")) sum += c.lambda_n;
    }
    return sum;
  };
  run.until(1.9);
  ASSERT_TRUE(run.anchored("brick22"));
  const double before = borne();
  run.until(2.05);
  ASSERT_TRUE(run.anchored("brick22"));
  EXPECT_GT(before, 0.0);
  EXPECT_NEAR(borne(), before, 0.03 * before);
}

/// A box that stands on the ground, one on a cart that waits until 2 s, and a rod to each: from the
/// cart to the first, and from the world to the second.
constexpr const char* kRodsAndACart = R"(
[[body]]
name = "pulled"
at = [-4, 0.5]
box = [1, 1]
[[body]]
name = "cart"
motion = "scripted"
box = [3, 1]
script = { keyframes = [[0, 2, 0.5, 0], [2, 2, 0.5, 0], [4, 3, 0.5, 0]] }
[[body]]
name = "held"
at = [2, 1.25]
box = [0.5, 0.5]
[[joint]]
kind = "distance"
bodies = ["pulled", "cart"]
at = [-4, 0.5]
to = [1, 0.5]
[[joint]]
kind = "distance"
bodies = ["held"]
at = [2, 1.25]
to = [-2, 1.25]
)";

/// No row of the full solve stands for a joint between two frames: the welds on one of them held
/// against any pull of the other.
TEST(DraggedByAJoint, ARodToAnotherFramePullsABoxOffItsOwn) {
  for (const Overrides& rule : {Overrides{}, kPaper}) {
    for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
      SCOPED_TRACE(name(mode));
      Simulation run(kGround + kRodsAndACart, mode, rule);
      Simulation reference(kGround + kRodsAndACart, Mode::Reference);
      run.until(1.9);
      ASSERT_TRUE(run.merged("pulled"));
      ASSERT_TRUE(run.merged("held"));
      run.until(5.0);
      reference.until(5.0);
      EXPECT_NEAR(reference.body("pulled").x.x(), -3.0, 1e-3);
      EXPECT_NEAR(run.body("pulled").x.x(), -3.0, 2e-3);
      EXPECT_NEAR(reference.body("held").x.x(), 2.0, 1e-3);
      EXPECT_NEAR(run.body("held").x.x(), 2.0, 2e-3);
    }
  }
}

/// A wall of 1,200 bricks of which one on top is tied to a hoist by a rope with 10 cm of slack. The
/// hoist begins to rise at 3 s.
TEST(DraggedByAJoint, AHoistLiftsABrickOffALargeWall) {
  constexpr int kColumns = 30, kRows = 40;
  std::string toml = kGround;
  for (int row = 0; row < kRows; ++row) {
    for (int i = 0; i < kColumns; ++i) {
      toml += fmt::format("[[body]]\nname = \"b{}_{}\"\nat = [{}, {}]\nbox = [0.4, 0.2]\n", i, row,
                          0.41 * i + 0.2 * (row % 2), 0.1 + 0.2 * row);
    }
  }
  toml += R"(
[[body]]
name = "hoist"
motion = "scripted"
box = [1, 0.2]
script = { keyframes = [[0, 6.35, 10, 0], [3, 6.35, 10, 0], [4, 6.35, 10.5, 0]] }
[[joint]]
kind = "distance"
bodies = ["b15_39", "hoist"]
at = [6.35, 7.9]
to = [6.35, 10]
limits = [0, 2.2]
)";
  Simulation run(toml, Mode::MergeSleep);
  run.until(2.9);
  ASSERT_TRUE(run.merged("b15_39"));
  run.until(5.0);
  EXPECT_NEAR(run.body("b15_39").x.y(), 10.5 - 2.2, 1e-3);
  EXPECT_TRUE(run.merged("b10_20"));
}

}  // namespace
}  // namespace merge2d
