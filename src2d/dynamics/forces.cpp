#include "src2d/dynamics/forces.h"

#include <algorithm>
#include <numbers>

namespace merge2d {
namespace {

/// Force of `force` [N] at world point `at`, about the body's centre of mass.
Load loadAt(const State& state, BodyId body, const Vec2& at, const Vec2& force) {
  return {body, force, cross(at - state.pose(body).position, force)};
}

Vec2 velocityAt(const State& state, BodyId body, const Vec2& p) {
  return state.rigid(body).velocityAt(p);
}

/// 1/m seen along `direction` at world point `p` of a body, 0 when it does not respond.
double inverseMassAt(const State& state, BodyId id, const Vec2& p, const Vec2& direction) {
  const Body& body = state[id];
  if (!state.rigid(id).floating()) return 0.0;
  const double arm = cross(p - state.pose(id).position, direction);
  return 1.0 / body.mass + arm * arm / body.inertia;
}

/// A spring that is too stiff for an explicit step is given the force of an implicit one. Without
/// this limit it would gain energy until it explodes; below it the spring is undamped.
double stableShare(double h, double stiffness, double damping, double inv_mass) {
  const double gain = (h * damping + h * h * stiffness) * inv_mass;
  return gain <= 1.0 ? 1.0 : 1.0 / (1.0 + gain);
}

struct SpringEnds {
  Vec2 from, to;
};

SpringEnds springEnds(const State& state, const TimedSpring& spring) {
  const BodyId body{static_cast<std::uint32_t>(spring.body)};
  const Vec2 from = state.pose(body) * spring.anchor;
  if (spring.to_body < 0) return {from, spring.to};
  return {from, state.pose(BodyId{static_cast<std::uint32_t>(spring.to_body)}) * spring.to};
}

void addSpring(const State& state, const TimedSpring& spring, Scratch& scratch) {
  const BodyId body{static_cast<std::uint32_t>(spring.body)};
  if (!state[body].alive) return;
  const auto [from, to] = springEnds(state, spring);
  const bool other = spring.to_body >= 0;
  const BodyId to_body{static_cast<std::uint32_t>(other ? spring.to_body : 0)};

  const Vec2 along = to - from;
  const double length = along.norm();
  Vec2 velocity = -velocityAt(state, body, from);
  if (other) velocity += velocityAt(state, to_body, to);
  const Vec2 direction = length > 1e-12 ? Vec2(along / length) : Vec2::Zero();
  double inv_mass = inverseMassAt(state, body, from, direction);
  if (other) inv_mass += inverseMassAt(state, to_body, to, direction);

  // A spring without length damps every motion of its end, a long one only along itself.
  const Vec2 damped = spring.rest_length == 0.0 ? velocity : direction * velocity.dot(direction);
  const Vec2 force =
      stableShare(state.h, spring.stiffness, spring.damping, inv_mass) *
      (spring.stiffness * (length - spring.rest_length) * direction + spring.damping * damped);
  scratch.loads.push_back(loadAt(state, body, from, force));
  if (other) scratch.loads.push_back(loadAt(state, to_body, to, -force));
  scratch.springs.push_back({from, to, force.dot(direction)});
}

double smooth(double s) { return s * s * (3.0 - 2.0 * s); }

ScriptPose poseOf(const Sinusoid& script, const Actions::Scripted& s, double time) {
  const double phase = 2.0 * std::numbers::pi * time / script.period;
  const Vec2 offset = script.axis * (script.amplitude * (1.0 - std::cos(phase)));
  return {s.start.position + onGrid(offset), s.start_angle};
}

ScriptPose poseOf(const Keyframes& script, const Actions::Scripted&, double time) {
  const auto& keys = script.keys;
  if (time <= keys.front().time) return {keys.front().position, keys.front().angle};
  if (time >= keys.back().time) return {keys.back().position, keys.back().angle};
  const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                      [](double t, const Keyframes::Key& k) { return t < k.time; });
  const Keyframes::Key &k1 = *after, &k0 = *(after - 1);
  const double s = smooth((time - k0.time) / (k1.time - k0.time));
  return {k0.position + onGrid(s * (k1.position - k0.position)),
          k0.angle + s * (k1.angle - k0.angle)};
}

ScriptPose poseOf(const SteadyMotion& script, const Actions::Scripted& s, double time) {
  return {s.start.position + onGrid(time * script.velocity), s.start_angle + time * script.spin};
}

}  // namespace

ScriptPose scriptPose(const Actions::Scripted& scripted, double time) {
  return std::visit([&](const auto& script) { return poseOf(script, scripted, time); },
                    scripted.script);
}

void moveScripted(State& state, const Actions& actions) {
  for (const Actions::Scripted& scripted : actions.scripts) {
    Rigid& r = state[rigidOf(scripted.body)];
    const ScriptPose next = scriptPose(scripted, state.time + state.h);
    const Vec2 center = Pose::at(next.position, next.angle) * scripted.center;
    r.v = (center - r.x) / state.h;
    r.omega = (next.angle - r.angle) / state.h;
  }
}

void listLoads(State& state, Actions& actions, Scratch& scratch) {
  scratch.loads.clear();
  scratch.springs.clear();
  for (const TimedSpring& spring : actions.springs) addSpring(state, spring, scratch);
  const double middle = state.time + 0.5 * state.h;
  for (const ForceDesc& f : actions.forces) {
    const BodyId body{static_cast<std::uint32_t>(f.body)};
    if (!state[body].alive) continue;
    const auto acts = [&](double time) { return time >= f.from && time < f.until; };
    if (acts(middle) != acts(middle - state.h)) scratch.stirred.push_back(body);
    if (!acts(middle)) continue;
    scratch.loads.push_back(loadAt(state, body, state.pose(body) * f.at, f.force));
  }
}

void listKicks(State& state, Actions& actions, Scratch& scratch) {
  scratch.kicks.clear();
  const double end = state.time + 0.5 * state.h;
  auto& next = actions.next_impulse;
  for (; next < actions.impulses.size() && actions.impulses[next].time < end; ++next) {
    const ImpulseDesc& i = actions.impulses[next];
    scratch.kicks.push_back({BodyId{static_cast<std::uint32_t>(i.body)}, i.at, i.impulse});
  }
  scratch.kicks.insert(scratch.kicks.end(), actions.user_kicks.begin(), actions.user_kicks.end());
  actions.user_kicks.clear();
}

double springEnergy(const State& state, const Actions& actions) {
  double energy = 0.0;
  for (const TimedSpring& spring : actions.springs) {
    const auto [from, to] = springEnds(state, spring);
    const double stretch = (to - from).norm() - spring.rest_length;
    energy += 0.5 * spring.stiffness * stretch * stretch;
  }
  return energy;
}

}  // namespace merge2d
