#include "src2d/merging/footing.h"

#include <algorithm>

#include "src2d/merging/limits.h"
#include "src2d/merging/momentum.h"
#include "src2d/merging/rigid_parts.h"

namespace merge2d {
namespace {

/// What the load adds to a velocity in a step: that of gravity, or of a frame that turns [m/s].
double loadStep(const State& state, const Collection& c) {
  const Rigid& r = state[c.rigid];
  const Aabb& bounds = state.extent(c.rigid).bounds;
  const double radius = r.floating() ? 0.5 * bounds.extent().norm() : bounds.center().norm();
  return state.h * std::max(state.gravity.norm(), r.omega * r.omega * radius);
}

/// The fastest of the members against the collection [m/s].
double sway(const State& state, const Scratch& scratch, const Collection& c) {
  const auto velocityOf = [&](BodyId b) -> const SolverVelocity& {
    return scratch.sweep_u[index(b)];
  };
  const VelocityField field = fieldOf(state, c, velocityOf);
  const Pose frame = state[c.rigid].frame();
  double fastest = 0.0;
  for (const BodyId b : c.members) {
    const SolverVelocity& u = velocityOf(b);
    const Vec2 v = field.at(frame * state[b].local);
    fastest = std::max(fastest, (Vec2(u.vx, u.vy) - v).squaredNorm());
  }
  return std::sqrt(fastest);
}

/// Whether a joint holds it in a way that its contacts do not tell.
bool hangsOnJoints(const State& state, const Scratch& scratch, const Collection& c) {
  const auto frame = static_cast<std::uint32_t>(c.members.size());
  const bool to_frame =
      std::any_of(c.weld_of.begin() + c.weld_at[frame], c.weld_of.begin() + c.weld_at[frame + 1],
                  [&](std::uint32_t weld) { return c.welds[weld].joints > 0; });
  const auto isMember = [&](std::uint32_t b) {
    return b < state.bodies.size() && state.bodies[b].rigid == c.rigid;
  };
  return to_frame || std::ranges::any_of(scratch.sweep_joints, [&](const JointBlock& k) {
           return isMember(k.a) || isMember(k.b);
         });
}

/// Of what a load keeps swaying, and of nothing that more sweeps look at anyway.
bool isAsked(const State& state, const Scratch& scratch, const Collection& c, double load) {
  constexpr std::int64_t kEvery = 8;  // steps
  constexpr std::size_t kHigh = 3;    // members
  constexpr double kSways = 0.02;     // of what the load adds in a step
  if (load == 0.0 || c.members.size() < kHigh || state.step % kEvery != 0) return false;
  if (scratch.disturbed[index(c.rigid) - state.bodies.size()]) return false;
  return sway(state, scratch, c) > kSways * load && !hangsOnJoints(state, scratch, c);
}

/// The place among the members of what all others may stand on.
std::uint32_t heaviestOf(const State& state, const Collection& c) {
  const auto mass = [&](BodyId b) { return state[b].mass; };
  return static_cast<std::uint32_t>(std::ranges::max_element(c.members, {}, mass) -
                                    c.members.begin());
}

template <class Visit>
void forEachPoint(const Collection& c, const Weld& weld, Visit&& visit) {
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const ContactBlock& k = c.blocks[c.contact_block[i]];
    for (int p = 0; p < k.count; ++p) visit(k, p);
  }
}

/// What makes a point hold firmly.
struct Firmness {
  double pressure;  ///< it bears more than this part of its weld's
  double friction;  ///< and less than this part of what its own allows
};
/// Those that are not at their limits, and those that are far from them, as the sweep may lag.
constexpr Firmness kFirm{0.0, kWeldOnEdge}, kFirmer{0.25, 0.8};

/// By two points, or by joints.
bool joinsFirmly(const Collection& c, const Weld& weld, const Firmness& firm) {
  double pressure = 0.0;
  int held = 0;
  forEachPoint(c, weld, [&](const ContactBlock& k, int i) { pressure += k.lambda_n(i); });
  forEachPoint(c, weld, [&](const ContactBlock& k, int i) {
    const bool presses = k.lambda_n(i) > firm.pressure * pressure;
    const bool sticks = std::abs(k.lambda_t(i)) < firm.friction * k.mu * k.lambda_n(i);
    held += k.bilateral || (presses && sticks) ? 1 : 0;
  });
  return weld.joints > 0 || held > 1;
}

/// Asks with one choice of parts. False when another need not be tried.
bool holds(const State& state, Scratch& scratch, const Collection& c, const Joins& joins,
           Footing& footing) {
  constexpr double kTakesPart = 0.1;  // of the fastest motion
  if (!formParts(state, scratch, c, joins)) return true;
  footing.speed = settleParts(state, scratch, c, footing.enough);
  if (footing.speed <= footing.enough) return true;
  footing.giving = weldsFasterThan(state, scratch.rigid_parts, c, kTakesPart * footing.speed);
  return false;
}

}  // namespace

Footing footingOf(const State& state, Scratch& scratch, const Collection& c) {
  constexpr double kStands = 5e-3;  // of what the load adds in a step
  const double load = loadStep(state, c);
  Footing footing{.giving = {}, .enough = kStands * load};
  if (!isAsked(state, scratch, c, load)) return footing;
  const std::uint32_t host = state[c.rigid].floating() ? heaviestOf(state, c) : ~0u;
  const auto besideHost = [&](const Weld& weld) {
    return weld.joints > 0 || (weld.node_a != host && weld.node_b != host);
  };
  bool stays = holds(state, scratch, c, besideHost, footing);
  for (const Firmness& firm : {kFirm, kFirmer}) {
    const auto firmly = [&](const Weld& weld) { return joinsFirmly(c, weld, firm); };
    stays = stays && holds(state, scratch, c, firmly, footing);
  }
  return footing;
}

}  // namespace merge2d
