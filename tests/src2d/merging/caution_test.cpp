/// What was cut in vain bears more the next time, until it has got somewhere.

#include "tests/src2d/merging/merging_testing.h"

namespace merge2d {
namespace {

const std::string kBoxUnderBox = kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
[[body]]
name = "top"
at = [0.3, 1.5]
box = [1, 1]
)";

/// Knocks the lower box sideways [N s], two times a second.
void knock(Simulation& run, double impulse, int times) {
  for (int i = 0; i < times; ++i) {
    run.kick("box", {impulse, 0.0});
    run.steps(50);
  }
}

Simulation merged(Mode mode) {
  Simulation run(kBoxUnderBox, mode);
  run.until(1.0);
  return run;
}

double way(const Simulation& run) { return run.body("box").x.x(); }

TEST(Caution, LastsWhileAPairIsOnlyJostled) {
  Simulation reference = merged(Mode::Reference), run = merged(Mode::Merge);
  knock(reference, 0.2, 20);
  knock(run, 0.2, 20);
  EXPECT_GE(run.count(EventType::Unmerge), 2);
  EXPECT_LE(run.count(EventType::Unmerge), 5) << "of 20 knocks";
  EXPECT_NEAR(way(run), way(reference), 0.01) << "a hundredth of its size";
}

TEST(Caution, EndsWhereAPairGetsSomewhere) {
  Simulation reference = merged(Mode::Reference), run = merged(Mode::Merge);
  knock(reference, 0.35, 20);
  knock(run, 0.35, 20);
  EXPECT_GE(run.count(EventType::Unmerge), 20) << "at each knock";
  EXPECT_GT(way(reference), 0.03);
  EXPECT_NEAR(way(run), way(reference), 0.05 * way(reference));
}

TEST(Caution, DoesNotHoldWhatIsStruckHard) {
  Simulation reference = merged(Mode::Reference), run = merged(Mode::Merge);
  for (Simulation* r : {&reference, &run}) {
    knock(*r, 0.2, 20);
    r->steps(1);
  }
  const double from = way(run), from_reference = way(reference);
  knock(reference, 3.0, 1);
  knock(run, 3.0, 1);
  EXPECT_GT(way(reference) - from_reference, 0.05);
  EXPECT_NEAR(way(run) - from, way(reference) - from_reference,
              0.05 * (way(reference) - from_reference));
}

TEST(Caution, IsNotInThePapersRule) {
  Simulation run(kBoxUnderBox, Mode::Merge, kPaper);
  run.until(1.0);
  knock(run, 0.2, 20);
  EXPECT_GE(run.count(EventType::Unmerge), 20);
}

}  // namespace
}  // namespace merge2d
