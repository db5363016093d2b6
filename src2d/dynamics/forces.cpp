#include "src2d/dynamics/forces.h"

#include <algorithm>
#include <numbers>
#include <optional>

namespace merge2d {
namespace {

/// Force of `force` [N] at world point `at`, about the body's centre of mass.
Load loadAt(const State& state, BodyId body, const Vec2& at, const Vec2& force) {
  return {body, force, cross(at - state.pose(body).position, force)};
}

Vec2 velocityAt(const State& state, BodyId body, const Vec2& p) {
  return state.rigid(body).velocityAt(p);
}

/// 1/m seen along `direction` at world point `p` of a body, 0 when it does not respond; with no
/// direction the largest of all.
double inverseMassAt(const State& state, BodyId id, const Vec2& p,
                     const std::optional<Vec2>& direction) {
  const Body& body = state[id];
  if (!state.responds(id)) return 0.0;
  const Vec2 from_center = p - state.pose(id).position;
  const double arm = direction ? cross(from_center, *direction) : from_center.norm();
  return 1.0 / body.mass + arm * arm / body.inertia;
}

/// A spring as it is now.
struct Stretch {
  BodyId body{}, to_body{};
  bool other = false;  ///< to_body counts
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  double length = 0.0;
  Vec2 direction = Vec2::Zero();
};

Stretch stretchOf(const State& state, const TimedSpring& spring) {
  Stretch s;
  s.body = BodyId{static_cast<std::uint32_t>(spring.body)};
  s.other = spring.to_body >= 0;
  if (s.other) s.to_body = BodyId{static_cast<std::uint32_t>(spring.to_body)};
  s.from = state.pose(s.body) * spring.anchor;
  s.to = s.other ? state.pose(s.to_body) * spring.to : spring.to;
  const Vec2 along = s.to - s.from;
  s.length = along.norm();
  if (s.length > 1e-12) s.direction = along / s.length;
  return s;
}

/// What an explicit step of a spring does to the velocity of each of its ends, relative to that
/// velocity, summed per body. A spring without length acts in any direction.
void addGains(const State& state, const TimedSpring& spring, std::vector<double>& gain) {
  if (!state.bodies[spring.body].alive) return;
  const Stretch s = stretchOf(state, spring);
  std::optional<Vec2> direction;
  if (spring.rest_length != 0.0) direction = s.direction;
  const double strength = state.h * spring.damping + state.h * state.h * spring.stiffness;
  gain[index(s.body)] += strength * inverseMassAt(state, s.body, s.from, direction);
  if (s.other)
    gain[index(s.to_body)] += strength * inverseMassAt(state, s.to_body, s.to, direction);
}

/// Springs that are together too stiff for an explicit step are given the force of an implicit one.
/// Without this limit they would gain energy until they explode; below it a spring is left as it
/// is.
double stableShare(const Stretch& s, const std::vector<double>& gain) {
  const double all = gain[index(s.body)] + (s.other ? gain[index(s.to_body)] : 0.0);
  return all <= 1.0 ? 1.0 : 1.0 / (1.0 + all);
}

void addSpring(const State& state, const TimedSpring& spring, Scratch& scratch) {
  if (!state.bodies[spring.body].alive) return;
  const Stretch s = stretchOf(state, spring);
  Vec2 velocity = -velocityAt(state, s.body, s.from);
  if (s.other) velocity += velocityAt(state, s.to_body, s.to);
  // A spring without length damps every motion of its end, a long one only along itself.
  const Vec2 damped =
      spring.rest_length == 0.0 ? velocity : s.direction * velocity.dot(s.direction);
  const Vec2 force =
      stableShare(s, scratch.spring_gain) *
      (spring.stiffness * (s.length - spring.rest_length) * s.direction + spring.damping * damped);
  scratch.loads.push_back(loadAt(state, s.body, s.from, force));
  if (s.other) scratch.loads.push_back(loadAt(state, s.to_body, s.to, -force));
  scratch.springs.push_back({s.from, s.to, force.dot(s.direction)});
}

void addSprings(const State& state, const Actions& actions, Scratch& scratch) {
  if (actions.springs.empty()) return;
  scratch.spring_gain.assign(state.bodies.size(), 0.0);
  for (const TimedSpring& spring : actions.springs) addGains(state, spring, scratch.spring_gain);
  for (const TimedSpring& spring : actions.springs) addSpring(state, spring, scratch);
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
  addSprings(state, actions, scratch);
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
    const double stretch = stretchOf(state, spring).length - spring.rest_length;
    energy += 0.5 * spring.stiffness * stretch * stretch;
  }
  return energy;
}

}  // namespace merge2d
