#include "src2d/dynamics/forces.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <optional>

#include "src2d/core/trig.h"

namespace merge2d {
namespace {

/// Force of `force` [N] at world point `at`, about the body's centre of mass.
Load loadAt(const State& state, BodyId body, const Vec2& at, const Vec2& force) {
  return {body, force, cross(at - state.pose(body).position, force)};
}

Vec2 velocityAt(const State& state, BodyId body, const Vec2& p) {
  return state.rigid(body).velocityAt(p);
}

/// 1/m seen along `direction` at a place `arm` from the centre of mass of a body, 0 when it does
/// not respond; with no direction the largest of all.
double inverseMassAt(const State& state, BodyId id, const Vec2& arm,
                     const std::optional<Vec2>& direction) {
  const Body& body = state[id];
  if (!state.responds(id)) return 0.0;
  const double lever = direction ? cross(arm, *direction) : arm.norm();
  return 1.0 / body.mass + lever * lever / body.inertia;
}

SpringEnd endOf(const State& state, BodyId body, const Vec2& anchor) {
  const Pose pose = state.pose(body);
  const Vec2 at = pose * anchor;
  return {body, at, at - pose.position};
}

SpringStretch stretchOf(const State& state, const TimedSpring& spring) {
  SpringStretch s;
  s.from = endOf(state, BodyId{static_cast<std::uint32_t>(spring.body)}, spring.anchor);
  s.other = spring.to_body >= 0;
  if (s.other) {
    s.to = endOf(state, BodyId{static_cast<std::uint32_t>(spring.to_body)}, spring.to);
  } else {
    s.to.at = spring.to;
  }
  const Vec2 along = s.to.at - s.from.at;
  s.length = along.norm();
  if (s.length > 1e-12) s.direction = along / s.length;
  return s;
}

/// The change of the velocity of each end by an explicit step of a spring, relative to that
/// velocity, summed per body. A spring without length acts in any direction.
void addGains(const State& state, const TimedSpring& spring, const SpringStretch& s,
              std::vector<double>& gain) {
  std::optional<Vec2> direction;
  if (spring.rest_length != 0.0) direction = s.direction;
  const double strength = state.h * spring.damping + state.h * state.h * spring.stiffness;
  const auto add = [&](const SpringEnd& end) {
    gain[index(end.body)] += strength * inverseMassAt(state, end.body, end.arm, direction);
  };
  add(s.from);
  if (s.other) add(s.to);
}

/// Springs that are together too stiff for an explicit step are given the force of an implicit one.
/// Without this limit they would gain energy until they explode; below it a spring is left as it
/// is.
double stableShare(const SpringStretch& s, const std::vector<double>& gain) {
  const double all = gain[index(s.from.body)] + (s.other ? gain[index(s.to.body)] : 0.0);
  return all <= 1.0 ? 1.0 : 1.0 / (1.0 + all);
}

void addSpring(const State& state, const TimedSpring& spring, std::uint32_t number,
               const SpringStretch& s, Scratch& scratch) {
  Vec2 velocity = -velocityAt(state, s.from.body, s.from.at);
  if (s.other) velocity += velocityAt(state, s.to.body, s.to.at);
  // A spring without length damps every motion of its end, a long one only along itself.
  const Vec2 damped =
      spring.rest_length == 0.0 ? velocity : s.direction * velocity.dot(s.direction);
  const Vec2 force =
      stableShare(s, scratch.spring_gain) *
      (spring.stiffness * (s.length - spring.rest_length) * s.direction + spring.damping * damped);
  scratch.loads.push_back({s.from.body, force, cross(s.from.arm, force)});
  if (s.other) scratch.loads.push_back({s.to.body, -force, cross(s.to.arm, -force)});
  scratch.springs.push_back({.number = number,
                             .body = s.from.body,
                             .other = s.other ? s.to.body : BodyId{},
                             .to_world = !s.other,
                             .from = s.from.at,
                             .to = s.to.at,
                             .force = force.dot(s.direction)});
}

bool acts(const State& state, const TimedSpring& spring) {
  return !spring.removed && state.bodies[spring.body].alive;
}

/// Where the ends of a spring are takes longer than all else about it, above all in collections.
void addSprings(const State& state, const Actions& actions, Scratch& scratch) {
  if (actions.springs.empty()) return;
  auto& gain = scratch.spring_gain;
  gain.resize(state.bodies.size(), 0.0);
  for (const TimedSpring& spring : actions.springs) {
    gain[spring.body] = 0.0;
    if (spring.to_body >= 0) gain[static_cast<std::size_t>(spring.to_body)] = 0.0;
  }
  scratch.stretches.clear();
  for (const TimedSpring& spring : actions.springs) {
    if (!acts(state, spring)) continue;
    scratch.stretches.push_back(stretchOf(state, spring));
    addGains(state, spring, scratch.stretches.back(), gain);
  }
  auto stretch = scratch.stretches.begin();
  for (std::uint32_t i = 0; i < actions.springs.size(); ++i) {
    if (!acts(state, actions.springs[i])) continue;
    addSpring(state, actions.springs[i], i, *stretch++, scratch);
  }
}

/// Forces of the user act in one step: they begin and end there.
void addUserLoads(Actions& actions, Scratch& scratch) {
  std::vector<BodyId> loaded;
  for (const Load& load : actions.user_loads) {
    loaded.push_back(load.body);
    scratch.loads.push_back(load);
  }
  std::ranges::sort(loaded);
  loaded.erase(std::unique(loaded.begin(), loaded.end()), loaded.end());
  std::ranges::set_symmetric_difference(loaded, actions.loaded,
                                        std::back_inserter(scratch.stirred));
  actions.loaded = std::move(loaded);
  actions.user_loads.clear();
}

/// Timed forces are over once they did not act in the last step either. Time goes on, but for a
/// step of another length and a state that is restored; both begin a new timetable.
void addTimedForces(const State& state, Actions& actions, Scratch& scratch) {
  const double middle = state.time + 0.5 * state.h, before = middle - state.h;
  const auto& forces = actions.forces;
  auto& [launches, schedule, acting] = actions.timetable;
  const std::vector<std::uint32_t> begun = schedule.begun(
      forces.size(), [&](std::uint32_t i) { return forces[i].from; },
      [&](double time) { return time <= middle; });
  if (!begun.empty()) {
    acting.insert(acting.end(), begun.begin(), begun.end());
    std::ranges::sort(acting);
  }
  std::erase_if(acting, [&](std::uint32_t i) { return forces[i].until <= before; });
  for (const std::uint32_t i : acting) {
    const ForceDesc& f = forces[i];
    const BodyId body{static_cast<std::uint32_t>(f.body)};
    if (!state[body].alive) continue;
    const auto acts = [&](double time) { return time >= f.from && time < f.until; };
    if (acts(middle) != acts(before)) scratch.stirred.push_back(body);
    if (!acts(middle)) continue;
    scratch.loads.push_back(loadAt(state, body, state.pose(body) * f.at, f.force));
  }
}

double smooth(double s) { return s * s * (3.0 - 2.0 * s); }

ScriptPose poseOf(const Sinusoid& script, const Actions::Scripted& s, double time) {
  const double phase = 2.0 * std::numbers::pi * time / script.period;
  const Vec2 offset = script.axis * (script.amplitude * (1.0 - sineCosine(phase).c));
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

void moveScripted(State& state, const Actions& actions, Scratch& scratch) {
  scratch.started.clear();
  for (const Actions::Scripted& scripted : actions.scripts) {
    Rigid& r = state[rigidOf(scripted.body)];
    const bool stood = r.still();
    const ScriptPose next = scriptPose(scripted, state.time + state.h);
    const Vec2 center = Pose::at(next.position, next.angle) * scripted.center;
    r.v = (center - r.x) / state.h;
    r.omega = (next.angle - r.angle) / state.h;
    if (stood && !r.still()) scratch.started.push_back(scripted.body);
  }
}

void listLoads(State& state, Actions& actions, Scratch& scratch) {
  scratch.loads.clear();
  scratch.springs.clear();
  addSprings(state, actions, scratch);
  addTimedForces(state, actions, scratch);
  addUserLoads(actions, scratch);
}

void listKicks(State& state, Actions& actions, Scratch& scratch) {
  scratch.kicks.clear();
  const double end = state.time + 0.5 * state.h;
  auto& next = actions.next_impulse;
  for (; next < actions.impulses.size() && actions.impulses[next].time < end; ++next) {
    const ImpulseDesc& i = actions.impulses[next];
    const BodyId body{static_cast<std::uint32_t>(i.body)};
    if (state[body].alive) scratch.kicks.push_back({body, i.at, i.impulse});
  }
  scratch.kicks.insert(scratch.kicks.end(), actions.user_kicks.begin(), actions.user_kicks.end());
  actions.user_kicks.clear();
}

double springEnergy(const State& state, const Actions& actions) {
  double energy = 0.0;
  for (const TimedSpring& spring : actions.springs) {
    if (spring.removed) continue;
    const double stretch = stretchOf(state, spring).length - spring.rest_length;
    energy += 0.5 * spring.stiffness * stretch * stretch;
  }
  return energy;
}

}  // namespace merge2d
