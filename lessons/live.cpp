#include "lessons/live.h"

#include <algorithm>

namespace merge2d {
namespace {

/// How fast the spring of a hand would swing on its own [rad/s].
constexpr double kSwing = 12.0;
/// No hand pulls harder than so many times the body's weight, so that it tears without exploding.
constexpr double kStrongest = 60.0;

const BodyState* find(const Snapshot& seen, BodyId id) {
  const auto at = std::ranges::lower_bound(seen.bodies, id, {}, &BodyState::id);
  return at != seen.bodies.end() && at->id == id ? &*at : nullptr;
}

}  // namespace

Live::Live(const Scene& scene, Mode mode) : recorder_(scene, mode) {}

Vec2 Live::force(BodyId body) const {
  const auto held = drags_.find(body);
  if (held == drags_.end()) return Vec2::Zero();
  const Snapshot seen = world().capture();
  const BodyState* b = find(seen, body);
  if (b == nullptr || b->pinned) return Vec2::Zero();
  const double mass = world().bodies()[index(body)].mass, h = world().timeStep();
  const Vec2 arm = b->pose().rotation * held->second.grip;
  const Vec2 velocity = b->v + cross(b->omega, arm);
  // Implicit in the spring and its damper: stable for every step.
  const double stiffness = mass * kSwing * kSwing, damping = 2.0 * mass * kSwing;
  const double softened = mass / (mass + h * damping + h * h * stiffness);
  const Vec2 wanted = stiffness * (held->second.target - b->x - arm) - damping * velocity;
  const Vec2 out = softened * wanted;
  const double most = kStrongest * mass * std::max(1.0, world().scene().gravity.norm());
  return out.norm() > most ? Vec2(out * (most / out.norm())) : out;
}

void Live::letGo(BodyId body) {
  if (drags_.erase(body) > 0) world().wake(body);
}

void Live::pull() {
  for (const auto& [body, held] : drags_) {
    const Vec2 pull = force(body);
    if (pull.isZero()) continue;
    const Snapshot seen = world().capture();
    const Vec2 grip = find(seen, body)->pose() * held.grip;
    world().applyImpulse(body, grip, world().timeStep() * pull);
  }
}

void Live::skip() {
  pull();
  recorder_.skip();
  choose(world().capture());
}

void Live::skipTo(std::int64_t step) {
  while (world().steps() < step) skip();
}

StepRecord Live::step() {
  pull();
  StepRecord record = recorder_.record();
  choose(record.after);
  return record;
}

Live::Saved Live::save() const {
  const World& w = world();
  return {.bytes = w.save(),
          .settings = w.settings(),
          .gravity = w.gravity(),
          .h = w.timeStep(),
          .mode = w.mode(),
          .drags = drags_,
          .chosen = chosen_,
          .slots = slots_};
}

void Live::restore(const Saved& saved) {
  World& w = world();
  w.setMode(saved.mode);
  w.setSettings(saved.settings);
  w.setGravity(saved.gravity);
  w.setTimeStep(saved.h);
  w.restore(saved.bytes, "a saved state", SavedUnder::AnySettings);
  drags_ = saved.drags;
  chosen_ = saved.chosen;
  slots_ = saved.slots;
}

}  // namespace merge2d
