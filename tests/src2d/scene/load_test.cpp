/// What text scenes say when they are right.

#include "src2d/scene/load.h"

#include <numbers>

#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(Load, AnEmptySceneHasTheDefaultsOfTheContract) {
  const Scene scene = parseScene("format = 1\n", "folder/empty.toml");
  EXPECT_EQ(scene.name, "empty");
  EXPECT_EQ(scene.title, "empty");
  EXPECT_EQ(scene.gravity, Vec2(0, -9.81));
  EXPECT_EQ(scene.step, 0.01);
  EXPECT_EQ(scene.seed, 1u);
  EXPECT_FALSE(scene.camera.has_value());
  EXPECT_EQ(scene.settings.merging.velocity, 1e-2);
  EXPECT_EQ(scene.settings.solver.iterations, 10);
  EXPECT_THAT(scene.warnings, ElementsAre("folder/empty.toml: the scene has no bodies"));
}

TEST(Load, TheWorldAndTheCameraAreRead) {
  const Scene scene = parseScene(R"(
format = 1
title = "A title"
gravity = [1, -2]
step = 0.005
duration = 7.5
seed = 42
[camera]
center = [3, 4]
height = 12
)",
                                 "s.toml");
  EXPECT_EQ(scene.title, "A title");
  EXPECT_EQ(scene.gravity, Vec2(1, -2));
  EXPECT_EQ(scene.step, 0.005);
  EXPECT_EQ(scene.duration, 7.5);
  EXPECT_EQ(scene.seed, 42u);
  ASSERT_TRUE(scene.camera.has_value());
  EXPECT_EQ(scene.camera->center, Vec2(3, 4));
  EXPECT_EQ(scene.camera->height, 12.0);
}

TEST(Load, EverySettingIsRead) {
  const Settings s = parseScene(R"(
[solver]
method = "pgs"
iterations = 30
erp = 0.1
compliance = 0.02
max_correction = 0.25
margin = 0.001
restitution_velocity = 0.75
[merging]
rule = "paper"
velocity = 0.03
breathing = 1e-6
sliding = 0.04
steps = 5
cycles = "rigid"
metric = "naive"
[unmerging]
rule = "paper"
velocity = 0.05
sliding = 0.06
steps = 7
sweeps = 2
ordering = false
[sleeping]
velocity = 1e-4
steps = 9
[material]
friction = 0.3
restitution = 0.5
density = 2
[drawing]
pixel = 0.2
stiffness = 100
damping = 10
pinned_until = 3
)",
                                "s.toml")
                         .settings;
  EXPECT_EQ(s.solver.method, SolverMethod::Pgs);
  EXPECT_EQ(s.solver.iterations, 30);
  EXPECT_EQ(s.solver.erp, 0.1);
  EXPECT_EQ(s.solver.compliance, 0.02);
  EXPECT_EQ(s.solver.max_correction, 0.25);
  EXPECT_EQ(s.solver.margin, 0.001);
  EXPECT_EQ(s.solver.restitution_velocity, 0.75);
  EXPECT_EQ(s.merging.rule, MergingRule::Paper);
  EXPECT_EQ(s.merging.velocity, 0.03);
  EXPECT_EQ(s.merging.breathing, 1e-6);
  EXPECT_EQ(s.merging.sliding, 0.04);
  EXPECT_EQ(s.merging.steps, 5);
  EXPECT_EQ(s.merging.cycles, CycleCriterion::Rigid);
  EXPECT_EQ(s.merging.metric, Metric::Naive);
  EXPECT_EQ(s.unmerging.rule, UnmergingRule::Paper);
  EXPECT_EQ(s.unmerging.velocity, 0.05);
  EXPECT_EQ(s.unmerging.sliding, 0.06);
  EXPECT_EQ(s.unmerging.steps, 7);
  EXPECT_EQ(s.unmerging.sweeps, 2);
  EXPECT_FALSE(s.unmerging.ordering);
  EXPECT_EQ(s.sleeping.velocity, 1e-4);
  EXPECT_EQ(s.sleeping.steps, 9);
  EXPECT_EQ(s.material.friction, 0.3);
  EXPECT_EQ(s.material.restitution, 0.5);
  EXPECT_EQ(s.material.density, 2);
  EXPECT_EQ(s.drawing.pixel, 0.2);
  EXPECT_EQ(s.drawing.stiffness, 100);
  EXPECT_EQ(s.drawing.damping, 10);
  EXPECT_EQ(s.drawing.pinned_until, 3);
}

TEST(Load, ABodyIsReadWithDegreesAsRadians) {
  const Scene scene = parseScene(R"(
[material]
friction = 0.25
[[body]]
name = "box"
at = [1, 2]
angle = 90
velocity = [3, 4]
spin = 180
box = [2, 1]
mass = 5
restitution = 0.5
pinned_until = 1.5
)",
                                 "s.toml");
  ASSERT_EQ(scene.bodies.size(), 1u);
  const BodyDesc& body = scene.bodies[0];
  EXPECT_EQ(body.name, "box");
  EXPECT_EQ(body.motion, Motion::Dynamic);
  EXPECT_EQ(body.at, Vec2(1, 2));
  EXPECT_DOUBLE_EQ(body.angle, 90 * kDegree);
  EXPECT_EQ(body.velocity, Vec2(3, 4));
  EXPECT_DOUBLE_EQ(body.spin, 180 * kDegree);
  EXPECT_EQ(body.mass, 5.0);
  EXPECT_EQ(body.friction, 0.25);
  EXPECT_EQ(body.restitution, 0.5);
  EXPECT_EQ(body.pinned_until, 1.5);
  ASSERT_EQ(body.shapes.size(), 1u);
  EXPECT_DOUBLE_EQ(areaProperties(body.shapes).area, 2.0);
}

TEST(Load, ShapesHaveTheirPlaceInTheBody) {
  const Scene scene = parseScene(R"(
[[body]]
shapes = [
  { box = [2, 1], at = [3, 0], angle = 90 },
  { circle = 0.5, at = [0, -1] },
]
)",
                                 "s.toml");
  ASSERT_EQ(scene.bodies[0].shapes.size(), 2u);
  const auto& box = std::get<Polygon>(scene.bodies[0].shapes[0]);
  EXPECT_NEAR(box.vertices[0].x(), 3.5, 1e-12);
  EXPECT_NEAR(box.vertices[0].y(), -1.0, 1e-12);
  const auto& circle = std::get<Circle>(scene.bodies[0].shapes[1]);
  EXPECT_EQ(circle.center, Vec2(0, -1));
  EXPECT_EQ(circle.radius, 0.5);
}

TEST(Load, AConcavePolygonBecomesConvexPiecesOfTheSameArea) {
  const Scene scene = parseScene(R"(
[[body]]
polygon = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
)",
                                 "s.toml");
  EXPECT_GT(scene.bodies[0].shapes.size(), 1u);
  EXPECT_NEAR(areaProperties(scene.bodies[0].shapes).area, 3.0, 1e-12);
}

TEST(Load, RepeatWritesOutStaggeredCopies) {
  const Scene scene = parseScene(R"(
[[body]]
name = "brick"
at = [10, 1]
box = [1, 0.5]
repeat = { count = [2, 3], spacing = [1.5, 0.5], stagger = 0.5 }
)",
                                 "s.toml");
  ASSERT_EQ(scene.bodies.size(), 6u);
  EXPECT_EQ(scene.bodies[1].name, "brick[1,0]");
  EXPECT_EQ(scene.bodies[1].at, Vec2(11.5, 1));
  EXPECT_EQ(scene.bodies[2].name, "brick[0,1]");
  EXPECT_EQ(scene.bodies[2].at, Vec2(10.75, 1.5));
  EXPECT_EQ(scene.bodies[5].name, "brick[1,2]");
  EXPECT_EQ(scene.bodies[5].at, Vec2(11.5, 2));
}

TEST(Load, BodiesWithoutANameAreNumbered) {
  const Scene scene = parseScene("[[body]]\ncircle = 1\n[[body]]\ncircle = 1\n", "s.toml");
  EXPECT_EQ(scene.bodies[0].name, "body1");
  EXPECT_EQ(scene.bodies[1].name, "body2");
}

TEST(Load, TheThreeScriptsAreRead) {
  const Scene scene = parseScene(R"(
[[body]]
motion = "scripted"
at = [5, 6]
box = [1, 1]
script = { axis = [0, 1], amplitude = 2, period = 4 }
[[body]]
motion = "scripted"
box = [1, 1]
script = { keyframes = [[1, 2, 3, 90], [2, 4, 5, 180]] }
[[body]]
motion = "scripted"
box = [1, 1]
script = { velocity = [1, 0], spin = 45 }
)",
                                 "s.toml");
  const auto& sinusoid = std::get<Sinusoid>(scene.bodies[0].script.value());
  EXPECT_EQ(sinusoid.axis, Vec2(0, 1));
  EXPECT_EQ(sinusoid.amplitude, 2);
  EXPECT_EQ(sinusoid.period, 4);
  const auto& path = std::get<Keyframes>(scene.bodies[1].script.value());
  ASSERT_EQ(path.keys.size(), 2u);
  EXPECT_EQ(path.keys[1].time, 2);
  EXPECT_EQ(path.keys[1].position, Vec2(4, 5));
  EXPECT_DOUBLE_EQ(path.keys[1].angle, std::numbers::pi);
  EXPECT_EQ(scene.bodies[1].at, Vec2(2, 3)) << "it starts at its first key frame";
  EXPECT_DOUBLE_EQ(scene.bodies[1].angle, 90 * kDegree);
  const auto& steady = std::get<SteadyMotion>(scene.bodies[2].script.value());
  EXPECT_EQ(steady.velocity, Vec2(1, 0));
  EXPECT_DOUBLE_EQ(steady.spin, 45 * kDegree);
}

TEST(Load, SpringsImpulsesForcesAndMagnetsFindTheirBodies) {
  const Scene scene = parseScene(R"(
[[body]]
name = "a"
circle = 1
[[body]]
name = "b"
circle = 1
[[spring]]
body = "b"
anchor = [1, 0]
to = [1, 5]
stiffness = 100
damping = 2
rest_length = 3
[[spring]]
body = "a"
to_body = "b"
to_anchor = [0, 1]
stiffness = 50
[[impulse]]
body = "b"
at = [0, 1]
impulse = [3, 4]
time = 2
[[force]]
body = "a"
force = [5, 6]
from = 1
[[magnet]]
body = "b"
on = [[0, 1], [2, 3]]
[[magnet]]
body = "a"
)",
                                 "s.toml");
  ASSERT_EQ(scene.springs.size(), 2u);
  EXPECT_EQ(scene.springs[0].body, 1u);
  EXPECT_EQ(scene.springs[0].to, Vec2(1, 5));
  EXPECT_FALSE(scene.springs[0].to_body.has_value());
  EXPECT_EQ(scene.springs[0].rest_length, 3);
  EXPECT_EQ(scene.springs[1].to_body, 1u);
  EXPECT_EQ(scene.springs[1].to, Vec2(0, 1));
  EXPECT_EQ(scene.impulses[0].impulse, Vec2(3, 4));
  EXPECT_EQ(scene.impulses[0].time, 2);
  EXPECT_EQ(scene.forces[0].from, 1);
  EXPECT_EQ(scene.forces[0].until, kForever);
  ASSERT_EQ(scene.magnets[0].on.size(), 2u);
  EXPECT_EQ(scene.magnets[0].on[1].from, 2);
  ASSERT_EQ(scene.magnets[1].on.size(), 1u);
  EXPECT_EQ(scene.magnets[1].on[0].until, kForever);
}

TEST(Load, AnEmitterEndsByCountOrByTime) {
  const Scene scene = parseScene(R"(
seed = 10
[[emitter]]
name = "a"
every = 0.1
start = 0.1
until = 0.4
circle = 1
[[emitter]]
name = "b"
every = 1
count = 5
spread = [1, 2]
seed = 3
velocity = [0, -1]
circle = 1
[[emitter]]
every = 1
count = 5
until = 100
circle = 1
)",
                                 "s.toml");
  ASSERT_EQ(scene.emitters.size(), 3u);
  EXPECT_EQ(scene.emitters[0].count, 3) << "at 0.1, 0.2 and 0.3 s";
  EXPECT_EQ(scene.emitters[0].start, 0.1);
  EXPECT_EQ(scene.emitters[0].seed, 10u) << "from the scene's";
  EXPECT_EQ(scene.emitters[1].count, 5);
  EXPECT_EQ(scene.emitters[1].spread, Vec2(1, 2));
  EXPECT_EQ(scene.emitters[1].seed, 3u);
  EXPECT_EQ(scene.emitters[1].body.velocity, Vec2(0, -1));
  EXPECT_EQ(scene.emitters[2].body.name, "emitted3");
  EXPECT_EQ(scene.emitters[2].count, 5);
  EXPECT_EQ(scene.emitters[2].seed, 12u);
}

TEST(Load, AFileIsFoundByItsPath) {
  const TemporaryFile file("found.toml", "[[body]]\ncircle = 1\n");
  const Scene scene = loadScene(file.path().string());
  EXPECT_EQ(scene.name, "found");
  EXPECT_EQ(scene.bodies.size(), 1u);
}

TEST(Load, WhatIsNotThereIsNamed) {
  const auto error = [](const std::string& name) -> std::string {
    try {
      loadScene(name);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(error("nowhere/x.toml"), "there is no file nowhere/x.toml");
  EXPECT_EQ(error("tower-platfrom"),
            "no built-in scene is called 'tower-platfrom' (did you mean 'tower-platform'?); "
            "`merge2d list` names them all");
  EXPECT_EQ(error(testing::TempDir()), testing::TempDir() + " is a folder, not a scene");
}

TEST(Builtin, EveryBuiltinSceneLoadsWithoutWarnings) {
  const std::vector<BuiltinScene> all = builtinScenes();
  EXPECT_GE(all.size(), 6u);
  for (const BuiltinScene& builtin : all) {
    const Scene scene = loadScene(builtin.name);
    EXPECT_EQ(scene.title, builtin.title);
    EXPECT_EQ(scene.name, builtin.name);
    EXPECT_TRUE(scene.warnings.empty()) << builtin.name;
  }
}

TEST(Builtin, TheTowerHasTheNumberOfBodiesOfThePaper) {
  EXPECT_EQ(loadScene("tower-platform").bodies.size(), 326u + 1u) << "and the ground";
}

TEST(Builtin, AnotherFolderMayBeNamedInTheEnvironment) {
  const TemporaryFile file("other-scene.toml", "title = \"Other\"\n");
  ASSERT_EQ(setenv("MERGE2D_SCENES", file.path().parent_path().c_str(), 1), 0);
  EXPECT_EQ(loadScene("other-scene").title, "Other");
  ASSERT_EQ(unsetenv("MERGE2D_SCENES"), 0);
}

}  // namespace
}  // namespace merge2d
