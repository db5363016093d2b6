#include "src2d/scene/check.h"

#include <limits>

#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A small scene with one of everything, and nothing wrong.
Scene soundScene() {
  return parseScene(R"(
[camera]
center = [0, 1]
[[body]]
name = "ball"
circle = 0.5
[[body]]
name = "ground"
motion = "pinned"
box = [10, 1]
at = [0, -2]
[[body]]
name = "lift"
motion = "scripted"
box = [1, 1]
script = { keyframes = [[0, 8, 0, 0], [2, 8, 3, 90]] }
[[body]]
name = "cart"
box = [1, 0.5]
at = [-3, 0]
[[spring]]
body = "ball"
to = [0, 3]
stiffness = 10
[[impulse]]
body = "ball"
at = [0, 0]
impulse = [1, 0]
[[force]]
body = "ball"
force = [1, 0]
[[magnet]]
body = "ground"
on = [[0, 1], [2, 3]]
[[joint]]
kind = "distance"
bodies = ["ball", "cart"]
at = [0, 0]
to = [-3, 0]
[[joint]]
kind = "prismatic"
bodies = ["cart"]
at = [-3, 0]
axis = [1, 0]
limits = [-1, 1]
motor = { speed = 1, force = 10 }
[[emitter]]
circle = 0.1
every = 0.5
count = 3
)",
                    "s.toml");
}

/// The complaint of `check` about the sound scene after a change.
std::string complaintAfter(const std::function<void(Scene&)>& change) {
  Scene scene = soundScene();
  change(scene);
  try {
    check(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

struct Fault {
  std::function<void(Scene&)> change;
  std::string_view sentence;
};

void expectComplaints(std::initializer_list<Fault> faults) {
  for (const Fault& fault : faults) {
    EXPECT_THAT(complaintAfter(fault.change), HasSubstr(std::string(fault.sentence)));
  }
}

TEST(Check, ASoundSceneHasNoFault) {
  EXPECT_EQ(complaintAfter([](Scene&) {}), "no complaint");
}

TEST(Check, NumbersHaveTheRangesOfAFile) {
  expectComplaints({
      {[](Scene& s) { s.step = 0; },
       "'step' in the scene must be between 1e-6 and 1 s, but is 0.0"},
      {[](Scene& s) { s.duration = -1; }, "'duration' in the scene must be between 1e-6 and 1e6 s"},
      {[](Scene& s) { s.gravity.y() = kNan; }, "'gravity[1]' in the scene must be a finite number"},
      {[](Scene& s) { s.seed = ~std::uint64_t{0}; }, "'seed' in the scene must be"},
      {[](Scene& s) { s.camera->height = 0; }, "'height' in [camera] must be a positive length"},
      {[](Scene& s) { s.settings.solver.iterations = 0; },
       "'iterations' in [solver] must be between 1 and 1000000, but is 0"},
      {[](Scene& s) { s.settings.merging.velocity = kForever; },
       "'velocity' in [merging] must be a finite number"},
      {[](Scene& s) { s.settings.solver.method = SolverMethod{99}; }, "'method' in [solver]"},
      {[](Scene& s) { s.bodies[0].mass = -1; },
       "'mass' in body 'ball' must be positive (1e-12 to 1e12), but is -1.0"},
      {[](Scene& s) { s.bodies[0].density = 0; }, "'density' in body 'ball' must be positive"},
      {[](Scene& s) { s.bodies[0].at.x() = 2e6; },
       "'at[0]' in body 'ball' must be between -1e6 and 1e6 m"},
      {[](Scene& s) { s.bodies[0].angle = kNan; }, "'angle' in body 'ball' must be a finite"},
      {[](Scene& s) { s.bodies[0].friction = -0.1; },
       "'friction' in body 'ball' must be 0 or more"},
      {[](Scene& s) { s.bodies[0].restitution = 1.5; }, "must be between 0 and 1, but is 1.5"},
      {[](Scene& s) { s.springs[0].stiffness = kNan; }, "'stiffness' in spring[0] must be"},
      {[](Scene& s) { s.impulses[0].time = -1; }, "'time' in impulse[0] must be 0 or more"},
      {[](Scene& s) { s.forces[0].force.x() = kForever; },
       "'force[0]' in force[0] must be a finite"},
      {[](Scene& s) { s.joints[0].length = 0.0; },
       "'length' in joint[0] must be a positive length"},
      {[](Scene& s) { s.joints[1].motor->strength = 0; }, "'force' in joint[1] must be positive"},
      {[](Scene& s) { s.joints[0].break_force = -1; }, "'break_force' in joint[0]"},
      {[](Scene& s) { s.emitters[0].every = 0; }, "'every' in emitter 'emitted1' must be positive"},
      {[](Scene& s) { s.emitters[0].count = -1; }, "'count' in emitter 'emitted1' must be between"},
  });
}

TEST(Check, ShapesAreConvexAndHaveASize) {
  const auto polygon = [](std::vector<Vec2> corners) {
    return [corners](Scene& s) { s.bodies[0].shapes = {Polygon{corners}}; };
  };
  expectComplaints({
      {[](Scene& s) { s.bodies[0].shapes.clear(); }, "body 'ball': a body needs a shape"},
      {[](Scene& s) {
         s.bodies[0].shapes = {Circle{Vec2::Zero(), 0}};
       },
       "'circle' in body 'ball' must be a positive length"},
      {polygon({{0, 0}, {1, 0}}), "a convex polygon has 3 to 8 corners, this one has 2"},
      {polygon({{0, 0}, {0, 1}, {1, 0}}), "turn left, counter-clockwise"},
      {polygon({{0, 0}, {2, 0}, {0.1, 0.1}, {0, 2}}), "turn left, counter-clockwise"},
      {polygon({{0, 0}, {1, 0}, {2, 0}}), "the polygon has no area"},
      {polygon({{0, 0}, {kNan, 0}, {0, 1}}), "'polygon[0]' in body 'ball' must be a finite"},
  });
}

TEST(Check, ReferencesAndCountsAreThoseOfTheScene) {
  expectComplaints({
      {[](Scene& s) { s.springs[0].body = 4; }, "spring[0]: there is no body 4: the scene has 4"},
      {[](Scene& s) { s.springs[0].to_body = 9; }, "spring[0]: there is no body 9"},
      {[](Scene& s) { s.impulses[0].body = 9; }, "impulse[0]: there is no body 9"},
      {[](Scene& s) { s.forces[0].body = 9; }, "force[0]: there is no body 9"},
      {[](Scene& s) { s.magnets[0].body = 9; }, "magnet[0]: there is no body 9"},
      {[](Scene& s) { s.joints[0].a = 9; }, "joint[0]: there is no body 9"},
      {[](Scene& s) { s.joints[0].b = 9; }, "joint[0]: there is no body 9"},
      {[](Scene& s) { s.emitters[0].count = 100'000; }, "a scene has at most 100000 bodies"},
      {[](Scene& s) { s.bodies[1].name = "ball"; }, "two bodies are called 'ball'"},
      {[](Scene& s) { s.bodies[1].name = "b\nall"; }, "without control characters"},
      {[](Scene& s) { s.magnets.push_back(s.magnets[0]); }, "'ground' is a magnet already"},
  });
}

TEST(Check, WhatContradictsItselfIsRefusedInTheWordsOfAFile) {
  expectComplaints({
      {[](Scene& s) { s.bodies[2].script.reset(); }, "a scripted body needs a script"},
      {[](Scene& s) { s.bodies[0].script = SteadyMotion{}; }, "a script needs motion"},
      {[](Scene& s) { s.bodies[1].velocity.x() = 1; }, "a pinned body does not move"},
      {[](Scene& s) { std::get<Keyframes>(*s.bodies[2].script).keys[1].time = 0; },
       "the times of key frames must increase, but 0 follows 0"},
      {[](Scene& s) { std::get<Keyframes>(*s.bodies[2].script).keys.clear(); },
       "a script needs at least one key frame"},
      {[](Scene& s) { s.springs[0].to_body = 0; }, "both ends of the spring are on the same body"},
      {[](Scene& s) { s.springs[0].body = 1; },
       "a spring has no effect on 'ground', which is pinned"},
      {[](Scene& s) { s.forces[0].until = 0; }, "a force must end after it begins"},
      {[](Scene& s) { s.magnets[0].on[1].from = 0.5; }, "must follow one another"},
      {[](Scene& s) { s.joints[0].b = s.joints[0].a; }, "a joint needs two bodies"},
      {[](Scene& s) { s.joints[0].to = s.joints[0].at; }, "must be apart"},
      {[](Scene& s) {
         s.joints[1].limits = {1, -1};
       },
       "the lower limit must come first"},
      {[](Scene& s) { s.joints[1].axis.setZero(); }, "'axis' must not be [0, 0]"},
      {[](Scene& s) { s.joints[1].a = 1; }, "a joint to the world has no effect on 'ground'"},
      {[](Scene& s) { s.emitters[0].body.motion = Motion::Pinned; },
       "an emitter's bodies are dynamic"},
  });
}

}  // namespace
}  // namespace merge2d
