#pragma once
/// What the tests of merging share: scenes as text, run step by step.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "src2d/dynamics/state.h"
#include "src2d/scene/load.h"
#include "src2d/world.h"
#include "tests/support/anchored.h"
#include "tests/support/scenes.h"

namespace merge2d {

/// The ground of most scenes: its top is y = 0.
inline const std::string kGround = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [400, 1]
)";

/// A scene as text, running.
class Simulation {
 public:
  Simulation(const Scene& scene, Mode mode, bool decisions = false)
      : world_(scene, {.mode = mode, .timings = false, .decisions = decisions}) {}
  Simulation(const std::string& toml, Mode mode, const Overrides& overrides = {},
             bool decisions = false)
      : Simulation(parseScene(toml, "test.toml", overrides), mode, decisions) {}

  World& world() { return world_; }
  const World& world() const { return world_; }
  Snapshot now() const { return world_.capture(); }

  /// Takes steps and calls `each` after each of them.
  template <class Each>
  void steps(int count, Each&& each) {
    for (int i = 0; i < count; ++i) {
      world_.step();
      for (const Event& e : world_.events()) ++events_[e.type];
      each();
    }
  }
  void steps(int count) {
    steps(count, [] {});
  }
  void until(double time) {
    steps(static_cast<int>(std::lround((time - world_.time()) / world_.scene().step)));
  }

  BodyId id(const std::string& name) const { return idOf(world_, name); }
  /// Of scenes without emitters, in which all bodies are alive.
  BodyState body(const std::string& name) const { return now().bodies[index(id(name))]; }
  CollectionId collectionOf(const std::string& name) const { return body(name).collection; }
  bool merged(const std::string& name) const { return collectionOf(name) != kNoCollection; }
  /// Whether it is welded to what is pinned or scripted.
  bool anchored(const std::string& name) const {
    const Snapshot seen = now();
    return isAnchored(seen, seen.bodies[index(id(name))]);
  }

  void kick(const std::string& name, const Vec2& impulse, const Vec2& offset = Vec2::Zero()) {
    world_.applyImpulse(id(name), body(name).x + offset, impulse);
  }

  /// How many events of a kind there were in all steps so far.
  int count(EventType type) const { return events_.contains(type) ? events_.at(type) : 0; }

 private:
  World world_;
  std::map<EventType, int> events_;
};

/// What an observer says of the last `steps` of 150.
template <class Observing>
Observing watched(const Scene& scene, int steps) {
  Observing observer;
  World world(scene, inMode(Mode::Merge));
  runSteps(world, 150 - steps);
  world.observe(&observer);
  runSteps(world, steps);
  return observer;
}

/// How many bodies stand farther from where they were.
inline int moved(const Snapshot& before, const Snapshot& after, double distance) {
  int count = 0;
  for (std::size_t i = 0; i < before.bodies.size(); ++i) {
    count += (after.bodies[i].x - before.bodies[i].x).norm() > distance ? 1 : 0;
  }
  return count;
}

/// Bodies that a ball of 10 kg has moved by 10 cm, 3.5 s after it was let go at a wall of 120.
inline int movedByBall(Mode mode, const Vec2& velocity, int iterations,
                       UnmergingRule rule = UnmergingRule::Default) {
  Scene scene = wall(12, 10);
  scene.settings.unmerging.rule = rule;
  scene.settings.solver.iterations = iterations;
  BodyDesc ball = disc(0.5, {-9.0, 4.0});
  ball.mass = 10.0;
  ball.velocity = velocity;
  ball.pinned_until = 2.5;
  add(scene, named("ball", ball));
  Simulation run(scene, mode);
  run.until(2.5);
  const Snapshot before = run.now();
  run.until(6.0);
  return moved(before, run.now(), 0.1);
}

/// The force along the normal between two bodies [N].
inline double normalForce(const Snapshot& now, BodyId a, BodyId b, double h) {
  double force = 0.0;
  for (const ContactView& c : now.contacts) {
    if ((c.a == a && c.b == b) || (c.a == b && c.b == a)) force += c.lambda_n / h;
  }
  return force;
}

/// The pose of a body seen from another.
inline Pose seenFrom(const BodyState& frame, const BodyState& body) {
  return frame.pose().inverse() * body.pose();
}

/// Both rules as the paper has them.
inline const Overrides kPaper{{"merging.rule", "\"paper\""}, {"unmerging.rule", "\"paper\""}};

/// How many events of this type and reason the last step had.
inline int events(const Simulation& run, EventType type, EventReason reason) {
  int count = 0;
  for (const Event& e : run.world().events()) count += e.type == type && e.reason == reason;
  return count;
}

/// A cart on two springs, which swings for ever with up to 0.2 m/s² on a rail without friction.
inline const std::string kCartOnSprings = R"(
[[body]]
name = "rail"
motion = "pinned"
at = [0, -1]
box = [60, 1]
friction = 0
[[body]]
name = "cart"
at = [0, 0]
box = [8, 1]
mass = 200
friction = 0.8
velocity = [0.2, 0]
[[spring]]
body = "cart"
to = [-20, 0]
stiffness = 120
[[spring]]
body = "cart"
to = [20, 0]
stiffness = 120
)";

/// The step in which a body becomes a member, or 0 within `limit` steps.
inline std::int64_t mergeStep(const std::string& toml, const std::string& body,
                              const Overrides& overrides = {}, int limit = 500) {
  Simulation run(toml, Mode::Merge, overrides);
  for (int i = 0; i < limit; ++i) {
    run.steps(1);
    if (run.merged(body)) return run.world().steps();
  }
  return 0;
}

}  // namespace merge2d
