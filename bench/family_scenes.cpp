#include "bench/family_scenes.h"

#include <algorithm>
#include <cmath>

#include "bench/random_mounts.h"

namespace merge2d::bench {
namespace {

constexpr double kBefore = 1.9;     // when places are noted [s]
constexpr double kGravity = 9.81;   // [m/s²]
constexpr double kSettled = 2.0;    // when loads begin [s]
constexpr double kTilted = 60.0;    // how far any ground is tilted [degrees]
constexpr double kAtRest = 1000.0;  // the end of scripts [s]

int count(Random& random, int least, int most) {
  return least + static_cast<int>(random.below(static_cast<std::size_t>(most - least + 1)));
}

double side(Random& random) { return random.below(2) == 0 ? -1.0 : 1.0; }

/// Boxes of one size in rows, of which every other is shifted.
struct Wall {
  int columns, rows;
  double width, height;  ///< of a box [m]
  double shift = 0.0;    ///< [m]

  double breadth() const { return columns * width; }
  double size() const { return std::min(width, height); }
  /// Acceleration sideways at which it tips or slides as one [m/s²].
  double carries(double friction) const {
    return kGravity * std::min(friction, (breadth() - shift) / (rows * height));
  }
};

Wall randomWall(Random& random, double breadth, double height) {
  Wall wall{.columns = count(random, 1, 3),
            .rows = count(random, 2, 8),
            .width = oneOf(random, std::array{0.3, 0.5, 0.7}),
            .height = oneOf(random, std::array{0.2, 0.3, 0.5})};
  while (wall.breadth() + 0.5 * wall.width > breadth && wall.columns > 1) --wall.columns;
  while (wall.rows * wall.height > height && wall.rows > 2) --wall.rows;
  if (wall.columns > 1) wall.shift = oneOf(random, std::array{0.0, 0.2, 0.35}) * wall.width;
  return wall;
}

/// How fast a point moves with a body [m/s].
Vec2 velocityAt(const BodyDesc& body, const Vec2& x) {
  return body.velocity + cross(body.spin, x - body.at);
}

/// Adds a wall with the middle of its foot at a place, moving with the first body, and watches it
/// from there.
void add(Structure& s, const Wall& wall, const Vec2& foot) {
  const BodyDesc ground = s.scene.bodies.front();
  for (int row = 0; row < wall.rows; ++row) {
    const double left = -0.5 * (wall.breadth() - wall.width) + wall.shift * ((row % 2) - 0.5);
    for (int column = 0; column < wall.columns; ++column) {
      const Vec2 at = foot + Vec2(left + column * wall.width, (row + 0.5) * wall.height);
      BodyDesc body = box(fmt::format("box[{},{}]", column, row), wall.width, wall.height, at);
      body.velocity = velocityAt(ground, at);
      body.spin = ground.spin;
      s.watched.push_back({.body = s.scene.bodies.size(), .way = 0.25 * wall.size()});
      s.scene.bodies.push_back(body);
    }
  }
}

void setFriction(Scene& scene, double friction) {
  for (BodyDesc& body : scene.bodies) body.friction = friction;
}

BodyDesc pinnedBox(const std::string& name, double width, double height, const Vec2& at) {
  BodyDesc body = box(name, width, height, at);
  body.motion = Motion::Pinned;
  return body;
}

/// Its top is at the height zero.
BodyDesc ground() { return pinnedBox("ground", 60.0, 1.0, {0.0, -0.5}); }

void move(BodyDesc& body, const Script& script) {
  body.motion = Motion::Scripted;
  body.script = script;
}

/// Stays until a time and has moved by a way some seconds later.
Script shifted(const Vec2& at, double from, double seconds, const Vec2& way) {
  return Keyframes{
      {{0.0, at, 0.0}, {from, at, 0.0}, {from + seconds, at + way, 0.0}, {kAtRest, at + way, 0.0}}};
}

/// Turns by an angle about the origin of the frame.
Script turned(const Vec2& at, double from, double seconds, double angle) {
  return Keyframes{
      {{0.0, at, 0.0}, {from, at, 0.0}, {from + seconds, at, angle}, {kAtRest, at, angle}}};
}

/// Swings sideways with a growing amplitude, up to an acceleration after some seconds.
Script shaken(const Vec2& at, double acceleration, double period, double seconds) {
  Keyframes path{{{0.0, at, 0.0}}};
  const double most = acceleration * std::pow(period / (2.0 * std::numbers::pi), 2.0);
  for (int i = 0; kSettled + 0.5 * period * i < kSettled + seconds; ++i) {
    const double time = 0.5 * period * i, x = most * time / seconds * (i % 2 == 0 ? 1.0 : -1.0);
    path.keys.push_back({kSettled + time, at + Vec2(x, 0.0), 0.0});
  }
  path.keys.push_back({kSettled + seconds + 0.5 * period, at, 0.0});
  return path;
}

/// Accelerates ever more, up to `acceleration` after some seconds.
Script rushing(const Vec2& at, double acceleration, double seconds) {
  Keyframes path{{{0.0, at, 0.0}}};
  for (int i = 0; 0.25 * i <= seconds; ++i) {
    const double t = 0.25 * i;
    path.keys.push_back(
        {kSettled + t, at + Vec2(acceleration / seconds * t * t * t / 6.0, 0.0), 0.0});
  }
  return path;
}

/// A force that grows by `rate` [N/s] from the time `from` on: a weak spring to a hand that goes
/// far away.
void pullMoreAndMore(Scene& scene, BodyIndex body, const Vec2& anchor, const Vec2& direction,
                     double rate, double from, double until) {
  constexpr double kSpeed = 4.0;  // [m/s]
  const Vec2 at = scene.bodies[body].at + Pose::at(Vec2::Zero(), scene.bodies[body].angle) * anchor;
  BodyDesc hand = box("hand", 0.1, 0.1, at + 200.0 * direction);
  const double seconds = until - from;
  move(hand, shifted(hand.at, from, seconds, kSpeed * seconds * direction));
  SpringDesc spring;
  spring.body = body;
  spring.anchor = anchor;
  spring.to_body = scene.bodies.size();
  spring.rest_length = 200.0;
  spring.stiffness = rate / kSpeed;
  scene.springs.push_back(spring);
  scene.bodies.push_back(hand);
}

double massOf(const BodyDesc& body) {
  return body.mass ? *body.mass : body.density * areaProperties(body.shapes).area;
}

double massOf(const Scene& scene) {
  double mass = 0.0;
  for (const BodyDesc& body : scene.bodies) {
    if (body.motion == Motion::Dynamic) mass += massOf(body);
  }
  return mass;
}

}  // namespace

Structure movingFrame(Random& random) {
  Structure s{.kind = "mount"};
  const std::size_t kind = random.below(8);
  BodyDesc seat = box("seat", 3.0, 0.2, {0.0, 0.0});
  seat.mass = oneOf(random, std::array{5.0, 30.0, 300.0});
  s.scene.bodies.push_back(seat);
  const Wall wall = randomWall(random, 2.5, 3.0);
  const double friction = random.between(0.3, 1.2), most = wall.carries(friction);
  BodyDesc& moves = s.scene.bodies.front();
  const double factor = random.between(0.9, 2.0);
  if (kind == 0) {
    s.kind = "shaken";
    move(moves, shaken(seat.at, factor * most, random.between(0.7, 2.5), 8.0));
  } else if (kind == 1) {
    s.kind = "lift";
    const Vec2 way(side(random) * random.between(0.5, 3.0), random.between(-1.0, 3.0));
    move(moves, shifted(seat.at, kSettled, std::sqrt(6.0 * way.norm() / (factor * most)), way));
  } else if (kind == 2) {
    s.kind = "tilt";
    const double angle = std::atan(factor * most / kGravity);
    const double seconds = random.between(2.0, 10.0);
    move(moves, turned(seat.at, kSettled, seconds, side(random) * angle));
    s.until = kSettled + seconds + 2.0;
  } else if (kind == 3) {
    s.kind = "rush";
    move(moves, rushing(seat.at, factor * most, 8.0));
  } else {
    kMounts[kind - 4](s.scene, random);
  }
  s.from = kind < 4 ? kBefore : 0.0;
  add(s, wall, {random.between(-0.2, 0.2), 0.1});
  setFriction(s.scene, friction);
  return s;
}

namespace {

/// A ring of boxes that turns, with its lowest inner side at the height zero.
BodyDesc turningDrum(Random& random, int sides, double radius) {
  BodyDesc body;
  body.name = "drum";
  body.at = {0.0, radius};
  const double length = 2.0 * radius * std::tan(std::numbers::pi / sides);
  for (int i = 0; i < sides; ++i) {
    const Pose out = Pose::at(Vec2::Zero(), 2.0 * std::numbers::pi * i / sides);
    body.shapes.push_back(makeBox(length, 0.2, out * Pose::at({0.0, -radius - 0.1}, 0.0)));
  }
  const double rate = side(random) * random.between(2.0, 20.0) * kDegree;
  constexpr double kTurn = 2.0;  // [rad]
  move(body, turned(body.at, kSettled, kTurn / std::abs(rate), std::copysign(kTurn, rate)));
  return body;
}

/// A hinge far above the seat.
void hangOnHinge(Scene& scene, double length) {
  JointDesc pin;
  pin.at = {0.0, length};
  scene.joints.push_back(pin);
}

/// Two rods, which turn the seat as it swings where they part or meet upwards.
void hangOnRods(Scene& scene, double length, double spread) {
  for (const double x : {-1.0, 1.0}) {
    JointDesc rod;
    rod.kind = JointKind::Distance;
    rod.at = {1.4 * x, 0.0};
    rod.to = {(1.4 + spread) * x, length};
    scene.joints.push_back(rod);
  }
}

/// Hangs at rest; a spring to a hand that moves to and fro swings it more and more.
Structure swing(Random& random) {
  Structure s{.kind = "rods", .from = kBefore, .until = 20.0};
  BodyDesc seat = box("seat", 3.0, 0.2, {0.0, 0.0});
  seat.mass = oneOf(random, std::array{10.0, 50.0, 300.0});
  s.scene.bodies.push_back(seat);
  const double length = random.between(1.5, 5.0);
  if (random.below(3) == 0) {
    s.kind = "hinge";
    hangOnHinge(s.scene, length);
  } else {
    hangOnRods(s.scene, length, random.below(2) == 0 ? 0.0 : random.between(-0.8, 0.8));
  }
  add(s, randomWall(random, 2.5, 2.0), {random.between(-0.5, 0.5), 0.1});
  setFriction(s.scene, random.between(0.2, 0.9));
  BodyDesc hand = box("hand", 0.1, 0.1, {-50.0, 0.0});
  const double period =
      2.0 * std::numbers::pi * std::sqrt(length / kGravity) * random.between(0.9, 1.1);
  move(hand, shaken(hand.at, random.between(1.0, 4.0) * kGravity, period, 18.0));
  SpringDesc pull;
  pull.to_body = s.scene.bodies.size();
  pull.rest_length = 50.0;
  pull.stiffness = 0.2 * massOf(s.scene) * kGravity / length;
  s.scene.springs.push_back(pull);
  s.scene.bodies.push_back(hand);
  return s;
}

}  // namespace

Structure drum(Random& random) {
  if (random.below(2) == 0) return swing(random);
  Structure s{.kind = "drum", .from = kBefore};
  const int sides = count(random, 5, 9);
  const double radius = random.between(1.5, 2.5);
  s.scene.bodies.push_back(turningDrum(random, sides, radius));
  const auto& path = std::get<Keyframes>(*s.scene.bodies.front().script);
  s.until = std::min(20.0, path.keys[2].time);
  const double length = 2.0 * radius * std::tan(std::numbers::pi / sides);
  add(s, randomWall(random, 0.9 * length, 1.2 * radius), {0.0, 0.0});
  setFriction(s.scene, random.between(0.3, 1.0));
  return s;
}

namespace {

/// A piece of a ring about the origin, as a body at its middle.
BodyDesc ringPiece(const std::string& name, double inner, double outer, double from, double to) {
  const auto at = [](double r, double angle) {
    return Vec2(r * std::cos(angle), r * std::sin(angle));
  };
  BodyDesc body;
  body.name = name;
  body.at = at(0.5 * (inner + outer), 0.5 * (from + to));
  Polygon polygon{{at(inner, from), at(outer, from), at(outer, to), at(inner, to)}};
  for (Vec2& v : polygon.vertices) v -= body.at;
  body.shapes = {polygon};
  return body;
}

/// Voussoirs between two abutments.
Structure roundArch(Random& random) {
  Structure s{.kind = "spread", .from = kBefore};
  const int n = count(random, 4, 11);
  const double radius = random.between(1.5, 3.0), half = 0.5 * radius * random.between(0.13, 0.3);
  const double start = oneOf(random, std::array{0.0, 15.0, 30.0}) * kDegree;
  const double step = (std::numbers::pi - 2.0 * start) / n;
  const double inner = radius - half, outer = radius + half, ends = std::numbers::pi - start;
  s.scene.bodies.push_back(ringPiece("right", inner - half, outer + half, start - 0.3, start));
  s.scene.bodies.push_back(ringPiece("left", inner - half, outer + half, ends, ends + 0.3));
  for (BodyDesc& body : s.scene.bodies) body.motion = Motion::Pinned;
  const double size = std::min(2.0 * half, radius * step);
  for (int i = 0; i < n; ++i) {
    const std::string name = fmt::format("stone[{}]", i);
    s.watched.push_back({.body = s.scene.bodies.size(), .way = 0.25 * size});
    s.scene.bodies.push_back(
        ringPiece(name, inner, outer, start + i * step, start + (i + 1) * step));
  }
  setFriction(s.scene, random.between(0.5, 1.0));
  if (random.below(2) == 0) {
    BodyDesc& right = s.scene.bodies.front();
    const double way = radius * random.between(0.05, 0.5), speed = random.between(0.02, 0.15);
    move(right, shifted(right.at, kSettled, way / speed, {way, random.between(-0.3, 0.3) * way}));
    for (Watch& w : s.watched) w.frame = 1;
    s.until = kSettled + way / speed + 3.0;
  } else {
    s.kind = "load";
    s.until = 15.0;
    const auto stone = static_cast<BodyIndex>(2 + count(random, n / 4, 3 * n / 4));
    const double lean = random.between(-0.4, 0.4);
    pullMoreAndMore(s.scene, std::min<BodyIndex>(stone, static_cast<BodyIndex>(n + 1)),
                    Vec2::Zero(), {std::sin(lean), -std::cos(lean)},
                    massOf(s.scene) * kGravity * random.between(0.05, 0.5), kSettled, s.until);
  }
  return s;
}

/// A lintel on two piers of boxes laid flat, of which each lies a little farther inward.
Structure corbels(Random& random) {
  Structure s{.kind = "corbels", .from = kBefore};
  const double gap = random.between(1.0, 2.5), width = random.between(0.6, 1.2);
  const double height = random.between(0.15, 0.4);
  const int rows = count(random, 2, 6);
  const double step = random.between(0.0, 0.8) * width / rows / 2.0;
  for (const double x : {-1.0, 1.0}) {
    s.scene.bodies.push_back(
        pinnedBox(x < 0 ? "left" : "right", 1.5 * width, 0.4, {x * (gap + width) / 2.0, -0.2}));
  }
  for (int row = 0; row < rows; ++row) {
    for (const double x : {-1.0, 1.0}) {
      s.watched.push_back(
          {.body = s.scene.bodies.size(), .frame = x < 0 ? 0U : 1U, .way = 0.25 * height});
      s.scene.bodies.push_back(box(fmt::format("{}[{}]", x < 0 ? "west" : "east", row), width,
                                   height,
                                   {x * ((gap + width) / 2.0 - step * row), (row + 0.5) * height}));
    }
  }
  const double length = gap + width * random.between(0.4, 1.8);
  s.watched.push_back({.body = s.scene.bodies.size(), .way = kNever});
  s.scene.bodies.push_back(box("lintel", length, height, {0.0, (rows + 0.5) * height}));
  setFriction(s.scene, random.between(0.3, 1.0));
  for (BodyDesc& body :
       s.scene.bodies) {  // the lintel slides on one seat, not now on one now on both
    if (body.at.x() < 0.0) body.friction *= 1.5;
  }
  BodyDesc& right = s.scene.bodies[1];
  if (random.below(2) == 0) {
    const double way = width * random.between(0.4, 2.0), speed = random.between(0.03, 0.2);
    move(right, shifted(right.at, kSettled, way / speed, {way, 0.0}));
    s.until = kSettled + way / speed + 3.0;
  } else {
    s.until = 15.0;
    const double lean = random.between(-1.3, 1.3);
    const BodyIndex lintel = s.scene.bodies.size() - 1;
    pullMoreAndMore(s.scene, lintel, {random.between(-0.4, 0.4) * length, 0.5 * height},
                    {std::sin(lean), -std::cos(lean)},
                    massOf(s.scene) * kGravity * random.between(0.03, 0.3), kSettled, s.until);
  }
  return s;
}

}  // namespace

Structure arch(Random& random) {
  return random.below(3) == 0 ? corbels(random) : roundArch(random);
}

Structure ladder(Random& random) {
  Structure s{.kind = "load", .from = kBefore};
  const double length = random.between(2.0, 4.0), half = random.between(0.04, 0.1);
  const double lean = random.between(8.0, 40.0) * kDegree;
  const double friction = std::tan(lean) * random.between(0.5, 0.85);
  s.scene.bodies.push_back(pinnedBox("floor", 30.0, 1.0, {0.0, -0.5}));
  s.scene.bodies.push_back(pinnedBox("wall", 1.0, 8.0, {-0.5, 4.0}));
  const double cosine = std::cos(lean), sine = std::sin(lean);
  // Each leans to the left, on the wall or on the one before.
  const int planks = count(random, 1, 3);
  for (int i = 0; i < planks; ++i) {
    const double past = 2.0 * half * i / cosine;
    BodyDesc plank =
        box(fmt::format("plank[{}]", i), 2.0 * half, length,
            {0.5 * length * sine + half * cosine + past, 0.5 * length * cosine + half * sine});
    plank.angle = lean;
    const Watch foot{.body = s.scene.bodies.size(),
                     .way = 0.06 * length,
                     .turn = kNever,
                     .at = {-half, -0.5 * length}};
    s.watched.push_back(foot);
    s.scene.bodies.push_back(plank);
  }
  setFriction(s.scene, friction);
  const std::size_t kind = random.below(3);
  if (kind == 0) {
    s.until = 15.0;
    const double place = random.between(0.0, 0.5) * length, towards = random.between(-0.3, 0.3);
    pullMoreAndMore(s.scene, s.scene.bodies.size() - 1, {0.0, place},
                    {std::sin(towards), -std::cos(towards)},
                    massOf(s.scene) * kGravity * random.between(0.05, 0.6), kSettled, s.until);
  } else if (kind == 1) {
    s.kind = "floor slides";
    const double way = length * random.between(0.2, 0.9), speed = random.between(0.02, 0.2);
    move(s.scene.bodies[0], shifted({0.0, -0.5}, kSettled, way / speed, {way, 0.0}));
    s.until = kSettled + way / speed + 2.0;
  } else {
    s.kind = "floor tilts";
    const double seconds = random.between(4.0, 12.0);
    move(s.scene.bodies[0],
         turned({0.0, -0.5}, kSettled, seconds, -random.between(4.0, 25.0) * kDegree));
    s.until = kSettled + seconds + 2.0;
  }
  return s;
}

namespace {

/// The right card of a pair that leans against its mirror image: with a flat foot, and cut off
/// where it meets the other and at the height.
BodyDesc card(const std::string& name, const Vec2& foot, double mirror, double height, double lean,
              double thick) {
  const double across = thick / std::cos(lean), reach = height * std::tan(lean) - 0.5 * across;
  const double slope = std::tan(lean);
  Polygon polygon{{{reach, 0.0},
                   {reach + across, 0.0},
                   {reach + across - height * slope, height},
                   {0.0, height},
                   {0.0, reach / slope}}};
  if (mirror < 0.0) {
    for (Vec2& v : polygon.vertices) v.x() = -v.x();
    std::ranges::reverse(polygon.vertices);
  }
  const Vec2 centre = areaProperties(ConvexShape(polygon)).centroid;
  for (Vec2& v : polygon.vertices) v -= centre;
  BodyDesc body;
  body.name = name;
  body.at = foot + centre;
  body.shapes = {polygon};
  return body;
}

}  // namespace

Structure cardHouse(Random& random) {
  Structure s{.kind = "leaning", .from = kBefore};
  s.scene.bodies.push_back(ground());
  const bool leaning = random.below(3) != 0;
  const double height = random.between(0.8, 1.5), thick = height * random.between(0.05, 0.12);
  const double lean = random.between(14.0, 32.0) * kDegree;
  const double pitch = leaning ? 2.0 * (height * std::tan(lean) + 0.6 * thick / std::cos(lean))
                               : height * random.between(0.6, 1.2);
  const int storeys = count(random, 1, 4);
  const auto put = [&](const BodyDesc& body) {
    s.watched.push_back({.body = s.scene.bodies.size(), .way = 0.1 * height});
    s.scene.bodies.push_back(body);
  };
  double floor = 0.0;
  for (int row = 0; row < storeys; ++row) {
    const int n = storeys - row + (leaning ? 0 : 1);
    for (int i = 0; i < n; ++i) {
      const Vec2 foot(pitch * (i - 0.5 * (n - 1)), floor);
      if (!leaning) {
        put(box(fmt::format("card[{},{}]", row, i), thick, height, foot + Vec2(0.0, 0.5 * height)));
        continue;
      }
      put(card(fmt::format("right[{},{}]", row, i), foot, 1.0, height, lean, thick));
      put(card(fmt::format("left[{},{}]", row, i), foot, -1.0, height, lean, thick));
    }
    floor += height;
    if (leaning && n == 1) break;
    const double length = pitch * (n - 1) + 0.3 * height;
    put(box(fmt::format("ceiling[{}]", row), length, thick, {0.0, floor + 0.5 * thick}));
    floor += thick;
  }
  if (!leaning) s.kind = "upright";
  const double needed = leaning ? std::tan(lean) : 0.5;
  setFriction(s.scene, needed * random.between(0.6, 1.3));
  s.until = 15.0;
  const BodyIndex loaded = 1 + random.below(s.scene.bodies.size() - 1);
  const double towards =
      leaning ? random.between(-0.5, 0.5) : side(random) * random.between(0.05, 1.5);
  pullMoreAndMore(s.scene, random.below(2) == 0 ? loaded : s.scene.bodies.size() - 1, Vec2::Zero(),
                  {std::sin(towards), -std::cos(towards)},
                  massOf(s.scene) * kGravity * random.between(0.02, 0.3), kSettled, s.until);
  return s;
}

Structure disassembly(Random& random) {
  Structure s{.kind = "pulled", .from = kBefore};
  s.scene.bodies.push_back(ground());
  Wall wall = randomWall(random, 3.0, 3.0);
  wall.rows = std::max(wall.rows, 3);
  const std::size_t kind = random.below(3);
  const double speed = random.between(0.02, 0.2), out = side(random);
  if (kind == 2) {  // the right half of the ground sinks
    s.kind = "lowered";
    wall.columns = std::max(wall.columns, 2);
    wall.shift = 0.35 * wall.width;
    BodyDesc sinks = pinnedBox("sinking", 30.0, 1.0, {15.0, -0.5});
    s.scene.bodies.front() = pinnedBox("ground", 30.0, 1.0, {-15.0, -0.5});
    add(s, wall, {random.between(-0.3, 0.3) * wall.breadth(), 0.0});
    const double way = wall.height * random.between(0.2, 3.0);
    move(sinks, shifted(sinks.at, kSettled, 3.0 * way / speed, {0.0, -way}));
    s.scene.bodies.push_back(sinks);
    for (Watch& w : s.watched) w.along = Vec2::UnitX();
    s.until = kSettled + 3.0 * way / speed + 3.0;
    setFriction(s.scene, random.between(0.3, 1.0));
    return s;
  }
  add(s, wall, {0.0, 0.0});
  setFriction(s.scene, random.between(0.2, 0.8));
  const int row = count(random, 0, std::min(2, wall.rows - 2));
  const int column = out < 0.0 ? 0 : wall.columns - 1;
  const auto pulled = static_cast<BodyIndex>(1 + row * wall.columns + column);
  BodyDesc& brick = s.scene.bodies[pulled];
  const double way = 1.2 * wall.width;
  std::erase_if(s.watched, [&](const Watch& w) { return w.body == pulled; });
  s.until = kSettled + way / speed + 3.0;
  if (kind == 0) {
    move(brick, shifted(brick.at, kSettled, way / speed, {out * way, 0.0}));
    return s;
  }
  s.kind = "dragged";
  const double weight = kGravity * massOf(brick) * (wall.rows - row) * 2.0;
  s.until = 15.0;
  pullMoreAndMore(s.scene, pulled, Vec2::Zero(), {out, 0.0}, weight * random.between(0.05, 0.5),
                  kSettled, s.until);
  return s;
}

Structure heavyOnLight(Random& random) {
  Structure s{.kind = "tilted", .from = kBefore};
  s.scene.bodies.push_back(ground());
  Wall wall = randomWall(random, 2.5, 3.0);
  wall.rows = count(random, 1, 3);
  wall.columns = count(random, 2, 4);
  for (double* length : {&wall.width, &wall.height, &wall.shift}) *length *= 4.0;  // rows are soft
  add(s, wall, {0.0, 0.0});
  const double ratio = std::exp(random.between(std::log(20.0), std::log(1000.0)));
  const double breadth = wall.breadth() * random.between(0.5, 1.5);
  const double height = random.between(0.5, 4.0), top = wall.rows * wall.height;
  BodyDesc heavy = box("heavy", breadth, height,
                       {random.between(-0.1, 0.1) * wall.breadth(), top + 0.5 * height});
  heavy.mass = ratio * wall.width * wall.height;
  s.watched.push_back({.body = s.scene.bodies.size(), .way = 0.25 * wall.size()});
  s.scene.bodies.push_back(heavy);
  const double friction = random.between(0.3, 1.0);
  setFriction(s.scene, friction);
  const double most = kGravity * std::min(friction, 0.5 * wall.breadth() / (top + 0.5 * height));
  const double factor = random.between(0.9, 2.0);
  BodyDesc& base = s.scene.bodies.front();
  s.until = 15.0;
  const std::size_t kind = random.below(3);
  if (kind == 0) {
    const double angle = std::min(std::atan(factor * most / kGravity), kTilted * kDegree);
    move(base, turned(base.at, kSettled, random.between(4.0, 11.0), side(random) * angle));
  } else if (kind == 1) {
    s.kind = "pushed";
    pullMoreAndMore(s.scene, s.scene.bodies.size() - 1, {0.0, random.between(-0.5, 0.5) * height},
                    {side(random), 0.0}, *heavy.mass * most * factor / 10.0, kSettled, s.until);
  } else {
    s.kind = "shaken";
    move(base, shaken(base.at, 2.0 * factor * most, random.between(1.0, 3.0), 10.0));
  }
  return s;
}

Structure conveyor(Random& random) {
  Structure s{.kind = "start and stop", .from = kBefore};
  const std::size_t kind = random.below(3);
  Wall wall = randomWall(random, 1.5, 2.5);
  if (kind > 0) wall.rows = std::max(wall.rows, 4);
  const double friction = random.between(0.2, 1.0), speed = random.between(0.5, 3.0);
  s.scene.bodies.push_back(ground());
  BodyDesc& belt = s.scene.bodies.front();
  if (kind == 0) {  // a belt that starts, runs, and stops
    const double start = speed / (wall.carries(friction) * random.between(0.4, 1.6));
    const double stop = speed / (wall.carries(friction) * random.between(0.5, 2.0));
    const double run = random.between(1.0, 4.0);
    // Accelerations that are constant: an eighth of the time between two keys.
    Keyframes path{{{0.0, belt.at, 0.0}}};
    const double whole = start + run + stop;
    const double slice = std::min(start, stop) / 8.0;
    const auto placeAt = [&](double t) {
      const double a = std::clamp(t, 0.0, start), c = std::clamp(t - start - run, 0.0, stop);
      return speed *
             (0.5 * a * a / start + std::clamp(t - start, 0.0, run) + c - 0.5 * c * c / stop);
    };
    for (double t = 0.0; t <= whole; t += slice) {
      path.keys.push_back({kSettled + t, belt.at + Vec2(placeAt(t), 0.0), 0.0});
    }
    path.keys.push_back({kSettled + whole + slice, belt.at + Vec2(placeAt(whole), 0.0), 0.0});
    move(belt, path);
    add(s, wall, {0.0, 0.0});
    s.until = kSettled + whole + 2.0;
    setFriction(s.scene, friction);
    return s;
  }
  // Carried by its surface: first by one belt, then by another, or against a sill.
  belt.at.x() = -30.0;
  belt.surface_velocity = speed;
  const double way = speed * random.between(1.5, 3.0) + 0.5 * wall.breadth() + wall.shift;
  BodyDesc next = ground();
  next.at.x() = 30.0;
  add(s, wall, {-way, 0.0});
  for (std::size_t i = 1; i < s.scene.bodies.size(); ++i) s.scene.bodies[i].velocity = {speed, 0.0};
  if (kind == 1) {
    s.kind = "two belts";
    next.name = "next";
    next.surface_velocity = speed * random.between(-1.0, 3.0);
  } else {
    s.kind = "sill";
    next.name = "sill";
    next.at.y() += std::min(wall.height, wall.rows * wall.height * random.between(0.1, 0.6));
  }
  s.scene.bodies.push_back(next);
  // Seen from the first box, which itself may tip.
  for (Watch& w : s.watched) w.frame = 1;
  s.watched.front() = {.body = 1, .frame = 0, .way = kNever};
  s.from = 1.0;
  s.until = 10.0;
  setFriction(s.scene, friction);
  return s;
}

}  // namespace merge2d::bench
