/// Rows of boxes on the ground that are hit from the side.

#include <fmt/format.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

constexpr double kHit = 3.0;   // s
constexpr double kSize = 0.5;  // m

std::string row(int count) {
  return kGround + fmt::format(R"(
[[body]]
name = "box"
at = [0, 0.25]
box = [0.5, 0.5]
repeat = {{ count = [{}, 1], spacing = [0.5, 1] }}
)",
                               count);
}

std::string boxOf(int i) { return fmt::format("box[{},0]", i); }

/// How far the last of ten boxes in a row goes when the first is hit from the side [m].
std::pair<double, double> rowHit(Mode mode, double impulse, const Overrides& overrides = {}) {
  Simulation run(row(10), mode, overrides);
  run.until(kHit);
  const double first = run.body("box[0,0]").x.x(), last = run.body("box[9,0]").x.x();
  run.kick("box[0,0]", {impulse, 0.0});
  run.until(kHit + 5.0);
  return {run.body("box[0,0]").x.x() - first, run.body("box[9,0]").x.x() - last};
}

class RowHit : public testing::TestWithParam<double> {};

void expectNear(const std::pair<double, double>& merged, const std::pair<double, double>& reference,
                double part) {
  const double scale = std::max(reference.first, reference.second);
  EXPECT_GT(scale, 0.005);
  EXPECT_NEAR(merged.first, reference.first, part * scale);
  EXPECT_NEAR(merged.second, reference.second, part * scale);
}

/// With ten iterations the row of a gentle blow is a third off in the reference itself.
TEST_P(RowHit, MovesAsInAReferenceThatHasConverged) {
  const Overrides converged{{"solver.iterations", "30"}};
  expectNear(rowHit(Mode::Merge, GetParam(), converged),
             rowHit(Mode::Reference, GetParam(), converged), 0.02);
}
INSTANTIATE_TEST_SUITE_P(Impulses, RowHit, testing::Values(1.0, 3.0, 10.0));

/// What the blow does to a box of the row.
struct Struck {
  double way = 0.0;    ///< the farthest it gets in the reference within 0.5 s [m]
  bool freed = false;  ///< of all others within that time, where it is merged
  bool left = false;   ///< the ground, alone or with others
  double off = 0.0;    ///< how far it is from where it is in the reference, 2 s after [m]
};

std::vector<Struck> blowAt(int count, double impulse, int iterations, Mode mode = Mode::Merge) {
  const Overrides converged{{"solver.iterations", std::to_string(iterations)}};
  Simulation reference(row(count), Mode::Reference, converged);
  Simulation merged(row(count), mode, converged);
  std::vector<Struck> boxes(static_cast<std::size_t>(count));
  std::vector<double> start;
  for (Simulation* run : {&reference, &merged}) {
    run->until(kHit);
    run->kick(boxOf(0), {impulse, 0.0});
  }
  for (int i = 0; i < count; ++i) start.push_back(reference.body(boxOf(i)).x.x());
  for (int step = 0; step < 50; ++step) {
    reference.steps(1), merged.steps(1);
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      Struck& box = boxes[at];
      box.way = std::max(box.way, std::abs(reference.body(boxOf(i)).x.x() - start[at]));
      box.freed |= !merged.merged(boxOf(i));
      box.left |= !merged.anchored(boxOf(i));
    }
  }
  reference.until(kHit + 2.0), merged.until(kHit + 2.0);
  for (int i = 0; i < count; ++i) {
    boxes[static_cast<std::size_t>(i)].off =
        (merged.body(boxOf(i)).x - reference.body(boxOf(i)).x).norm();
  }
  return boxes;
}

/// Ten iterations do not carry a blow through twenty boxes: the reference is off by half its way.
TEST(RowHit, FreesWhatMovesAndLittleElseAndStaysCloseToTheReference) {
  for (const auto& [count, iterations] : {std::pair(3, 10), {10, 10}, {20, 30}}) {
    for (const double impulse : {2.0, 3.0, 10.0}) {
      SCOPED_TRACE(fmt::format("{} boxes, {} N s", count, impulse));
      int moved = 0, others = 0, others_freed = 0;
      for (const Struck& box : blowAt(count, impulse, iterations)) {
        const bool moves = box.way > 0.01 * kSize;
        ++(moves ? moved : others);
        EXPECT_TRUE(box.freed || !moves) << box.way << " m";
        others_freed += !moves && box.freed;
        EXPECT_LT(box.off, 0.05 * kSize);
      }
      EXPECT_GT(moved, 0);
      EXPECT_LE(others_freed, 0.1 * others);
    }
  }
}

/// A gentle blow moves the boxes of a long row ever less, or dies out in it. What it moves is free
/// to move, be it by less than the 1% of a box that others ask for; what stands stays on the
/// ground. Returns how many stand.
int expectFreesOnlyWhatItMoves(int count, double impulse, int iterations, Mode mode) {
  constexpr double kStands = 1e-5;  // m
  SCOPED_TRACE(
      fmt::format("{} boxes, {} N s, {} iterations, {}", count, impulse, iterations, name(mode)));
  const double close = count == 20 && iterations == 10 ? 0.01 : 0.005;  // of a box
  const std::vector<Struck> boxes = blowAt(count, impulse, iterations, mode);
  EXPECT_TRUE(boxes.front().left);
  for (const Struck& box : boxes) {
    EXPECT_TRUE(box.left || box.way < 0.01 * kSize) << box.way << " m";
    EXPECT_TRUE(!box.left || box.way > kStands) << box.way << " m";
    EXPECT_LT(box.off, close * kSize);
  }
  return static_cast<int>(
      std::ranges::count_if(boxes, [](const Struck& box) { return box.way <= kStands; }));
}

TEST(RowHit, AGentleBlowFreesOnlyWhatItMoves) {
  EXPECT_EQ(expectFreesOnlyWhatItMoves(3, 0.15, 10, Mode::Merge), 0);
  EXPECT_EQ(expectFreesOnlyWhatItMoves(10, 0.5, 10, Mode::Merge), 0);
  EXPECT_GT(expectFreesOnlyWhatItMoves(20, 0.15, 30, Mode::Merge), 5);
  EXPECT_GT(expectFreesOnlyWhatItMoves(20, 0.25, 10, Mode::Merge), 5);
  EXPECT_GE(expectFreesOnlyWhatItMoves(20, 0.5, 10, Mode::Merge), 0);
}

TEST(LongRowHit, AGentleBlowFreesOnlyWhatItMoves) {
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    for (const double impulse : {0.15, 0.25, 0.5, 1.0, 1.5}) {
      for (const int count : {3, 10, 20}) {
        for (const int iterations : {10, 30}) {
          expectFreesOnlyWhatItMoves(count, impulse, iterations, mode);
        }
      }
    }
  }
}

}  // namespace
}  // namespace merge2d
