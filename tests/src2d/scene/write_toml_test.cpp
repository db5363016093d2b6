/// Scenes survive being written and read again.

#include <numbers>
#include <random>

#include "src2d/scene/toml_reader.h"
#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

void expectSame(const ConvexShape& a, const ConvexShape& b) {
  ASSERT_EQ(a.index(), b.index());
  if (const auto* circle = std::get_if<Circle>(&a)) {
    EXPECT_EQ(circle->center, std::get<Circle>(b).center);
    EXPECT_EQ(circle->radius, std::get<Circle>(b).radius);
  } else {
    EXPECT_EQ(std::get<Polygon>(a).vertices, std::get<Polygon>(b).vertices);
  }
}

void expectSame(const BodyDesc& a, const BodyDesc& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.motion, b.motion);
  EXPECT_EQ(a.at, b.at);
  EXPECT_DOUBLE_EQ(a.angle, b.angle);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_DOUBLE_EQ(a.spin, b.spin);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.density, b.density);
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.restitution, b.restitution);
  EXPECT_EQ(a.pinned_until, b.pinned_until);
  EXPECT_EQ(a.script.has_value(), b.script.has_value());
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (std::size_t i = 0; i < a.shapes.size(); ++i) expectSame(a.shapes[i], b.shapes[i]);
}

/// Writes, reads, compares, and returns what was read.
Scene roundTrip(const Scene& scene) {
  const std::string text = toToml(scene);
  Scene again = parseScene(text, scene.name + ".toml");
  EXPECT_EQ(again.name, scene.name);
  EXPECT_EQ(again.title, scene.title);
  EXPECT_EQ(again.gravity, scene.gravity);
  EXPECT_EQ(again.step, scene.step);
  EXPECT_EQ(again.duration, scene.duration);
  EXPECT_EQ(again.seed, scene.seed);
  EXPECT_EQ(again.camera.has_value(), scene.camera.has_value());
  EXPECT_EQ(again.springs.size(), scene.springs.size());
  EXPECT_EQ(again.bodies.size(), scene.bodies.size());
  for (std::size_t i = 0; i < std::min(again.bodies.size(), scene.bodies.size()); ++i) {
    expectSame(again.bodies[i], scene.bodies[i]);
  }
  EXPECT_EQ(toToml(again), text) << "a second time, every letter is the same";
  return again;
}

TEST(WriteToml, ABuiltinSceneReadsBackTheSame) {
  for (const BuiltinScene& builtin : builtinScenes()) roundTrip(loadScene(builtin.name));
}

TEST(WriteToml, EveryKindOfThingReadsBackTheSame) {
  const Scene again = roundTrip(parseScene(R"(
title = "Quotes \" and \\ and \u0001 and µ"
gravity = [0.1, -9.81]
seed = 77
[camera]
center = [1, 2]
height = 3
[solver]
method = "block"
[merging]
cycles = "off"
metric = "naive"
velocity = 0.1
[unmerging]
ordering = false
[material]
friction = 0.1
density = 3
[[body]]
name = "frame"
motion = "scripted"
script = { keyframes = [[0, 1, 2, 30], [1.5, 3, 4, -77.7]] }
shapes = [{ box = [1, 2], at = [0.3, 0.1] }, { circle = 0.1, at = [1, 1] },
          { box = [1, 2], angle = 30 }, { polygon = [[0, 0], [1, 0], [0, 1]] }]
[[body]]
name = "wave"
motion = "scripted"
script = { axis = [0.1, 0.2], amplitude = 0.3, period = 4 }
circle = 0.7
[[body]]
name = "wheel"
motion = "scripted"
script = { velocity = [0.1, 0.2], spin = 123.4 }
polygon = [[0, 0], [1, 0], [0, 1]]
[[body]]
name = "free"
at = [0.1, 0.7]
angle = 33.3
spin = -7
velocity = [1, 2]
mass = 2.5
density = 7
friction = 0.9
restitution = 0.25
pinned_until = 1.25
box = [0.1, 0.2]
[[body]]
name = "pin"
motion = "pinned"
circle = 1
[[spring]]
body = "free"
anchor = [0.1, 0]
to = [0.3, 4]
stiffness = 10
damping = 1
rest_length = 0.5
[[spring]]
body = "pin"
to_body = "free"
to_anchor = [0.1, 0.2]
stiffness = 10
[[impulse]]
body = "free"
at = [0.1, 0.2]
impulse = [0.3, 0.4]
time = 0.5
[[force]]
body = "free"
force = [1, 0]
[[force]]
body = "free"
at = [0.1, 0.2]
force = [1, 0]
from = 1
until = 2
[[magnet]]
body = "free"
[[magnet]]
body = "pin"
on = [[0.5, 1], [2, 3]]
[[emitter]]
name = "drop"
every = 0.1
until = 2
spread = [0.1, 0]
circle = 0.2
at = [0, 9]
)",
                                           "all.toml"));
  EXPECT_EQ(again.settings.solver.method, SolverMethod::Block);
  EXPECT_EQ(again.settings.merging.cycles, CycleCriterion::Off);
  EXPECT_EQ(again.settings.merging.metric, Metric::Naive);
  EXPECT_EQ(again.settings.material.density, 3);
  EXPECT_EQ(again.springs[0].rest_length, 0.5);
  EXPECT_EQ(again.springs[1].to_body, 3u);
  EXPECT_EQ(again.impulses[0].time, 0.5);
  EXPECT_EQ(again.forces[0].until, kForever);
  EXPECT_EQ(again.forces[1].until, 2);
  EXPECT_EQ(again.magnets[0].on[0].until, kForever);
  EXPECT_EQ(again.magnets[1].on[1].from, 2);
  EXPECT_EQ(again.emitters[0].count, 20);
  EXPECT_EQ(again.emitters[0].seed, 77u);
}

TEST(WriteToml, DegreesComeBackAsTheSameRadians) {
  EXPECT_EQ(degrees(radians(30)), 30);
  EXPECT_EQ(degrees(radians(-77.7)), -77.7);
  EXPECT_EQ(degrees(std::numbers::pi), 180);
  EXPECT_EQ(degrees(0), 0);
}

/// Arbitrary numbers, the same in each run.
class Arbitrary {
 public:
  double number(double from, double to) {
    return from + (to - from) * static_cast<double>(engine_() >> 11u) * 0x1p-53;
  }
  int whole(int from, int to) {
    return from + static_cast<int>(engine_() % static_cast<unsigned>(to - from));
  }
  bool coin() { return engine_() % 2 == 0; }

 private:
  std::mt19937_64 engine_{1};
};

TEST(WriteToml, AnyAngleComesBackWithinOneUnitInTheLastPlace) {
  Arbitrary any;
  for (int i = 0; i < 20'000; ++i) {
    const double angle = any.number(-100, 100);
    const double back = radians(degrees(angle));
    EXPECT_GE(back, std::nextafter(angle, -1e9));
    EXPECT_LE(back, std::nextafter(angle, 1e9));
  }
}

TEST(WriteToml, AnyDegreesComeBackTheSame) {
  for (int thousandths = -400'000; thousandths <= 400'000; thousandths += 7) {
    const double angle = radians(thousandths * 1e-3);
    EXPECT_EQ(radians(degrees(angle)), angle);
  }
}

BodyDesc anyBody(Arbitrary& any) {
  BodyDesc body;
  body.at = {any.number(-100, 100), any.number(-100, 100)};
  body.angle = any.number(-10, 10);
  body.velocity = {any.number(-5, 5), any.number(-5, 5)};
  body.spin = any.number(-10, 10);
  for (int k = any.whole(1, 4); k > 0; --k) {
    const double turn = any.coin() ? 0 : any.number(-3, 3);
    const Pose place = Pose::at({any.number(-2, 2), any.number(-2, 2)}, turn);
    if (any.coin()) {
      body.shapes.emplace_back(Circle{place.position, any.number(0.1, 2)});
    } else {
      body.shapes.emplace_back(makeBox(any.number(0.1, 2), any.number(0.1, 2), place));
    }
  }
  if (any.coin()) body.mass = any.number(0.1, 50);
  return body;
}

TEST(WriteToml, AnySceneOfBoxesAndDiscsReadsBackTheSame) {
  Arbitrary any;
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    Scene scene;
    scene.name = scene.title = "any";
    for (int k = any.whole(1, 6); k > 0; --k) {
      scene.bodies.push_back(anyBody(any));
      scene.bodies.back().name = "b" + std::to_string(k);
    }
    roundTrip(scene);
  }
}

}  // namespace
}  // namespace merge2d
