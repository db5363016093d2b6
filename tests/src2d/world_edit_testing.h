#pragma once
/// Worlds that tests change between two steps, and the parts that they add.

#include <functional>
#include <optional>
#include <stdexcept>

#include "src2d/world.h"
#include "tests/support/scenes.h"

namespace merge2d {

inline constexpr BodyId kFirst{1};  // on the ground, which is body 0

inline JointDesc jointOf(JointKind kind, BodyIndex a, std::optional<BodyIndex> b, const Vec2& at) {
  JointDesc joint;
  joint.kind = kind;
  joint.a = a;
  joint.b = b;
  joint.at = at;
  return joint;
}

/// From the middle of a body to a place.
inline SpringDesc springOf(BodyIndex body, const Vec2& to, double stiffness, double damping) {
  SpringDesc spring;
  spring.body = body;
  spring.to = to;
  spring.stiffness = stiffness;
  spring.damping = damping;
  return spring;
}

inline const BodyState& of(const Snapshot& seen, BodyId id) {
  for (const BodyState& body : seen.bodies) {
    if (body.id == id) return body;
  }
  throw std::runtime_error("the body is not there");
}
inline BodyState now(const World& world, BodyId id) { return of(world.capture(), id); }

/// A column that has merged and fallen asleep.
inline World atRest(int boxes) {
  World world(column(boxes), {.timings = false});
  runSteps(world, 100);
  return world;
}

/// Bricks, a compound body, a hanging arm and falling discs.
inline Scene mixed() {
  Scene scene = wall(4, 3);
  BodyDesc tee = box(0.2, 1, {-6, 0.7});
  tee.shapes.emplace_back(makeBox(1, 0.2, Pose::at({0, 0.6}, 0)));
  add(scene, named("tee", tee));
  add(scene, named("arm", box(0.2, 1, {-9, 2.7})));
  scene.joints.push_back(
      jointOf(JointKind::Revolute, scene.bodies.size() - 1, std::nullopt, {-9, 3.2}));
  EmitterDesc rain{.body = named("drop", disc(0.2, {1, 6}))};
  rain.every = 0.2;
  rain.count = 5;
  scene.emitters.push_back(rain);
  return scene;
}

/// An observer that does nothing: a world that is watched runs every stage of every step for every
/// body.
class Onlooker : public Observer {
 public:
  void afterStage(Stage, const State&, const Scratch&) override {}
};

/// Two worlds of one scene, of which the second is watched.
struct WatchedTwins {
  World one, watched;
  Onlooker onlooker;

  WatchedTwins(const Scene& scene, Mode mode)
      : one(scene, {.mode = mode}), watched(scene, {.mode = mode}) {
    watched.observe(&onlooker);
  }
  void change(const std::function<void(World&)>& by) {
    by(one);
    by(watched);
  }
  void step() {
    one.step();
    watched.step();
  }
};

}  // namespace merge2d
