/// What was cut in vain bears more the next time, until it has got somewhere.

#include "src2d/merging/caution.h"

#include "src2d/dynamics/setup.h"
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

Simulation atRest(Mode mode, const Overrides& overrides = {}) {
  Simulation run(kBoxUnderBox, mode, overrides);
  run.until(1.0);
  return run;
}

double way(const Simulation& run) { return run.body("box").x.x(); }

TEST(Caution, LastsWhileAPairIsOnlyJostled) {
  Simulation reference = atRest(Mode::Reference), run = atRest(Mode::Merge);
  knock(reference, 0.2, 20);
  knock(run, 0.2, 20);
  EXPECT_GE(run.count(EventType::Unmerge), 2);
  EXPECT_LE(run.count(EventType::Unmerge), 5) << "of 20 knocks";
  EXPECT_NEAR(way(run), way(reference), 0.01) << "a hundredth of its size";
}

TEST(Caution, EndsWhereAPairGetsSomewhere) {
  Simulation reference = atRest(Mode::Reference), run = atRest(Mode::Merge);
  knock(reference, 0.35, 20);
  knock(run, 0.35, 20);
  EXPECT_GE(run.count(EventType::Unmerge), 20) << "at each knock";
  EXPECT_GT(way(reference), 0.03);
  EXPECT_NEAR(way(run), way(reference), 0.05 * way(reference));
}

TEST(Caution, DoesNotHoldWhatIsStruckHard) {
  Simulation reference = atRest(Mode::Reference), run = atRest(Mode::Merge);
  const auto lastWay = [](Simulation& r) {
    knock(r, 0.2, 20);
    const double from = way(r);
    knock(r, 3.0, 1);
    return way(r) - from;
  };
  const double expected = lastWay(reference);
  EXPECT_GT(expected, 0.05);
  EXPECT_NEAR(lastWay(run), expected, 0.05 * expected);
}

TEST(Caution, IsLessWhileAJoltStillCounts) {
  merge2d::Setup setup;
  setUp(column(2), Mode::Merge, setup);
  Collection c;
  c.contacts.resize(1);
  Weld weld;
  EXPECT_EQ(cautionWith(setup.state, c, weld), 1.0);
  weld.vain = kMostVainWhenJolted;
  const double before = cautionWith(setup.state, c, weld);
  weld.vain = kMostVain;
  EXPECT_GT(cautionWith(setup.state, c, weld), before);
  c.jolted = 1;
  EXPECT_EQ(cautionWith(setup.state, c, weld), before) << "as that may well move it";
}

TEST(Caution, IsNotInThePapersRule) {
  Simulation run = atRest(Mode::Merge, kPaper);
  knock(run, 0.2, 20);
  EXPECT_GE(run.count(EventType::Unmerge), 20);
}

}  // namespace
}  // namespace merge2d
