/// The same scene gives the same run, whatever is watched, named or asked for.

#include <gtest/gtest.h>

#include <tuple>

#include "tests/support/fingerprint.h"
#include "tests/support/scenes.h"
#include "tests/support/tapped_walls.h"

namespace merge2d {
namespace {

constexpr Mode kModes[] = {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep};

/// A tower on the ground, hit by a disc after half a second.
Scene towerUnderFire() {
  Scene scene = onGround();
  addWall(scene, 8, 5);
  BodyDesc shot = disc(0.4, {-14, 5});
  shot.velocity = {20, 2};
  shot.density = 4.0;
  add(scene, named("shot", shot));
  return scene;
}

/// Something of everything: springs, scripts, emitters, forces, impulses, magnets, joints of time.
Scene medley() {
  return sceneOf(R"(
    [[body]]
    name = "ground"
    motion = "pinned"
    at = [0, -0.5]
    box = [60, 1]
    [[body]]
    name = "belt"
    motion = "scripted"
    at = [6, 0.5]
    box = [6, 0.4]
    script = { axis = [1, 0], amplitude = 0.5, period = 2.0 }
    [[body]]
    name = "brick"
    at = [-4, 0.5]
    box = [1, 1]
    repeat = { count = [3, 3], spacing = [1.0, 1.0] }
    [[body]]
    name = "load"
    at = [6, 1.2]
    box = [1, 1]
    [[body]]
    name = "bob"
    at = [0, 6]
    shapes = [{ box = [1, 0.3] }, { circle = 0.3, at = [0.6, 0] }]
    spin = 90
    [[body]]
    name = "late"
    at = [2, 3]
    circle = 0.4
    pinned_until = 0.7
    restitution = 0.5
    [[spring]]
    body = "bob"
    anchor = [-0.5, 0]
    to = [0, 9]
    stiffness = 30
    damping = 0.5
    rest_length = 2
    [[force]]
    body = "brick[1,2]"
    force = [3, 0]
    from = 0.5
    until = 1.0
    [[impulse]]
    body = "brick[0,1]"
    at = [-4.5, 1.5]
    impulse = [4, 0]
    time = 1.5
    [[magnet]]
    body = "load"
    on = [[0.2, 1.2]]
    [[emitter]]
    name = "drop"
    circle = 0.2
    at = [-3, 8]
    spread = [1, 0]
    every = 0.3
    count = 5
  )");
}

std::vector<Fingerprint> run(const Scene& scene, const WorldOptions& options, int steps,
                             Observer* observer = nullptr) {
  World world(scene, options);
  world.observe(observer);
  std::vector<Fingerprint> states;
  Snapshot snapshot;
  for (int i = 0; i < steps; ++i) {
    world.step();
    world.capture(snapshot);
    states.emplace_back(snapshot);
  }
  return states;
}

/// The first step in which two runs differ, or −1.
int firstDifference(const std::vector<Fingerprint>& a, const std::vector<Fingerprint>& b) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (!(a[i] == b[i])) return static_cast<int>(i) + 1;
  }
  return a.size() == b.size() ? -1 : static_cast<int>(std::min(a.size(), b.size()));
}

TEST(Determinism, AFingerprintTellsASingleBit) {
  Snapshot one;
  one.bodies.resize(2);
  Snapshot two = one;
  EXPECT_TRUE(Fingerprint(one) == Fingerprint(two));
  two.bodies[1].x.y() = 1e-320;
  EXPECT_FALSE(Fingerprint(one) == Fingerprint(two));
}

TEST(Determinism, ASceneGivesTheSameRunTwiceBitForBit) {
  for (const Mode mode : kModes) {
    for (const Scene& scene : {towerUnderFire(), medley()}) {
      EXPECT_EQ(firstDifference(run(scene, inMode(mode), 250), run(scene, inMode(mode), 250)), -1)
          << name(mode);
    }
  }
}

class CountingObserver : public Observer {
 public:
  void afterStage(Stage stage, const State&, const Scratch&) override {
    ++calls[static_cast<std::size_t>(stage)];
  }
  std::array<int, kStages> calls{};
};

TEST(Determinism, AWatchedWorldEqualsAnUnwatchedOne) {
  for (const Mode mode : kModes) {
    CountingObserver observer;
    const auto watched = run(medley(), {.mode = mode, .timings = true}, 250, &observer);
    EXPECT_EQ(firstDifference(watched, run(medley(), inMode(mode), 250)), -1) << name(mode);
    for (const int calls : observer.calls) EXPECT_EQ(calls, 250);
  }
}

/// A wall with proofs, onto which boxes fall: in some steps one leaves while another joins.
TEST(Determinism, AWatchedWallThatGainsAndLosesBodiesEqualsAnUnwatchedOne) {
  Scene scene = wallOnSwingingPlatform(10, 10, 0.4, 4.0);
  EmitterDesc rain;
  rain.body = scene.bodies.back();
  rain.body.name = "drop";
  rain.body.at = {0.0, 14.0};
  rain.every = 0.2;
  rain.count = 40;
  rain.spread = {4.0, 0.0};
  scene.emitters.push_back(rain);
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    CountingObserver observer;
    const auto watched = run(scene, {.mode = mode, .timings = false}, 1000, &observer);
    EXPECT_EQ(firstDifference(watched, run(scene, inMode(mode), 1000)), -1) << name(mode);
  }
}

TEST(Determinism, AskingForDecisionsChangesNothing) {
  for (const Mode mode : kModes) {
    const WorldOptions asking{.mode = mode, .timings = false, .decisions = true};
    EXPECT_EQ(firstDifference(run(medley(), asking, 250), run(medley(), inMode(mode), 250)), -1)
        << name(mode);
  }
}

TEST(Determinism, AskingForDecisionsAboutALargeOpenCollectionChangesNothing) {
  const WorldOptions asking{.mode = Mode::Merge, .timings = false, .decisions = true};
  const auto asked = run(tappedWalls(), asking, 230);
  EXPECT_EQ(firstDifference(asked, run(tappedWalls(), inMode(Mode::Merge), 230)), -1);
}

TEST(Determinism, CapturingNowAndThenChangesNothing) {
  for (const Mode mode : kModes) {
    World world(medley(), inMode(mode));
    runSteps(world, 250);
    const auto seen = run(medley(), inMode(mode), 250);
    EXPECT_TRUE(Fingerprint(world.capture()) == seen.back()) << name(mode);
  }
}

TEST(Determinism, NamesOfBodiesChangeNothing) {
  Scene scene = medley(), renamed = scene;
  for (std::size_t i = 0; i < renamed.bodies.size(); ++i) {
    renamed.bodies[i].name = "z" + std::to_string(1000 - i);
  }
  renamed.name = renamed.title = "another";
  for (const Mode mode : kModes) {
    EXPECT_EQ(firstDifference(run(scene, inMode(mode), 250), run(renamed, inMode(mode), 250)), -1)
        << name(mode);
  }
}

TEST(Determinism, TheReferenceIsNotTouchedByTheSettingsOfMergingAndSleeping) {
  Scene scene = towerUnderFire(), other = scene;
  Settings& s = other.settings;
  s.merging = {.rule = MergingRule::Paper,
               .velocity = 1.0,
               .breathing = 1.0,
               .sliding = 1.0,
               .steps = 1,
               .cycles = CycleCriterion::Rigid};
  s.unmerging.velocity = 1e-9;
  s.unmerging.sweeps = 7;
  s.sleeping.velocity = 1.0;
  const WorldOptions reference = inMode(Mode::Reference);
  EXPECT_EQ(firstDifference(run(scene, reference, 250), run(other, reference, 250)), -1);
  const WorldOptions merging = inMode(Mode::Merge);
  EXPECT_NE(firstDifference(run(scene, merging, 250), run(other, merging, 250)), -1);
}

TEST(Determinism, TheOrderOfBodiesInTheFileChangesResultsOnlyWithinTolerance) {
  for (const Mode mode : kModes) {
    Scene scene = wall(6, 6), reversed = scene;
    std::reverse(reversed.bodies.begin(), reversed.bodies.end());
    World one(scene, inMode(mode)), two(reversed, inMode(mode));
    runSeconds(one, 3);
    runSeconds(two, 3);
    for (const BodyDesc& body : scene.bodies) {
      EXPECT_LT((see(one, body.name).x - see(two, body.name).x).norm(), 1e-3)
          << body.name << " in mode " << name(mode);
    }
  }
}

/// Names of the dominoes that lie, and when [s]: the ground is left out.
std::map<std::string, double> fallTimes(const Scene& scene, Mode mode) {
  World world(scene, inMode(mode));
  std::map<std::string, double> fallen;
  for (int i = 0; i < 400; ++i) {
    world.step();
    for (const BodyState& b : world.capture().bodies) {
      const std::string& body = world.bodies()[index(b.id)].name;
      if (std::abs(b.angle) > 0.5) fallen.emplace(body, world.time());
    }
  }
  return fallen;
}

TEST(Determinism, TheOrderOfBodiesInTheFileHardlyMattersToAChainOfDominoes) {
  for (const Mode mode : kModes) {
    Scene scene = onGround();
    for (int i = 0; i < 15; ++i) add(scene, named(std::to_string(i), box(0.2, 1, {0.5 * i, 0.5})));
    scene.bodies[1].velocity = {1.0, 0.0};
    scene.bodies[1].spin = -2.0;
    Scene reversed = scene;
    std::reverse(reversed.bodies.begin(), reversed.bodies.end());
    const auto one = fallTimes(scene, mode), two = fallTimes(reversed, mode);
    ASSERT_EQ(one.size(), 15u) << name(mode);
    ASSERT_EQ(two.size(), 15u) << name(mode);
    for (const auto& [body, time] : one) {
      EXPECT_NEAR(two.at(body), time, 0.02 + 1e-9) << body << " in mode " << name(mode);
    }
  }
}

using EventKey = std::tuple<int, EventType, BodyId, BodyId, CollectionId, EventReason>;

std::vector<EventKey> eventsOf(const Scene& scene, Mode mode, int steps) {
  World world(scene, inMode(mode));
  std::vector<EventKey> events;
  for (int i = 1; i <= steps; ++i) {
    world.step();
    for (const Event& e : world.events()) {
      events.emplace_back(i, e.type, e.a, e.b, e.collection, e.reason);
    }
  }
  return events;
}

void expectTheSameEvents(const Scene& scene, Mode mode) {
  const auto here = eventsOf(scene, mode, 400);
  const auto there = eventsOf(shifted(scene, {1000, 1000}), mode, 400);
  EXPECT_EQ(here.size(), there.size()) << name(mode);
  const auto differ = std::mismatch(here.begin(), here.end(), there.begin(), there.end());
  if (differ.first == here.end()) return;
  ADD_FAILURE() << "in mode " << name(mode) << " the runs differ from event "
                << differ.first - here.begin() << " of " << here.size() << ", in step "
                << std::get<0>(*differ.first);
}

TEST(Determinism, ASceneMovedByAKilometreHasTheSameEventsAtTheSameSteps) {
  for (const Mode mode : kModes) expectTheSameEvents(towerUnderFire(), mode);
  EXPECT_GT(eventsOf(towerUnderFire(), Mode::MergeSleep, 400).size(), 20u);
}

TEST(Determinism, ASceneMovedByAKilometreHasTheSameEventsWhereWeldsAreDecided) {
  Scene scene = towerUnderFire();
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) expectTheSameEvents(scene, mode);
}

TEST(Determinism, ASceneMovedByAKilometreHasTheSameVelocitiesBitForBit) {
  for (const Mode mode : kModes) {
    World here(towerUnderFire(), inMode(mode));
    World there(shifted(towerUnderFire(), {1000, 1000}), inMode(mode));
    Snapshot a, b;
    for (int step = 1; step <= 400; ++step) {
      here.step();
      there.step();
      here.capture(a);
      there.capture(b);
      for (std::size_t i = 0; i < a.bodies.size(); ++i) {
        ASSERT_EQ(a.bodies[i].v, b.bodies[i].v) << name(mode) << ", step " << step;
        ASSERT_EQ(a.bodies[i].omega, b.bodies[i].omega) << name(mode) << ", step " << step;
        ASSERT_EQ(a.bodies[i].angle, b.bodies[i].angle) << name(mode) << ", step " << step;
      }
    }
  }
}

TEST(Determinism, ASceneMovedByAKilometreEndsWhereItShould) {
  for (const Mode mode : kModes) {
    World here(wall(8, 5), inMode(mode)), there(shifted(wall(8, 5), {1000, -1000}), inMode(mode));
    runSeconds(here, 3);
    runSeconds(there, 3);
    for (const BodyState& body : here.capture().bodies) {
      EXPECT_LT((see(there, body.id).x - body.x - Vec2(1000, -1000)).norm(), 1e-8) << name(mode);
    }
  }
}

}  // namespace
}  // namespace merge2d
