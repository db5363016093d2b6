#pragma once
/// What carries the first body of a random scene, a seat of 3 m by 0.2 m at the origin.

#include <array>
#include <cmath>

#include "bench/random_scene.h"

namespace merge2d::bench {

/// Hangs on two rods and swings without turning.
inline void hang(Scene& scene, Random& random) {
  const double length = random.between(3.0, 6.0), angle = random.between(15.0, 45.0) * kDegree;
  scene.bodies[0].velocity = {std::sqrt(2.0 * 9.81 * length * (1.0 - std::cos(angle))), 0.0};
  for (const double x : {-1.4, 1.4}) {
    JointDesc rod;
    rod.kind = JointKind::Distance;
    rod.at = {x, 0.0};
    rod.to = {x, length};
    scene.joints.push_back(rod);
  }
}

/// Held by four springs, and swings sideways or up and down.
inline void spring(Scene& scene, Random& random) {
  const double mass = *scene.bodies[0].mass, speed = random.between(0.5, 4.0);
  const double turn = oneOf(random, std::array{0.0, 0.3});
  scene.bodies[0].velocity = {speed, turn * speed};
  for (const double x : {-1.4, 1.4}) {
    addSpring(scene, {x, 0.0}, {x, 4.0}, 5.0 * mass, 0.0);
    addSpring(scene, {x, 0.0}, {4.0 * x, 0.0}, random.between(2.0, 8.0) * mass, 0.0);
  }
}

/// Turns about a hinge on the world at its left end, held up by a spring at the other.
inline void hinge(Scene& scene, Random& random) {
  const double mass = *scene.bodies[0].mass;
  JointDesc pin;
  pin.kind = JointKind::Revolute;
  pin.at = {-1.4, 0.0};
  scene.joints.push_back(pin);
  addSpring(scene, {1.4, 0.0}, {1.4, 3.0}, random.between(1.0, 2.5) * mass, 0.1 * mass);
}

/// Rolls without friction on the ground, pulled by a force.
inline void pull(Scene& scene, Random& random) {
  const double mass = *scene.bodies[0].mass;
  JointDesc rail;
  rail.kind = JointKind::Prismatic;
  rail.axis = Vec2::UnitX();
  scene.joints.push_back(rail);
  ForceDesc force;
  force.force = {random.between(2.0, 9.0) * mass, 0.0};
  force.from = 1.0;
  scene.forces.push_back(force);
}

inline constexpr std::array kMounts{hang, spring, hinge, pull};

}  // namespace merge2d::bench
