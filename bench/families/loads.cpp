#include "bench/families/loads.h"

#include <algorithm>
#include <cmath>

namespace merge2d::bench {
namespace {

constexpr double kAtRest = 1000.0;  // the end of scripts [s]

}  // namespace

void move(BodyDesc& body, const Script& script) {
  body.motion = Motion::Scripted;
  body.script = script;
}

Script shifted(const Vec2& at, double from, double seconds, const Vec2& way) {
  return Keyframes{
      {{0.0, at, 0.0}, {from, at, 0.0}, {from + seconds, at + way, 0.0}, {kAtRest, at + way, 0.0}}};
}

Script turned(const Vec2& at, double from, double seconds, double angle) {
  return Keyframes{
      {{0.0, at, 0.0}, {from, at, 0.0}, {from + seconds, at, angle}, {kAtRest, at, angle}}};
}

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

}  // namespace merge2d::bench
