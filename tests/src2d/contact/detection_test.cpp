/// Which contacts there are: against brute force, and in cases whose answer is known.

#include "src2d/contact/detection.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <set>

#include "src2d/collections/collection.h"
#include "src2d/setup.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

std::vector<Vec2> placed(const ConvexShape& shape, const Pose& pose) {
  std::vector<Vec2> points = outlinePoints(shape);
  for (Vec2& p : points) p = pose * p;
  return points;
}

/// How far the shapes are separated along `axis` (unit): a lower bound of their distance.
double separationAlong(const Vec2& axis, const std::vector<Vec2>& a, double radius_a,
                       const std::vector<Vec2>& b, double radius_b) {
  double high_a = -1e300, low_b = 1e300;
  for (const Vec2& p : a) high_a = std::max(high_a, axis.dot(p));
  for (const Vec2& p : b) low_b = std::min(low_b, axis.dot(p));
  return low_b - high_a - radius_a - radius_b;
}

/// The largest separation over all axes on which two convex shapes can be apart; negative where
/// they overlap. By separating axes in double, without any of the engine's collision code.
double separation(const ConvexShape& a, const Pose& pose_a, const ConvexShape& b,
                  const Pose& pose_b) {
  const auto* disc_a = std::get_if<Circle>(&a);
  const auto* disc_b = std::get_if<Circle>(&b);
  const double ra = disc_a ? disc_a->radius : 0.0, rb = disc_b ? disc_b->radius : 0.0;
  const auto corners = [](const ConvexShape& shape, const Circle* disc, const Pose& pose) {
    return disc ? std::vector<Vec2>{pose * disc->center} : placed(shape, pose);
  };
  const auto pa = corners(a, disc_a, pose_a), pb = corners(b, disc_b, pose_b);

  std::vector<Vec2> axes;
  for (const auto* outline : {&pa, &pb}) {
    for (std::size_t i = 0; outline->size() > 2 && i < outline->size(); ++i) {
      axes.push_back(perpendicular((*outline)[(i + 1) % outline->size()] - (*outline)[i]));
    }
  }
  if (disc_a || disc_b) {
    for (const Vec2& p : pa) {
      for (const Vec2& q : pb) axes.push_back(q - p);
    }
  }
  double most = -1e300;
  for (const Vec2& axis : axes) {
    if (axis.norm() < 1e-9) continue;
    for (const Vec2& unit : {Vec2(axis.normalized()), Vec2(-axis.normalized())}) {
      most = std::max(most, separationAlong(unit, pa, ra, pb, rb));
    }
  }
  return most;
}

double separation(const World& world, const BodyState& a, const BodyState& b) {
  double least = 1e300;
  for (const ConvexShape& shape_a : world.bodies()[index(a.id)].shapes) {
    for (const ConvexShape& shape_b : world.bodies()[index(b.id)].shapes) {
      least = std::min(least, separation(shape_a, a.pose(), shape_b, b.pose()));
    }
  }
  return least;
}

double reach(const BodyInfo& body) {
  double most = 0.0;
  for (const ConvexShape& shape : body.shapes) {
    for (const Vec2& p : outlinePoints(shape)) most = std::max(most, p.norm());
  }
  return 1.1 * most;  // the outline of a disc is given by points
}

/// Sixty discs, boxes and compounds that fly about in a closed room with a scripted paddle.
Scene room(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Scene scene;
  scene.gravity = {3 * uniform(random), 3 * uniform(random)};
  for (const double side : {-1.0, 1.0}) {
    add(scene, pinned(box(20, 1, {0, 8 * side})));
    add(scene, pinned(box(1, 20, {8 * side, 0})));
  }
  add(scene, scripted(box(5, 0.4, {0, 0}), SteadyMotion{.velocity = {0, 0}, .spin = 2.0}));
  for (int i = 0; i < 60; ++i) {
    BodyDesc body;
    body.at = {1.6 * (i % 8) - 5.6, 1.6 * (i / 8) - 5.6};
    if (body.at.norm() < 3.2) continue;  // the paddle's
    body.angle = 3 * uniform(random);
    body.velocity = 6.0 * Vec2(uniform(random), uniform(random));
    body.spin = 5 * uniform(random);
    body.restitution = 0.5 + 0.5 * uniform(random);
    const double size = 0.5 + 0.3 * uniform(random);
    if (i % 3 == 0) body.shapes = {Circle{.center = Vec2::Zero(), .radius = 0.5 * size}};
    if (i % 3 == 1) body.shapes = {makeBox(size, 0.5 * size)};
    if (i % 3 == 2) {
      body.shapes = {makeBox(size, 0.3 * size), makeBox(0.3 * size, size, Pose::at({0.3, 0.2}, 0)),
                     Circle{.center = {-0.4, 0}, .radius = 0.2 * size}};
    }
    add(scene, body);
  }
  return scene;
}

using Pairs = std::set<std::pair<BodyId, BodyId>>;

Pairs pairsOf(const Snapshot& snapshot) {
  Pairs pairs;
  for (const ContactView& c : snapshot.contacts) pairs.insert({c.a, c.b});
  return pairs;
}

/// The contacts after a step belong to the poses before it.
void compareWithBruteForce(const World& world, const Snapshot& before, const Snapshot& after) {
  const Pairs found = pairsOf(after);
  const double margin = world.scene().settings.solver.margin;
  const double h = world.scene().step;
  for (const BodyState& a : before.bodies) {
    const BodyInfo& info_a = world.bodies()[index(a.id)];
    for (const BodyState& b : before.bodies) {
      const BodyInfo& info_b = world.bodies()[index(b.id)];
      const bool fixed = info_a.motion != Motion::Dynamic && info_b.motion != Motion::Dynamic;
      if (b.id <= a.id || fixed) continue;
      const bool listed = found.contains({a.id, b.id});
      const double rough = (b.x - a.x).norm() - reach(info_a) - reach(info_b);
      if (!listed && rough > 0.0) continue;
      const double apart = separation(world, a, b);
      if (apart < -1e-4) RC_ASSERT(listed);
      if (listed) {
        const double turning =
            3 * (std::abs(a.omega) * reach(info_a) + (std::abs(b.omega) + 2.0) * reach(info_b));
        RC_ASSERT(apart <= margin + h * ((a.v - b.v).norm() + turning) + 1e-6);
      }
    }
  }
}

void fly(Mode mode) {
  World world(room(*rc::gen::arbitrary<std::uint32_t>()), inMode(mode));
  Snapshot before = world.capture(), after;
  for (int i = 0; i < 60; ++i) {
    world.step();
    world.capture(after);
    compareWithBruteForce(world, before, after);
    std::swap(before, after);
  }
}

RC_GTEST_PROP(Detection, ExactlyTheBodiesThatTouchAreInContact, ()) { fly(Mode::Reference); }

RC_GTEST_PROP(Detection, MergingAndSleepingHideNoContact, ()) { fly(Mode::MergeSleep); }

TEST(Detection, TwoBodiesThatPartLoseTheirContact) {
  Scene scene = noGravity();
  add(scene, box(1, 1, {0, 0}));
  add(scene, box(1, 1, {1, 0}));
  scene.bodies[1].velocity = {1, 0};
  World world = reference(scene);
  world.step();
  EXPECT_EQ(world.capture().contacts.size(), 2u);
  runSteps(world, 3);
  EXPECT_TRUE(world.capture().contacts.empty());
}

TEST(Detection, PinnedAndScriptedBodiesDoNotTouchEachOther) {
  Scene scene;
  add(scene, pinned(box(4, 1, {0, 0})));
  add(scene, pinned(box(1, 4, {0, 0})));
  add(scene, scripted(disc(1, {0, 0}), Sinusoid{}));
  World world = reference(scene);
  runSteps(world, 10);
  EXPECT_TRUE(world.capture().contacts.empty());
}

TEST(Detection, AContactKnowsWhereItIsAndHowDeep) {
  Scene scene = noGravity();
  add(scene, pinned(box(4, 1, {10, -0.5})));
  add(scene, box(1, 1, {10.25, 0.499}));
  World world = reference(scene);
  world.step();
  const auto contacts = world.capture().contacts;
  ASSERT_EQ(contacts.size(), 2u);
  std::vector<double> x;
  for (const ContactView& c : contacts) {
    EXPECT_EQ(c.a, BodyId{0});
    EXPECT_EQ(c.b, BodyId{1});
    EXPECT_LT((c.normal - Vec2(0, 1)).norm(), 1e-12);
    EXPECT_NEAR(c.gap, -0.001, 1e-12);
    EXPECT_NEAR(c.x.y(), -0.0005, 1e-12);
    x.push_back(c.x.x());
  }
  EXPECT_NEAR(std::min(x[0], x[1]), 9.75, 1e-12);
  EXPECT_NEAR(std::max(x[0], x[1]), 10.75, 1e-12);
}

TEST(Detection, NothingBreathesBetweenTwoThingsFixedToTheWorld) {
  Scene scene;
  add(scene, pinned(box(4, 1, {0, -0.5})));
  add(scene, box(1, 1, {0, 0.5}));
  add(scene, box(1, 1, {0.3, 1.5}));
  merge2d::Setup setup;
  Scratch scratch;
  setUp(scene, Mode::Merge, setup);
  State& state = setup.state;
  detectContacts(state, scratch);
  const auto between = [&]() -> Contact& {
    for (const ContactTable::Slot slot : state.contacts.order) {
      const ContactKey& key = state.contacts[slot].key;
      if (key.a == BodyId{1} && key.b == BodyId{2}) return state.contacts[slot];
    }
    throw std::runtime_error("the boxes do not touch");
  };
  for (ContactPoint& p : between().points) {
    p.lambda_n = 2.0;
    p.breath = 1e-3F;
  }
  anchorRigid(state, RigidId{1}, BodyId{0});
  anchorRigid(state, RigidId{2}, BodyId{0});
  detectContacts(state, scratch);
  for (const ContactPoint& p : between().points) {
    EXPECT_EQ(p.breath, 0.0F);
    EXPECT_EQ(p.lambda_n, 2.0);
  }
}

TEST(Detection, AContactKeepsItsFeaturesWhileABoxSlides) {
  Scene scene = onGround();
  add(scene, box(1, 0.5, {0, 0.25}));
  scene.bodies[1].velocity = {5, 0};
  World world = reference(scene);
  const auto features = [&] {
    std::set<std::uint32_t> all;
    for (const ContactView& c : world.capture().contacts) all.insert(c.feature);
    return all;
  };
  world.step();
  const auto first = features();
  EXPECT_EQ(first.size(), 2u);
  for (int i = 0; i < 100; ++i) {
    world.step();
    ASSERT_EQ(features(), first);
    for (const ContactView& c : world.capture().contacts) ASSERT_FALSE(c.fresh);
  }
}

/// A thin pinned wall in the way of `bullet`, which flies to the right.
Scene shotAtWall(BodyDesc bullet) {
  Scene scene = noGravity();
  add(scene, pinned(box(0.05, 20, {10, 0})));
  add(scene, std::move(bullet));
  return scene;
}

void expectStopped(const Scene& scene) {
  World world = reference(scene);
  runSeconds(world, 0.5);
  EXPECT_LT(see(world, BodyId{1}).x.x(), 10.0);
}

TEST(Detection, AFastBulletDoesNotTunnelThroughAThinWall) {
  for (const double x : {0.0, 0.37, 0.81, 1.33, 1.9}) {
    for (const double speed : {50.0, 200.0, 400.0}) {
      for (BodyDesc bullet : {disc(0.05, {x, 0.3}), box(0.2, 0.05, {x, 0.3})}) {
        SCOPED_TRACE(testing::Message() << "from " << x << " at " << speed << " m/s");
        bullet.velocity = {speed, 0};
        expectStopped(shotAtWall(bullet));
      }
    }
  }
}

TEST(Detection, ABulletDoesNotTunnelInItsFirstStep) {
  for (const double x : {9.0, 9.5, 9.8, 9.89}) {
    SCOPED_TRACE(testing::Message() << "from " << x);
    BodyDesc bullet = disc(0.05, {x, 0.3});
    bullet.velocity = {200, 0};
    expectStopped(shotAtWall(bullet));
  }
}

TEST(Detection, ABulletThatAnImpulseSetsOffDoesNotTunnel) {
  for (const double x : {5.0, 9.0, 9.8}) {
    SCOPED_TRACE(testing::Message() << "from " << x);
    BodyDesc bullet = disc(0.05, {x, 0.3});
    bullet.mass = 1.0;
    Scene scene = shotAtWall(bullet);
    scene.impulses.push_back({.body = 1, .at = {x, 0.3}, .impulse = {200, 0}, .time = 0.1});
    expectStopped(scene);
  }
}

TEST(Detection, ATurningRodDoesNotPassThroughASmallBody) {
  Scene scene = noGravity();
  add(scene, box(6, 0.05, {0, 0}));
  scene.bodies[0].spin = 60;  // its end moves by 1.8 m per step
  add(scene, pinned(disc(0.05, {0, 2.9})));
  World world = reference(scene);
  runSeconds(world, 0.5);
  EXPECT_LT(std::abs(see(world, BodyId{0}).omega), 59.0);
}

}  // namespace
}  // namespace merge2d
