/// Rows of boxes on the ground that are hit from the side.

#include <fmt/format.h>

#include "tests/src2d/merging/merging_testing.h"

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

TEST_P(RowHit, MovesAsInTheReference) {
  expectNear(rowHit(Mode::Merge, GetParam()), rowHit(Mode::Reference, GetParam()), 0.05);
}

/// With ten iterations the row of a gentle blow is a third off itself, in the reference too.
TEST_P(RowHit, MovesAsInAReferenceThatHasConverged) {
  const Overrides converged{{"solver.iterations", "30"}};
  expectNear(rowHit(Mode::Merge, GetParam(), converged),
             rowHit(Mode::Reference, GetParam(), converged), 0.02);
}
TEST_P(RowHit, MovesAsInAReferenceThatHasNotConverged) {
  const auto reference = rowHit(Mode::Reference, GetParam());
  const auto merged = rowHit(Mode::Merge, GetParam());
  const double enough = std::max(0.05 * reference.first, 0.002);  // 0.4% of a box
  EXPECT_NEAR(merged.first, reference.first, enough);
  EXPECT_NEAR(merged.second, reference.second, enough);
}
INSTANTIATE_TEST_SUITE_P(Impulses, RowHit, testing::Values(1.0, 3.0, 10.0));

/// What the blow does to the row in the reference and when merged.
struct Blow {
  int moved = 0, moved_freed = 0;    ///< more than 1% of a box in the reference, within 0.5 s
  int others = 0, others_freed = 0;  ///< less
  double farthest = 0.0;  ///< of all boxes from where they are in the reference, 2 s after [m]
};

Blow blowAt(int count, double impulse, int iterations) {
  const Overrides converged{{"solver.iterations", std::to_string(iterations)}};
  Simulation reference(row(count), Mode::Reference, converged);
  Simulation merged(row(count), Mode::Merge, converged);
  std::vector<double> start, way(static_cast<std::size_t>(count), 0.0);
  std::vector<bool> freed(static_cast<std::size_t>(count), false);
  for (Simulation* run : {&reference, &merged}) {
    run->until(kHit);
    run->kick(boxOf(0), {impulse, 0.0});
  }
  for (int i = 0; i < count; ++i) start.push_back(reference.body(boxOf(i)).x.x());
  for (int step = 0; step < 50; ++step) {
    reference.steps(1), merged.steps(1);
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      way[at] = std::max(way[at], std::abs(reference.body(boxOf(i)).x.x() - start[at]));
      freed[at] = freed[at] || !merged.merged(boxOf(i));
    }
  }
  reference.until(kHit + 2.0), merged.until(kHit + 2.0);
  Blow blow;
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool moves = way[at] > 0.01 * kSize;
    ++(moves ? blow.moved : blow.others);
    (moves ? blow.moved_freed : blow.others_freed) += freed[at];
    const double off = (merged.body(boxOf(i)).x - reference.body(boxOf(i)).x).norm();
    blow.farthest = std::max(blow.farthest, off);
  }
  return blow;
}

/// Ten iterations do not carry a blow through twenty boxes: the reference is off by half its way.
TEST(RowHit, FreesWhatMovesAndLittleElseAndStaysCloseToTheReference) {
  for (const auto& [count, iterations] : {std::pair(3, 10), {10, 10}, {20, 30}}) {
    for (const double impulse : {2.0, 3.0, 10.0}) {
      const Blow blow = blowAt(count, impulse, iterations);
      EXPECT_GT(blow.moved, 0) << count << " boxes, " << impulse << " N s";
      EXPECT_EQ(blow.moved_freed, blow.moved) << count << " boxes, " << impulse << " N s";
      EXPECT_LE(blow.others_freed, 0.1 * blow.others) << count << " boxes, " << impulse << " N s";
      EXPECT_LT(blow.farthest, 0.05 * kSize) << count << " boxes, " << impulse << " N s";
    }
  }
}

}  // namespace
}  // namespace merge2d
