/// Welds that a bounce ends, and the records of all welds that end.

#include "src2d/merging/merge_criteria.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// Three columns of three boxes; two more fall on them from 1 s on. All of them bounce.
const std::string kBouncingHeap = kGround + R"(
[[body]]
name = "box"
at = [0, 0.25]
box = [0.5, 0.5]
restitution = 0.4
repeat = { count = [3, 3], spacing = [0.5, 0.5] }
[[body]]
name = "drop"
at = [0.2, 3]
box = [0.4, 0.4]
restitution = 0.4
pinned_until = 1
repeat = { count = [2, 1], spacing = [0.7, 1] }
)";

bool isAbout(const Decision& d, const Event& e) {
  return d.stage == "Unmerge" && d.verdict == "unmerge" &&
         ((d.a == e.a && d.b == e.b) || (d.a == e.b && d.b == e.a));
}

/// Each weld that ends in a run has a record of the test that ended it. Returns how many there are
/// of one criterion.
int expectARecordOfEachCut(Simulation& run, int steps, std::string_view criterion = {}) {
  int records = 0;
  run.steps(steps, [&] {
    const auto& decisions = run.world().notes().decisions;
    records += static_cast<int>(std::ranges::count(decisions, criterion, &Decision::criterion));
    for (const Event& e : run.world().events()) {
      if (e.type != EventType::Unmerge || e.reason == EventReason::User) continue;
      EXPECT_TRUE(std::ranges::any_of(decisions, [&](const Decision& d) { return isAbout(d, e); }))
          << "step " << run.world().steps() << ": " << index(e.a) << ", " << index(e.b);
    }
  });
  return records;
}

TEST(Bounces, EachWeldThatABounceEndsHasARecord) {
  for (const Overrides& rule : {Overrides{}, kPaper}) {
    Simulation run(kBouncingHeap, Mode::Merge, rule, true);
    EXPECT_GT(expectARecordOfEachCut(run, 300, "bounce"), 0);
  }
}

TEST(Bounces, EachWeldThatEndsHasARecord) {
  for (const char* name : {"tower-impulse", "books", "unmerge-pivot"}) {
    SCOPED_TRACE(name);
    Simulation run(loadScene(name), Mode::Merge, true);
    expectARecordOfEachCut(run, 400);
  }
}

/// A value that is recorded as one that holds is on the side of its threshold that holds.
TEST(Bounces, AWeldThatStaysHasAValueBelowItsThreshold) {
  Simulation run(loadScene("tower-impulse"), Mode::Merge, true);
  int moving = 0;
  run.steps(400, [&] {
    for (const Decision& d : run.world().notes().decisions) {
      if (d.stage != "Unmerge" || d.verdict != "keep") continue;
      EXPECT_LE(d.value, d.threshold) << d.criterion;
      moving += d.value > 0.0 ? 1 : 0;
    }
  });
  EXPECT_GT(moving, 0);
}

TEST(Bounces, ABoxOnABeltIsToldWhyItDoesNotMerge) {
  Simulation run(kGround + R"(
[[body]]
name = "belt"
motion = "pinned"
at = [0, 0.25]
box = [20, 0.5]
surface_velocity = 0.5
[[body]]
name = "crate"
at = [-5, 0.75]
box = [0.5, 0.5]
)",
                 Mode::Merge, {}, true);
  run.steps(200);
  const auto& decisions = run.world().notes().decisions;
  const auto belt = std::ranges::find(decisions, "belt", &Decision::criterion);
  ASSERT_NE(belt, decisions.end());
  EXPECT_EQ(belt->verdict, "apart");
  EXPECT_EQ(belt->value, 0.5);
  EXPECT_EQ(belt->equation, kOwnMerging);
}

}  // namespace
}  // namespace merge2d
