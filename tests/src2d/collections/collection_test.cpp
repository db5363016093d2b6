#include "src2d/collections/collection.h"

#include <gtest/gtest.h>

#include "src2d/setup.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

// An L of three unit boxes: the corner at the origin.
const std::string kL = R"(
format = 1
gravity = [0, 0]
[[body]]
name = "corner"
box = [1, 1]
[[body]]
name = "right"
at = [1, 0]
box = [1, 1]
[[body]]
name = "top"
at = [0, 1]
box = [1, 1]
)";

TEST(Collection, AnLOfBoxesHasItsCentreAndInertia) {
  merge2d::Setup setup;
  setUp(parseScene(kL, "l.toml"), Mode::Merge, setup);
  State& state = setup.state;
  const RigidId first = mergeRigids(state, RigidId{0}, RigidId{1});
  const RigidId id = mergeRigids(state, first, RigidId{2});
  EXPECT_EQ(id, first);
  const Rigid& r = state[id];
  EXPECT_NEAR(r.mass, 3.0, 1e-15);
  EXPECT_NEAR((r.exactCenter() - Vec2(1.0, 1.0) / 3.0).norm(), 0.0, 1e-15);
  // 3 · 1/6 for the boxes; 2/9 + 5/9 + 5/9 for their distances from (1/3, 1/3).
  EXPECT_NEAR(r.inertia, 0.5 + 12.0 / 9.0, 1e-14);
  layOutCollections(state);
  gatherMass(state, id);
  EXPECT_NEAR(r.inertia, 0.5 + 12.0 / 9.0, 1e-14);
  EXPECT_NEAR((r.exactCenter() - Vec2(1.0, 1.0) / 3.0).norm(), 0.0, 1e-15);
  EXPECT_NEAR(state.extent(r).box.half.prod(), 1.0, 1e-12) << "the tight box is 2 by 2";
}

TEST(Collection, TheLargerPartKeepsItsIdWhenTwoMerge) {
  merge2d::Setup setup;
  setUp(parseScene(R"(
format = 1
[[body]]
name = "b"
box = [1, 1]
repeat = { count = [5, 1], spacing = [1, 1] }
)",
                   "five.toml"),
        Mode::Merge, setup);
  State& state = setup.state;
  const RigidId pair = mergeRigids(state, RigidId{0}, RigidId{1});
  RigidId triple = mergeRigids(state, RigidId{2}, RigidId{3});
  triple = mergeRigids(state, triple, RigidId{4});
  const CollectionId kept = state.collection(triple).id, gone = state.collection(pair).id;
  const RigidId all = mergeRigids(state, pair, triple);
  EXPECT_EQ(state.collection(all).id, kept);
  EXPECT_NE(kept, gone);
  EXPECT_EQ(state.collection(all).members.size(), 5u);
}

// Two boxes that springs press together, so that they merge in free flight.
const std::string kPair = R"(
format = 1
gravity = [0, 0]
[[body]]
name = "a"
box = [1, 1]
at = [0, 0]
velocity = [0.3, -0.25]
spin = 30
[[body]]
name = "b"
box = [1, 2]
at = [1, 0]
velocity = [0.3, 0.2735987755982988]
spin = 30
[[spring]]
body = "a"
to_body = "b"
to_anchor = [0, 0]
stiffness = 20
rest_length = 0.1
)";

/// A single body where a collection is now, that moves as it does.
BodyDesc compoundOf(const Snapshot& now, const World& world, const CollectionView& c) {
  BodyDesc body;
  body.name = "compound";
  body.at = c.x;
  body.velocity = c.v;
  body.spin = c.omega;
  for (const BodyId b : c.bodies) {
    Pose pose = now.bodies[index(b)].pose();
    pose.position -= c.x;
    for (const ConvexShape& shape : world.bodies()[index(b)].shapes) {
      body.shapes.push_back(transformed(shape, pose));
    }
  }
  return body;
}

TEST(Collection, FliesLikeOneRigidBodyOfTheSameShape) {
  Simulation run(kPair, Mode::Merge);
  run.steps(100);
  ASSERT_TRUE(run.merged("a"));
  ASSERT_EQ(run.collectionOf("a"), run.collectionOf("b"));
  const Snapshot start = run.now();
  const CollectionView& c = start.collections.front();

  Scene scene;
  scene.gravity = Vec2::Zero();
  scene.bodies.push_back(compoundOf(start, run.world(), c));
  World compound(scene, {.mode = Mode::Reference});
  const auto expectTogether = [&] {
    const Snapshot now = run.now();
    ASSERT_EQ(now.collections.size(), 1u);
    const CollectionView& seen = now.collections.front();
    const BodyState single = compound.capture().bodies.front();
    EXPECT_NEAR((seen.x - single.x).norm(), 0.0, 1e-9);
    EXPECT_NEAR((seen.v - single.v).norm(), 0.0, 1e-9);
    EXPECT_NEAR(seen.omega, single.omega, 1e-9);
    const double turned = single.angle;
    EXPECT_NEAR(now.bodies[0].angle - start.bodies[0].angle, turned, 1e-9);
  };
  for (int i = 0; i < 300; ++i) {
    run.steps(1);
    compound.step();
  }
  expectTogether();

  // An impulse that does not part them: it presses a towards b.
  const BodyState a = run.body("a"), b = run.body("b");
  const Vec2 push = 0.2 * (b.x - a.x).normalized();
  run.kick("a", push);
  compound.applyImpulse(BodyId{0}, a.x, push);
  for (int i = 0; i < 300; ++i) {
    run.steps(1);
    compound.step();
  }
  expectTogether();
}

TEST(Collection, MembersDoNotDriftInTenThousandSteps) {
  Simulation run(kPair, Mode::Merge);
  run.steps(100);
  ASSERT_TRUE(run.merged("a"));
  const Pose before = seenFrom(run.body("a"), run.body("b"));
  const Stats at_first = run.now().stats;
  run.steps(10'000);
  ASSERT_TRUE(run.merged("a"));
  const Pose after = seenFrom(run.body("a"), run.body("b"));
  EXPECT_NEAR((after.position - before.position).norm(), 0.0, 1e-12);
  EXPECT_NEAR(after.rotation.angle(), before.rotation.angle(), 1e-12);
  const Stats at_last = run.now().stats;
  EXPECT_NEAR((at_last.momentum - at_first.momentum).norm(), 0.0, 1e-9);
  EXPECT_NEAR(at_last.angular_momentum, at_first.angular_momentum, 1e-9);
}

const std::string kTwoColumns = kGround + R"(
[[body]]
name = "left"
at = [-3, 0.5]
box = [1, 1]
repeat = { count = [1, 3], spacing = [1, 1] }
[[body]]
name = "right"
at = [3, 0.5]
box = [1, 1]
repeat = { count = [1, 3], spacing = [1, 1] }
)";

TEST(Collection, TwoPilesOnOneFloorStayTwo) {
  Simulation run(kTwoColumns, Mode::Merge);
  run.until(2.0);
  const Snapshot now = run.now();
  ASSERT_EQ(now.collections.size(), 2u);
  for (const CollectionView& c : now.collections) {
    EXPECT_EQ(c.bodies.size(), 3u);
    EXPECT_TRUE(c.anchored);
    EXPECT_EQ(c.anchor, run.id("ground"));
    EXPECT_NEAR(c.mass, 3.0, 1e-12);
    EXPECT_NEAR(c.inertia, 3.0 / 6.0 + 2.0, 2e-3);
  }
  EXPECT_NE(run.collectionOf("left[0,0]"), run.collectionOf("right[0,0]"));
  EXPECT_FALSE(run.merged("ground"));
}

TEST(Collection, UnderThePapersRuleTwoPilesOnOneFloorAreOne) {
  Simulation run(kTwoColumns, Mode::Merge, kPaper);
  run.until(2.0);
  const Snapshot now = run.now();
  ASSERT_EQ(now.collections.size(), 1u);
  EXPECT_EQ(now.collections[0].bodies.size(), 6u);
  EXPECT_EQ(run.count(EventType::Merge), 6);
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
}

TEST(Collection, UnderThePapersRuleWhatComesFreeLeavesTheRestOnTheFloorTogether) {
  Simulation run(kTwoColumns, Mode::Merge, kPaper);
  run.until(2.0);
  run.kick("left[0,2]", {5.0, 0.0});
  run.steps(1);
  EXPECT_FALSE(run.merged("left[0,2]"));
  ASSERT_EQ(run.now().collections.size(), 1u);
  EXPECT_EQ(run.now().collections[0].bodies.size(), 5u);
}

TEST(Collection, UnderThePapersRulePilesOnTwoFloorsStayTwo) {
  Simulation run(kTwoColumns + R"(
[[body]]
name = "shelf"
motion = "pinned"
at = [0, 10]
box = [4, 1]
[[body]]
name = "book"
at = [0, 11]
box = [1, 1]
)",
                 Mode::Merge, kPaper);
  run.until(2.0);
  ASSERT_EQ(run.now().collections.size(), 2u);
  EXPECT_NE(run.collectionOf("book"), run.collectionOf("left[0,0]"));
  EXPECT_EQ(run.collectionOf("right[0,0]"), run.collectionOf("left[0,0]"));
}

TEST(Collection, WeldedToAScriptedBodyFollowsItExactly) {
  Simulation run(R"(
format = 1
[[body]]
name = "platform"
motion = "scripted"
at = [0, -0.5]
box = [10, 1]
script = { axis = [1, 0.3], amplitude = 0.5, period = 8.0 }
[[body]]
name = "box"
at = [1, 0.5]
box = [1, 1]
repeat = { count = [1, 2], spacing = [1, 1] }
)",
                 Mode::Merge);
  run.until(3.0);
  ASSERT_TRUE(run.merged("box[0,1]"));
  const CollectionView c = run.now().collections.front();
  EXPECT_TRUE(c.anchored);
  EXPECT_EQ(c.anchor, run.id("platform"));
  const Pose before = seenFrom(run.body("platform"), run.body("box[0,1]"));
  run.steps(2000, [&] {
    ASSERT_TRUE(run.merged("box[0,1]"));
    const BodyState platform = run.body("platform"), box = run.body("box[0,1]");
    const Pose after = seenFrom(platform, box);
    ASSERT_NEAR((after.position - before.position).norm(), 0.0, 1e-12);
    ASSERT_NEAR((box.v - platform.v).norm(), 0.0, 1e-12);
  });
  const double phase = 2.0 * std::numbers::pi * run.world().time() / 8.0;
  EXPECT_NEAR(run.body("platform").x.x(), 0.5 * (1.0 - std::cos(phase)), 1e-9);
}

TEST(Collection, WeldedToATurningScriptedBodyTurnsWithIt) {
  Simulation run(R"(
format = 1
[[body]]
name = "platform"
motion = "scripted"
at = [0, -0.5]
box = [10, 1]
script = { velocity = [0.2, 0], spin = 1.0 }
[[body]]
name = "box"
at = [2, 0.5]
box = [1, 1]
)",
                 Mode::Merge);
  run.until(2.0);
  ASSERT_TRUE(run.merged("box"));
  const Pose before = seenFrom(run.body("platform"), run.body("box"));
  run.steps(500);
  ASSERT_TRUE(run.merged("box"));
  const Pose after = seenFrom(run.body("platform"), run.body("box"));
  EXPECT_NEAR((after.position - before.position).norm(), 0.0, 1e-12);
  EXPECT_NEAR(run.body("box").omega, std::numbers::pi / 180.0, 1e-9);
}

/// Boxes that springs pull together, without gravity: it merges, is hit, parts and merges again.
const std::string kCluster = R"(
format = 1
gravity = [0, 0]
[[body]]
name = "b"
box = [1, 1]
at = [-1, -1]
repeat = { count = [3, 3], spacing = [1.02, 1.02] }
)";

TEST(Collection, MergesAndUnmergesConserveMomentum) {
  std::string toml = kCluster;
  const auto link = [&](int i, int j, int k, int l) {
    const auto name = [](int x, int y) {
      return "\"b[" + std::to_string(x) + "," + std::to_string(y) + "]\"\n";
    };
    toml += "[[spring]]\nbody = " + name(i, j) + "to_body = " + name(k, l) +
            "to_anchor = [0, 0]\nstiffness = 30\ndamping = 2\nrest_length = 0.5\n";
  };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i < 2) link(i, j, i + 1, j);
      if (j < 2) link(i, j, i, j + 1);
    }
  }
  Simulation run(toml, Mode::Merge);
  run.until(4.0);
  ASSERT_GT(run.count(EventType::Merge), 5);
  const BodyState hit = run.body("b[2,2]");
  const Stats before = run.now().stats;
  EXPECT_NEAR(before.momentum.norm(), 0.0, 1e-10);
  EXPECT_NEAR(before.angular_momentum, 0.0, 1e-10);

  const Vec2 impulse(6.0, 3.0);
  run.kick("b[2,2]", impulse, {0.3, 0.5});
  const double turn = cross(hit.x + Vec2(0.3, 0.5), impulse);
  run.steps(600, [&] {
    const Stats now = run.now().stats;
    ASSERT_NEAR((now.momentum - before.momentum - impulse).norm(), 0.0, 1e-9);
    ASSERT_NEAR(now.angular_momentum - before.angular_momentum, turn, 1e-9);
  });
  EXPECT_GT(run.count(EventType::Unmerge), 0);
}

/// Sees the tables of slots.
class SlotWatch : public Observer {
 public:
  void afterStage(Stage stage, const State& state, const Scratch&) override {
    if (stage != Stage::Merge) return;
    slots = state.collections.size();
    most = std::max(most, slots);
    EXPECT_EQ(state.rigids.size(), state.bodies.size() + slots);
    EXPECT_EQ(state.broadphase.shape_trees.size(), state.rigids.size());
    for (const NearPair& p : state.broadphase.near) EXPECT_LT(index(p.b), state.rigids.size());
  }
  std::size_t slots = 0, most = 0;
};

TEST(Collection, SlotsThatAreFreeAreGivenBack) {
  SlotWatch watch;
  World world(wall(10, 10), inMode(Mode::Merge));
  world.observe(&watch);
  runSteps(world, 150);
  EXPECT_GT(watch.most, 5u) << "the wall merges in many places";
  EXPECT_LT(watch.slots, watch.most / 2);
}

}  // namespace
}  // namespace merge2d
