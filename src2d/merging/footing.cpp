#include "src2d/merging/footing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src2d/core/trig.h"
#include "src2d/merging/limits.h"
#include "src2d/merging/momentum.h"
#include "src2d/merging/refine.h"
#include "src2d/merging/rigid_parts.h"

namespace merge2d {
namespace {

/// The velocity that the load adds in a step: that of gravity, or of a frame that turns [m/s].
double loadStep(const State& state, const Collection& c) {
  const Rigid& r = state[c.rigid];
  const Aabb& bounds = state.extent(c.rigid).bounds;
  const double radius = r.floating() ? 0.5 * bounds.extent().norm() : bounds.center().norm();
  return state.h * std::max(state.gravity.norm(), r.omega * r.omega * radius);
}

bool hasJoints(const State& state, const Scratch& scratch, const Collection& c) {
  const auto isMember = [&](std::uint32_t b) {
    return b < state.bodies.size() && state.bodies[b].rigid == c.rigid;
  };
  return !c.joints.empty() || std::ranges::any_of(scratch.sweep_joints, [&](const JointBlock& k) {
    return isMember(k.a) || isMember(k.b);
  });
}

/// A collection that keeps swaying under a load is asked, but none that more sweeps look at anyway,
/// and none with joints: they are solved in their own way.
bool isAsked(const State& state, const Scratch& scratch, const Collection& c, double load) {
  constexpr std::size_t kFewest = 6;  // members: sweeps through fewer are done in time
  constexpr double kSways = 0.02;     // of loadStep()
  if (c.stale || c.members.size() < kFewest) return false;
  if (scratch.disturbed[index(c.rigid) - state.bodies.size()]) return false;
  const double enough = std::max(kSways * load, residualVelocity(state));
  return sway(state, scratch, c) > enough && !hasJoints(state, scratch, c);
}

/// The place of the heaviest member, on which all others may stand.
std::uint32_t heaviestOf(const State& state, const Collection& c) {
  const auto mass = [&](BodyId b) { return state[b].mass; };
  return static_cast<std::uint32_t>(std::ranges::max_element(c.members, {}, mass) -
                                    c.members.begin());
}

/// By two points that are not at their limits.
bool holdsFirmly(const Collection& c, const Weld& weld) {
  int inside = 0;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const ContactBlock& k = c.blocks[c.contacts[i].block];
    for (int p = 0; p < k.count; ++p) inside += !broken(k, p) && !onEdge(k, p) ? 1 : 0;
  }
  return inside > 1;
}

/// Asks with one choice of parts. True when some of it gives.
template <class Joins>
bool gives(const State& state, Scratch& scratch, const Collection& c, const Joins& joins,
           Footing& footing) {
  constexpr double kTakesPart = 0.1;  // of the fastest motion
  if (!formParts(state, scratch, c, joins)) return false;
  footing.speed = settleParts(state, scratch, c, footing.enough);
  if (footing.speed <= footing.enough) return false;
  footing.giving = weldsFasterThan(state, scratch, c, kTakesPart * footing.speed);
  return true;
}

/// The direction in which the load pulls on members, in the collection's frame [rad]. Where the
/// frame turns, the load differs from place to place, so that a collection that has borne it is
/// still asked at times.
double loadDirection(const State& state, const Collection& c) {
  const Vec2 gain = state.h * state.gravity - c.frame_gain;
  const Vec2 load = state[c.rigid].rotation.inverse() * gain;
  return arcTangent(load.y(), load.x());
}

/// The same direction, as near to those of the range as whole turns bring it.
double unwound(const LoadRange& range, double direction) {
  const double middle = range.empty() ? direction : 0.5 * (range.from + range.to);
  return middle + std::remainder(direction - middle, 2.0 * std::numbers::pi);
}

/// Whether it was found often enough that it stands under such a load, since something was new.
bool hasBorne(const LoadRange& range, double direction) {
  constexpr int kSure = 4;  // times: inner forces may still be on their way
  const double d = unwound(range, direction);
  return range.times >= kSure && range.from <= d && d <= range.to;
}

void extend(LoadRange& range, double direction) {
  constexpr double kWidest = 1.0;  // rad: wider ones are of something that turns
  const auto d = static_cast<float>(unwound(range, direction));
  const float from = std::min(range.from, d), to = std::max(range.to, d);
  const bool anew = range.empty() || to - from > kWidest;
  range = {anew ? d : from, anew ? d : to, range.times + 1};
}

}  // namespace

Footing footingOf(const State& state, Scratch& scratch, Collection& c) {
  constexpr std::int64_t kOften = 8, kSeldom = 32;  // steps
  constexpr std::int64_t kBorne = 8;                // times as seldom
  constexpr double kStands = 5e-3;                  // of loadStep()
  if (scratch.disturbed[index(c.rigid) - state.bodies.size()]) c.borne = {};
  const bool floating = state[c.rigid].floating(), seldom = state.step % kSeldom == 0;
  const std::int64_t interval = floating ? kSeldom : kOften;
  if (state.step % interval != 0) return {};
  const double load = loadStep(state, c), direction = loadDirection(state, c);
  if (state.step % (kBorne * interval) != 0 && hasBorne(c.borne, direction)) return {};
  if (!isAsked(state, scratch, c, load)) return {};
  Footing footing{.giving = {}, .enough = std::max(kStands * load, residualVelocity(state))};
  const std::uint32_t host = floating ? heaviestOf(state, c) : ~0u;
  const auto besideHost = [&](const Weld& weld) {
    return weld.node_a != host && weld.node_b != host;
  };
  const auto firmly = [&](const Weld& weld) { return holdsFirmly(c, weld); };
  if (gives(state, scratch, c, besideHost, footing)) return footing;
  if (seldom && gives(state, scratch, c, firmly, footing)) return footing;  // more take longer
  extend(c.borne, direction);
  return footing;
}

}  // namespace merge2d
