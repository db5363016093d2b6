#pragma once
/// Small scenes that many tests stand on, and ways to run and to look at them. Boxes are 1 m wide
/// and weigh 1 kg unless said otherwise; the ground's surface is y = 0.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

#include "src2d/scene/load.h"
#include "src2d/world.h"

namespace merge2d {

inline constexpr double kGravity = 9.81;  ///< [m/s²]
inline constexpr double kDegree = std::numbers::pi / 180.0;

inline BodyDesc box(double width, double height, const Vec2& at) {
  BodyDesc body;
  body.at = at;
  body.shapes = {makeBox(width, height)};
  return body;
}

inline BodyDesc disc(double radius, const Vec2& at) {
  BodyDesc body;
  body.at = at;
  body.shapes = {Circle{.center = Vec2::Zero(), .radius = radius}};
  return body;
}

inline BodyDesc pinned(BodyDesc body) {
  body.motion = Motion::Pinned;
  return body;
}

inline BodyDesc scripted(BodyDesc body, const Script& script) {
  body.motion = Motion::Scripted;
  body.script = script;
  return body;
}

inline BodyDesc named(const std::string& name, BodyDesc body) {
  body.name = name;
  return body;
}

/// A name of its own for each body that has none.
inline void add(Scene& scene, BodyDesc body) {
  if (body.name.empty()) body.name = "body" + std::to_string(scene.bodies.size());
  scene.bodies.push_back(std::move(body));
}

inline Scene noGravity() {
  Scene scene;
  scene.gravity.setZero();
  return scene;
}

/// A pinned floor, 200 m wide: body 0.
inline Scene onGround() {
  Scene scene;
  add(scene, named("ground", pinned(box(200, 1, {0, -0.5}))));
  return scene;
}

inline void addColumn(Scene& scene, int n, const Vec2& foot = Vec2::Zero()) {
  for (int i = 0; i < n; ++i) add(scene, box(1, 1, foot + Vec2(0, 0.5 + i)));
}

/// `n` boxes on each other.
inline Scene column(int n) {
  Scene scene = onGround();
  addColumn(scene, n);
  return scene;
}

/// Boxes of which every other one is heavier, with a light one at the foot.
inline Scene unequalColumn(int n, double ratio) {
  Scene scene = column(n);
  for (int i = 1; i <= n; ++i)
    scene.bodies[static_cast<std::size_t>(i)].density = i % 2 ? 1 : ratio;
  return scene;
}

/// Running bond, with a half brick at both ends of each odd row: no brick overhangs. The lower row
/// stands on y = foot.y, centred on foot.x.
inline void addWall(Scene& scene, int rows, int columns, const Vec2& foot = Vec2::Zero()) {
  const double left = foot.x() - 0.5 * columns;
  for (int row = 0; row < rows; ++row) {
    const double y = foot.y() + 0.5 + row;
    const bool odd = row % 2 == 1;
    if (odd) add(scene, box(0.5, 1, {left + 0.25, y}));
    for (int i = 0; i < columns - (odd ? 1 : 0); ++i) {
      add(scene, box(1, 1, {left + (odd ? 1.0 : 0.5) + i, y}));
    }
    if (odd) add(scene, box(0.5, 1, {left + columns - 0.25, y}));
  }
}

inline Scene wall(int rows, int columns) {
  Scene scene = onGround();
  addWall(scene, rows, columns);
  return scene;
}

/// `base` boxes in the lowest row, one less in each row above.
inline Scene pyramid(int base) {
  Scene scene = onGround();
  for (int row = 0; row < base; ++row) {
    for (int i = 0; i < base - row; ++i) {
      add(scene, box(1, 1, {i - 0.5 * (base - row - 1), 0.5 + row}));
    }
  }
  return scene;
}

/// A half circle of `stones` wedges between the radii 4 m and 5 m, standing on the ground without
/// mortar.
inline Scene arch(int stones) {
  constexpr double kInner = 4.0, kOuter = 5.0;
  Scene scene = onGround();
  const auto at = [&](double radius, int joint) {
    const double angle = std::numbers::pi * joint / stones;
    return Vec2(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int i = 0; i < stones; ++i) {
    BodyDesc stone;
    stone.shapes = {Polygon{{at(kInner, i), at(kOuter, i), at(kOuter, i + 1), at(kInner, i + 1)}}};
    add(scene, stone);
  }
  return scene;
}

/// A wall on a platform that swings sideways with the given peak acceleration: bodies 0 (platform)
/// and on.
inline Scene wallOnSwingingPlatform(int rows, int columns, double acceleration, double period) {
  const double omega = 2.0 * std::numbers::pi / period;
  const Sinusoid swing{
      .axis = Vec2::UnitX(), .amplitude = acceleration / (omega * omega), .period = period};
  Scene scene;
  add(scene, named("platform", scripted(box(columns + 4.0, 1, {0, -0.5}), swing)));
  addWall(scene, rows, columns);
  return scene;
}

/// The same scene, further on.
inline Scene shifted(Scene scene, const Vec2& by) {
  for (BodyDesc& body : scene.bodies) {
    body.at += by;
    auto* path = body.script ? std::get_if<Keyframes>(&*body.script) : nullptr;
    if (!path) continue;
    for (Keyframes::Key& key : path->keys) key.position += by;
  }
  for (SpringDesc& spring : scene.springs) {
    if (!spring.to_body) spring.to += by;
  }
  for (ImpulseDesc& impulse : scene.impulses) impulse.at += by;
  return scene;
}

/// A text scene; the line `format = 1` is put in front.
inline Scene sceneOf(std::string_view toml) {
  return parseScene("format = 1\n" + std::string(toml), "test.toml");
}

inline WorldOptions inMode(Mode mode) { return {.mode = mode, .timings = false}; }
inline World reference(const Scene& scene) { return World(scene, inMode(Mode::Reference)); }

inline void runSteps(World& world, int n) {
  for (int i = 0; i < n; ++i) world.step();
}

inline void runSeconds(World& world, double seconds) {
  runSteps(world, static_cast<int>(std::lround(seconds / world.scene().step)));
}

inline BodyId idOf(const World& world, std::string_view name) {
  const auto& bodies = world.bodies();
  const auto at = std::find_if(bodies.begin(), bodies.end(),
                               [&](const BodyInfo& body) { return body.name == name; });
  if (at == bodies.end()) throw std::out_of_range("no body '" + std::string(name) + "'");
  return BodyId{static_cast<std::uint32_t>(at - bodies.begin())};
}

/// What is seen now of a body that is alive.
inline BodyState see(const World& world, BodyId id) {
  for (const BodyState& body : world.capture().bodies) {
    if (body.id == id) return body;
  }
  throw std::out_of_range("body " + std::to_string(index(id)) + " is not alive");
}
inline BodyState see(const World& world, std::string_view name) {
  return see(world, idOf(world, name));
}

/// The largest speed of a dynamic body's centre [m/s].
inline double fastest(const World& world) {
  double speed = 0.0;
  for (const BodyState& body : world.capture().bodies) {
    if (world.bodies()[index(body.id)].motion != Motion::Dynamic) continue;
    speed = std::max(speed, body.v.norm());
  }
  return speed;
}

/// How many events of a type the last step had.
inline int countEvents(const World& world, EventType type) {
  return static_cast<int>(std::count_if(world.events().begin(), world.events().end(),
                                        [&](const Event& e) { return e.type == type; }));
}

}  // namespace merge2d
