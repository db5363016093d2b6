#include "src2d/merging/merge.h"

#include <gtest/gtest.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

const std::string kBox = kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
)";

TEST(Merge, ABoxOnTheGroundMerges) {
  const std::int64_t step = mergeStep(kBox, "box");
  EXPECT_GT(step, 2);
  EXPECT_LT(step, 150);
}

TEST(Merge, NothingMergesInTheModesWithoutMerging) {
  for (const Mode mode : {Mode::Reference, Mode::Sleep}) {
    Simulation run(kBox, mode);
    run.steps(300, [&] { ASSERT_FALSE(run.merged("box")); });
    EXPECT_EQ(run.count(EventType::Merge), 0);
  }
}

TEST(Merge, NeedsTheGivenNumberOfConsecutiveSteps) {
  const std::int64_t at_3 = mergeStep(kBox, "box", {{"merging.steps", "3"}});
  const std::int64_t at_13 = mergeStep(kBox, "box", {{"merging.steps", "13"}});
  EXPECT_EQ(at_13, at_3 + 10);
}

TEST(Merge, AnInterruptionStartsTheCountAnew) {
  const std::int64_t undisturbed = mergeStep(kBox, "box", {{"merging.steps", "50"}});
  ASSERT_GE(undisturbed, 50);
  Simulation run(kBox, Mode::Merge, {{"merging.steps", "50"}});
  run.steps(static_cast<int>(undisturbed) - 2);
  run.kick("box", {2.0, 0.0});  // slides for 0.34 s
  run.steps(34 + 45);
  EXPECT_FALSE(run.merged("box"));
  run.steps(60);
  EXPECT_TRUE(run.merged("box"));
}

const std::string kPile = kGround + R"(
[[body]]
name = "b"
at = [0, 0.6]
box = [1, 1]
repeat = { count = [3, 4], spacing = [1.05, 1.1], stagger = 0.4 }
[[body]]
name = "disc"
at = [1, 6]
circle = 0.5
repeat = { count = [2, 1], spacing = [1.3, 1] }
)";

TEST(Merge, EveryMergedPairWasBelowAllThresholdsForTheGivenSteps) {
  Simulation run(kPile, Mode::Merge, {}, true);
  std::map<std::pair<BodyId, BodyId>, int> below;  // consecutive steps
  const MergingSettings& merging = run.world().scene().settings.merging;
  const std::map<std::string, double> thresholds{{"relative-motion", merging.velocity},
                                                 {"sliding", merging.sliding},
                                                 {"breathing", merging.breathing}};
  run.steps(500, [&] {
    const Snapshot now = run.now();
    std::map<std::pair<BodyId, BodyId>, bool> ok;
    for (const Decision& d : now.decisions) {
      if (d.stage != "AccumulateRelativeMotion") continue;
      const auto pair = std::pair(d.a, d.b);
      if (!ok.contains(pair)) ok[pair] = true;
      const bool under = d.verdict == "below";
      ok[pair] = ok[pair] && under;
      const auto threshold = thresholds.find(std::string(d.criterion));
      if (threshold == thresholds.end()) continue;
      EXPECT_EQ(d.threshold, threshold->second);
      EXPECT_EQ(under, d.value < d.threshold);
    }
    for (auto& [pair, count] : below) count = ok.contains(pair) && ok[pair] ? count : 0;
    for (const auto& [pair, good] : ok) below[pair] = good ? below[pair] + 1 : 0;
    for (const Event& e : now.events) {
      if (e.type != EventType::Merge) continue;
      EXPECT_GE(below[std::pair(e.a, e.b)], merging.steps)
          << "bodies " << index(e.a) << " and " << index(e.b) << " in step " << now.step;
    }
  });
  EXPECT_GT(run.count(EventType::Merge), 5);
}

/// The source of the test of relative motion of a box of that width on the ground.
std::string_view sourceForABoxOf(double width) {
  Scene scene = onGround();
  add(scene, box(width, width, {0.0, 0.5 * width}));
  Simulation run(scene, Mode::Merge, true);
  std::string_view source;
  run.steps(5, [&] {
    for (const Decision& d : run.world().notes().decisions) {
      if (d.criterion == "relative-motion") source = d.equation;
    }
  });
  return source;
}

/// Thresholds of small bodies are a part of the paper's.
TEST(Merge, ThresholdsOfSmallBodiesAreNotCitedAsThePapers) {
  EXPECT_EQ(sourceForABoxOf(1.0), "(17)");
  EXPECT_EQ(sourceForABoxOf(0.005), kOwnMerging);
}

TEST(Merge, WaitsWhileTheContactBreathes) {
  const std::int64_t strict = mergeStep(kPile, "b[1,3]", {{"merging.breathing", "1e-6"}});
  const std::int64_t normal = mergeStep(kPile, "b[1,3]");
  const std::int64_t loose = mergeStep(kPile, "b[1,3]", {{"merging.breathing", "1e-3"}});
  ASSERT_GT(strict, 0);
  ASSERT_GT(normal, 0);
  ASSERT_GT(loose, 0);
  EXPECT_GT(strict, normal);
  EXPECT_GE(normal, loose);
}

/// Per pair of bodies, the impulse along the normals of their contacts [N s].
std::map<std::pair<BodyId, BodyId>, double> borneByPairs(const Snapshot& now) {
  std::map<std::pair<BodyId, BodyId>, double> borne;
  for (const ContactView& c : now.contacts) borne[{c.a, c.b}] += c.lambda_n;
  return borne;
}

/// The smallest impulse of a pair of a wall when it merges, as a part of its impulse in the end.
/// All bricks are put in their places without weight.
double leastBorneAtMerge(const Overrides& overrides) {
  Simulation run(kGround + R"(
[[body]]
name = "brick"
at = [-9.5, 0.5]
box = [1, 1]
repeat = { count = [20, 40], spacing = [1.0, 1], stagger = 0.5 }
)",
                 Mode::Merge, overrides);
  std::map<std::pair<BodyId, BodyId>, double> then, before;
  run.steps(400, [&] {
    for (const Event& e : run.world().events()) {
      if (e.type == EventType::Merge) then[{e.a, e.b}] = before[{e.a, e.b}];
    }
    before = borneByPairs(run.now());
  });
  double least = 1.0;
  for (const auto& [pair, in_the_end] : before) {
    constexpr double kWeight = 9.81 * 0.01;  // of a brick in a step [N s]
    if (in_the_end <= kWeight || !then.contains(pair)) continue;
    least = std::min(least, then[pair] / in_the_end);
  }
  return least;
}

TEST(Merge, APairWaitsUntilItsImpulseHasSettled) {
  EXPECT_GT(leastBorneAtMerge({}), 0.5);
  EXPECT_LT(leastBorneAtMerge(kPaper), 0.1);
}

/// The force that holds the box on its circle turns faster than a load may change.
TEST(Merge, ABoxThatADrumSwingsAroundMerges) {
  Simulation run(R"(
format = 1
gravity = [0, 0]
step = 0.001
[[body]]
name = "drum"
motion = "scripted"
at = [0, 0]
shapes = [{ box = [0.5, 4], at = [2.5, 0] }, { box = [0.5, 4], at = [-2.5, 0] }]
script = { velocity = [0, 0], spin = 150 }
[[body]]
name = "box"
at = [1.75, 0]
box = [1, 1]
velocity = [0, 4.58149]
spin = 150
)",
                 Mode::Merge);
  run.until(1.0);
  EXPECT_TRUE(run.anchored("box"));
}

// A box on a slope of 31°, a little steeper than arctan 0.6 = 30.96°: it slides off at 7 mm/s².
const std::string kSteep = R"(
format = 1
[[body]]
name = "slope"
motion = "pinned"
box = [40, 1]
angle = 31
[[body]]
name = "box"
at = [-0.5150380749, 0.8571673007]
angle = 31
box = [1, 1]
)";

TEST(Merge, APairOnTheEdgeOfItsConeWaits) { EXPECT_EQ(mergeStep(kSteep, "box"), 0); }

TEST(Merge, APairOnTheEdgeOfItsConeMergesUnderThePapersRule) {
  EXPECT_GT(mergeStep(kSteep, "box", {{"merging.rule", "\"paper\""}}), 0);
}

TEST(Merge, APairOnTheEdgeOfItsConeStaysUnderThePapersRules) {
  const auto wayIn10Seconds = [](const Overrides& overrides) {
    Simulation run(kSteep, Mode::Merge, overrides);
    const Vec2 start = run.body("box").x;
    run.until(10.0);
    return (run.body("box").x - start).norm();
  };
  EXPECT_NEAR(wayIn10Seconds({}), 0.36, 0.01);  // exactly 0.36 m
  EXPECT_NEAR(wayIn10Seconds(kPaper), 0.0, 1e-3);
}

/// A box lands beside another, along which it slid, and comes to rest on the same ground: bodies
/// that are fixed to one frame do not slide, whatever they did before.
TEST(Merge, TwoThatSlidAlongEachOtherMergeOnceBothRestOnOneFrame) {
  for (const double aside : {-1.0, -2.0, -4.0}) {
    Simulation run(kGround + R"(
[[body]]
name = "stop"
motion = "pinned"
at = [-1, 0.5]
box = [1, 1]
[[body]]
name = "left"
at = [0, 0.5]
box = [1, 1]
[[body]]
name = "right"
at = [1, 0.55]
box = [1, 1]
)",
                   Mode::Merge);
    run.world().setGravity({aside, -9.81});
    run.until(2.0);
    EXPECT_TRUE(run.merged("right"));
    EXPECT_EQ(run.collectionOf("left"), run.collectionOf("right")) << aside;
  }
}

TEST(Merge, ABoxOnASlopeItCanHoldMerges) {
  std::string gentle = kSteep;
  for (std::size_t at; (at = gentle.find("angle = 31")) != std::string::npos;) {
    gentle.replace(at, 10, "angle = 30");
  }
  gentle.replace(gentle.find("[-0.5150380749, 0.8571673007]"), 29, "[-0.5, 0.8660254038]");
  EXPECT_GT(mergeStep(gentle, "box"), 0);
}

TEST(Merge, ADiscOnTheFloorIsNotWeldedAlone) {
  const std::string disc = kGround + "[[body]]\nname = \"disc\"\nat = [0, 0.5]\ncircle = 0.5\n";
  EXPECT_EQ(mergeStep(disc, "disc"), 0);
  EXPECT_GT(mergeStep(disc, "disc", {{"merging.rule", "\"paper\""}}), 0);
}

const std::string kGroove = R"(
format = 1
[[body]]
name = "groove"
motion = "pinned"
shapes = [ { box = [6, 1], at = [-2, 0], angle = -30 }, { box = [6, 1], at = [2, 0], angle = 30 } ]
)";

TEST(Merge, ADiscInAGrooveIsWelded) {
  EXPECT_GT(mergeStep(kGroove + "[[body]]\nname = \"disc\"\nat = [0, 1.1]\ncircle = 0.8\n", "disc"),
            0);
}

// Each disc rests on its own side of a flat groove and leans on the other: one contact per pair.
const std::string kLeaning = R"(
format = 1
[[body]]
name = "left"
motion = "pinned"
at = [-5, 0]
box = [10, 1]
angle = -10
[[body]]
name = "right"
motion = "pinned"
at = [5, 0]
box = [10, 1]
angle = 10
[[body]]
name = "disc"
at = [-0.5, 0.22]
circle = 0.5
repeat = { count = [2, 1], spacing = [1, 1] }
)";

TEST(Merge, DiscsThatLeanOnEachOtherAreWeldedAsACycleOfThree) {
  Simulation run(kLeaning, Mode::Merge);
  run.until(5.0);
  const Snapshot now = run.now();
  int outer = 0;
  for (const ContactView& c : now.contacts) outer += c.lambda_n > 0.0 ? 1 : 0;
  ASSERT_EQ(outer, 3) << "three contacts carry a force";
  EXPECT_TRUE(run.merged("disc[0,0]"));
  EXPECT_EQ(run.collectionOf("disc[0,0]"), run.collectionOf("disc[1,0]"));
}

const std::string kTwoDiscs = kGround + R"(
[[body]]
name = "disc"
at = [0, 0.5]
circle = 0.5
[[body]]
name = "upper"
at = [0.001, 1.5]
circle = 0.5
)";

TEST(Merge, TwoDiscsStackedAreNotWelded) {
  Simulation run(kTwoDiscs, Mode::Merge);
  run.steps(500, [&] { ASSERT_FALSE(run.merged("upper")); });
  EXPECT_LT(run.body("upper").x.y(), 0.7) << "it has fallen";
}

TEST(Merge, UnderThePapersRulesADiscStaysOnTopOfAnother) {
  Simulation run(kTwoDiscs, Mode::Merge, kPaper);
  run.until(5.0);
  EXPECT_TRUE(run.merged("upper"));
  EXPECT_NEAR(run.body("upper").x.y(), 1.5, 0.01);
}

TEST(Merge, WeldedToAPinnedBodyIsAnchoredAndStill) {
  Simulation run(kBox, Mode::Merge);
  run.until(2.0);
  const Snapshot now = run.now();
  ASSERT_EQ(now.collections.size(), 1u);
  EXPECT_TRUE(now.collections[0].anchored);
  EXPECT_EQ(now.bodies[1].v, Vec2(0.0, 0.0));
  EXPECT_EQ(now.bodies[1].omega, 0.0);
}

}  // namespace
}  // namespace merge2d
