/// Welds that a bounce ends, and the records of all welds that end.

#include <fmt/format.h>

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

/// How high a disc of that mass rises that falls by 1.5 m on a merged stack of boxes of 1 kg [m].
/// The boxes do not bounce.
double riseAfterAFall(int boxes, double mass, const Overrides& overrides = {}) {
  const double top = 0.5 * boxes;
  Simulation run(kGround + fmt::format(R"(
[[body]]
name = "box"
at = [0, 0.25]
box = [1, 0.5]
mass = 1
repeat = {{ count = [1, {}], spacing = [1, 0.5] }}
[[body]]
name = "disc"
at = [0, {}]
circle = 0.2
mass = {}
restitution = 0.8
pinned_until = 1.0
)",
                                       boxes, top + 0.2 + 1.5, mass),
                 Mode::Merge, overrides);
  run.until(1.0);
  EXPECT_TRUE(run.anchored(fmt::format("box[0,{}]", boxes - 1)));
  run.until(1.6);  // it falls for 0.553 s
  double highest = 0.0;
  run.steps(80, [&] { highest = std::max(highest, run.body("disc").x.y() - top - 0.2); });
  return highest;
}

/// A stack on the ground bears a bounce, whether its bodies are merged or not.
TEST(Bounces, ADiscBouncesOffAMergedStackByItsRestitution) {
  for (const int boxes : {1, 3, 6}) {
    for (const double mass : {0.01, 1.0, 5.0}) {
      EXPECT_NEAR(riseAfterAFall(boxes, mass), 0.8 * 0.8 * 1.5, 0.01) << boxes << ", " << mass;
    }
  }
}

/// Two boxes in free space that forces press together; a disc flies at them.
const std::string kRaft = R"(
format = 1
gravity = [0, 0]
[[body]]
name = "a"
at = [0, 0]
box = [1, 1]
mass = 2
[[body]]
name = "b"
at = [1, 0]
box = [1, 1]
mass = 2
[[force]]
body = "a"
force = [2, 0]
[[force]]
body = "b"
force = [-1, 0]
[[body]]
name = "disc"
at = [-8, 0]
circle = 0.3
mass = 1
velocity = [4, 0]
restitution = 0.8
)";

TEST(Bounces, ADiscBouncesOffAMergedRaftAsOffTwoBoxes) {
  Simulation merged(kRaft, Mode::Merge), reference(kRaft, Mode::Reference);
  merged.until(1.5);
  EXPECT_TRUE(merged.merged("b"));
  for (Simulation* run : {&merged, &reference}) run->until(5.0);
  for (const char* body : {"a", "b", "disc"}) {
    EXPECT_NEAR(merged.body(body).v.x(), reference.body(body).v.x(), 0.01) << body;
    EXPECT_NEAR(merged.body(body).x.x(), reference.body(body).x.x(), 0.01) << body;
  }
}

/// A stack of boxes of 1 kg, all of which bounce.
std::string bouncingStack(int boxes, double e) {
  return fmt::format(R"(
format = 1
[material]
restitution = {}
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [400, 1]
[[body]]
name = "box"
at = [0, 0.2]
box = [1, 0.4]
mass = 1
repeat = {{ count = [1, {}], spacing = [1, 0.4] }}
)",
                     e, boxes);
}

/// How high the highest body rises in the second after now [m].
double riseOf(Simulation& run, const std::string& body) {
  double highest = -1e9;
  run.steps(100, [&] { highest = std::max(highest, run.body(body).x.y()); });
  return highest;
}

/// J/m comes back from the ground as e J/m.
TEST(Bounces, AMergedBoxThatIsKickedDownRisesByItsRestitution) {
  for (const double e : {0.5, 1.0}) {
    Simulation run(bouncingStack(1, e), Mode::Merge);
    run.until(1.0);
    EXPECT_TRUE(run.anchored("box[0,0]"));
    run.kick("box[0,0]", {0, -2});
    const double v = 2.0 * e;
    EXPECT_NEAR(riseOf(run, "box[0,0]"), 0.2 + v * v / (2.0 * kGravity), 0.012) << e;
  }
}

/// As in Newton's cradle: the last one has it all, also where a kick stands for the first ball.
TEST(Bounces, AKickGoesThroughAMergedRowToTheLastBox) {
  const std::string row = R"(
format = 1
[material]
restitution = 1
friction = 0.05
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [400, 1]
[[body]]
name = "box"
at = [0, 0.2]
box = [0.6, 0.4]
mass = 1
repeat = { count = [4, 1], spacing = [0.6, 1] }
)";
  Simulation run(row, Mode::Merge);
  run.until(1.0);
  EXPECT_TRUE(run.anchored("box[3,0]"));
  run.kick("box[0,0]", {2, 0});
  run.until(8.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(run.body(fmt::format("box[{},0]", i)).x.x(), 0.6 * i, 0.01) << i;
  }
  EXPECT_NEAR(run.body("box[3,0]").x.x(), 1.8 + 4.0 / (2.0 * 0.05 * kGravity), 0.05);
}

/// Hits go on between the ball, the boxes and the ground in the step in which it arrives.
TEST(Bounces, AStackOfWhichEachBoxBouncesIsHitAsInTheReference) {
  for (const int boxes : {1, 2, 3}) {
    for (const double e : {0.3, 0.5, 1.0}) {
      const double top = 0.4 * boxes;
      const std::string toml = bouncingStack(boxes, e) + fmt::format(R"(
[[body]]
name = "disc"
at = [0, {:.3f}]
circle = 0.2
mass = 1
pinned_until = 1.0
)",
                                                                     top + 2.0);
      Simulation merged(toml, Mode::Merge), reference(toml, Mode::Reference);
      merged.until(1.0);
      EXPECT_TRUE(merged.anchored(fmt::format("box[0,{}]", boxes - 1)));
      for (Simulation* run : {&merged, &reference}) run->until(1.7);
      EXPECT_NEAR(riseOf(merged, "disc"), riseOf(reference, "disc"), 0.01) << boxes << ", " << e;
    }
  }
}

/// Nothing outside acts on them, so that their angular momentum stays.
TEST(Bounces, MergedBodiesThatFloatKeepTheirAngularMomentumAtABounce) {
  const std::string pair = R"(
format = 1
gravity = [0, 0]
[material]
restitution = 0.5
friction = 1
[[body]]
name = "a"
at = [0, 0]
box = [0.6, 0.3]
mass = 1
[[body]]
name = "b"
at = [0, 0.3]
box = [0.6, 0.3]
mass = 1
[[spring]]
body = "a"
anchor = [0, 0]
to_body = "b"
stiffness = 60
[[body]]
name = "disc"
at = [3, 0.0285]
circle = 0.15
mass = 1.7
velocity = [-2.789, 0]
)";
  Simulation run(pair, Mode::Merge);
  run.until(0.8);
  EXPECT_TRUE(run.merged("a"));
  const double before = run.now().stats.angular_momentum;
  run.until(1.2);
  EXPECT_GT(run.body("disc").v.x(), -2.5);
  EXPECT_NEAR(run.now().stats.angular_momentum, before, 1e-9);
}

/// A box beside the stack, which a slider holds to its lower box, has merged with the ground and
/// leaves it too.
TEST(Bounces, ABounceFreesThoseThatJointsHoldToTheStack) {
  const std::string toml = bouncingStack(2, 0.5) + R"(
[[body]]
name = "far"
at = [1.6, 0.2]
box = [1, 0.4]
mass = 1
[[joint]]
kind = "prismatic"
bodies = ["box[0,0]", "far"]
at = [0.8, 0.2]
axis = [1, 0]
[[body]]
name = "disc"
at = [0, 2.8]
circle = 0.2
mass = 1
pinned_until = 1.0
)";
  Simulation merged(toml, Mode::Merge), reference(toml, Mode::Reference);
  merged.until(1.0);
  EXPECT_TRUE(merged.anchored("far"));
  for (Simulation* run : {&merged, &reference}) run->until(1.7);
  for (const char* body : {"disc", "far", "box[0,1]"}) {
    EXPECT_NEAR(merged.body(body).v.y(), reference.body(body).v.y(), 0.05) << body;
  }
}

/// The disc does not bounce off the box that it hits, but that box bounces off the next one below.
TEST(Bounces, AHitThatDoesNotBounceSetsOffOneThatDoes) {
  Scene scene = onGround();
  scene.step = 1.0 / 240.0;
  for (int i = 0; i < 4; ++i) add(scene, box(0.5, 0.7, {0, 0.35 + 0.7 * i}));
  scene.bodies[3].restitution = 0.4;
  BodyDesc striker = named("disc", moving(disc(0.2, {0.1, 4.0}), {8.7, -30.0}));
  striker.mass = 1.3;
  striker.pinned_until = 1.6;
  add(scene, striker);
  for (BodyDesc& b : scene.bodies) b.friction = 0.3;
  World reference(scene, inMode(Mode::Reference)), merged(scene, inMode(Mode::Merge));
  runSeconds(merged, 1.5);
  ASSERT_EQ(merged.capture().stats.collections, 1);
  runSeconds(merged, 0.2);
  runSeconds(reference, 1.7);
  for (std::uint32_t i = 1; i < 6; ++i) {
    const BodyState a = see(merged, BodyId{i}), b = see(reference, BodyId{i});
    EXPECT_LT((a.v - b.v).norm(), 0.1) << "body " << i;
    EXPECT_NEAR(a.omega, b.omega, 0.3) << "body " << i;
  }
}

}  // namespace
}  // namespace merge2d
