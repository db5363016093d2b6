#include <algorithm>
#include <cmath>

#include "bench/families/family_list.h"
#include "bench/families/loads.h"
#include "bench/families/walls.h"

namespace merge2d::bench {
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

}  // namespace merge2d::bench
