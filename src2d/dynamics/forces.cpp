#include "src2d/dynamics/forces.h"

#include <algorithm>
#include <iterator>
#include <numbers>

#include "src2d/core/trig.h"
#include "src2d/dynamics/spring_forces.h"

namespace merge2d {
namespace {

/// Force of `force` [N] at world point `at`, about the body's centre of mass.
Load loadAt(const State& state, BodyId body, const Vec2& at, const Vec2& force) {
  return {body, force, cross(at - state.pose(body).position, force)};
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

}  // namespace merge2d
