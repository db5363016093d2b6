#include "src2d/merging/footing.h"

#include <algorithm>
#include <vector>

#include "src2d/merging/collection.h"
#include "src2d/merging/metric.h"

namespace merge2d {
namespace {

/// What the load adds to a velocity in a step: that of gravity, or of a frame that turns [m/s].
double loadStep(const State& state, const Collection& c) {
  const Rigid& r = state[c.rigid];
  const Aabb& bounds = state.extent(c.rigid).bounds;
  const double turning = r.omega * r.omega * bounds.center().norm();
  return state.h * std::max(state.gravity.norm(), turning);
}

/// The fastest of the members against the collection [m/s].
double sway(const State& state, const Scratch& scratch, const Collection& c) {
  const Rigid& r = state[c.rigid];
  double fastest = 0.0;
  for (const BodyId b : c.members) {
    const SolverVelocity& u = scratch.sweep_u[index(b)];
    const Vec2 v = r.velocityAt(r.frame() * state[b].local);
    fastest = std::max(fastest, (Vec2(u.vx, u.vy) - v).squaredNorm());
  }
  return std::sqrt(fastest);
}

/// All members as one body, with the momentum that the sweep has left them.
struct Whole {
  Vec2 x = Vec2::Zero();  ///< its centre of mass
  SolverVelocity u;
};

Whole wholeOf(const State& state, const Scratch& scratch, const Collection& c) {
  const Pose frame = state[c.rigid].frame();
  Whole whole;
  double mass = 0.0, inertia = 0.0, l = 0.0;
  Vec2 p = Vec2::Zero();
  for (const BodyId b : c.members) {
    const SolverVelocity& u = scratch.sweep_u[index(b)];
    mass += state[b].mass;
    whole.x += state[b].mass * (frame * state[b].local);
    p += state[b].mass * Vec2(u.vx, u.vy);
  }
  whole.x /= mass;
  for (const BodyId b : c.members) {
    const SolverVelocity& u = scratch.sweep_u[index(b)];
    const Vec2 arm = frame * state[b].local - whole.x;
    inertia += state[b].inertia + state[b].mass * arm.squaredNorm();
    l += state[b].inertia * u.omega + state[b].mass * cross(arm, Vec2(u.vx, u.vy));
  }
  whole.u = {p.x() / mass, p.y() / mass, l / inertia, 1.0 / mass, 1.0 / inertia};
  return whole;
}

/// One of its contacts with a body of the frame, acting on the whole.
Foot makeFoot(const State& state, const Collection& c, const Whole& whole,
              const ContactBlock& inner, const InternalContact& contact) {
  const Pose frame = state[c.rigid].frame();
  const bool first = state[contact.key.a].rigid == c.rigid;
  const BodyId ground = first ? contact.key.b : contact.key.a;
  const Vec2 x_ground = state.pose(ground).position;
  BlockGeometry g;
  g.normal = frame.rotation * Vec2(inner.nx, inner.ny);
  g.count = inner.count;
  for (int i = 0; i < inner.count; ++i) {
    const Vec2 at = frame * contact.point(i).position;
    g.arm_a[i] = at - (first ? whole.x : x_ground);
    g.arm_b[i] = at - (first ? x_ground : whole.x);
  }
  Foot foot{{}, ground, first};
  foot.block.mu = inner.mu;
  foot.block.bilateral = inner.bilateral;
  foot.block.lambda = inner.lambda;
  std::ranges::copy(inner.bias, foot.block.bias);
  const SolverVelocity still;
  prepareBlock(foot.block, g, first ? whole.u : still, first ? still : whole.u);
  return foot;
}

void listFeet(const State& state, const Collection& c, const Whole& whole,
              std::vector<Foot>& feet) {
  feet.clear();
  const auto frame = static_cast<std::uint32_t>(c.members.size());
  for (std::uint32_t k = c.weld_at[frame]; k < c.weld_at[frame + 1]; ++k) {
    const Weld& weld = c.welds[c.weld_of[k]];
    for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
      feet.push_back(makeFoot(state, c, whole, c.blocks[c.contact_block[i]], c.contacts[i]));
    }
  }
}

/// One sweep of projected Gauss-Seidel over the feet.
void sweep(Whole& whole, Scratch& scratch) {
  for (Foot& foot : scratch.feet) {
    SolverVelocity ground = scratch.sweep_u[index(foot.ground)];
    ContactBlock& k = foot.block;
    if (foot.first) {
      solveBlock(k, k.nx, k.ny, whole.u, ground);
    } else {
      solveBlock(k, k.nx, k.ny, ground, whole.u);
    }
  }
}

/// Of the farthest corner of the collection's box against the frame; what is fixed to one frame
/// moves as one.
double speedOf(const Whole& whole, const State& state, const Scratch& scratch,
               const Collection& c) {
  const BodyId ground = scratch.feet.front().ground;
  const SolverVelocity& u = scratch.sweep_u[index(ground)];
  const Pose frame = state[c.rigid].frame();
  const Aabb& bounds = state.extent(c.rigid).bounds;
  const OrientedBox box{frame * Pose{bounds.center(), {}}, 0.5 * bounds.extent()};
  return fastestCorner(box, {whole.x, {whole.u.vx, whole.u.vy}, whole.u.omega},
                       {state.pose(ground).position, {u.vx, u.vy}, u.omega});
}

bool hasJointsToFrame(const Collection& c) {
  const auto frame = static_cast<std::uint32_t>(c.members.size());
  return std::any_of(c.weld_of.begin() + c.weld_at[frame], c.weld_of.begin() + c.weld_at[frame + 1],
                     [&](std::uint32_t weld) { return c.welds[weld].joints > 0; });
}

}  // namespace

Footing footingOf(const State& state, Scratch& scratch, const Collection& c) {
  constexpr std::int64_t kEvery = 8;               // steps
  constexpr std::size_t kHigh = 6;                 // members: sweeps through fewer are done in time
  constexpr double kSways = 0.02, kStands = 5e-3;  // of what the load adds in a step
  constexpr int kMost = 2000;                      // sweeps
  Footing footing{.enough = kStands * loadStep(state, c)};
  if (state[c.rigid].floating() || c.members.size() < kHigh || state.step % kEvery != 0) {
    return footing;
  }
  if (scratch.disturbed[index(c.rigid) - state.bodies.size()] || hasJointsToFrame(c))
    return footing;
  if (sway(state, scratch, c) <= kSways * loadStep(state, c)) return footing;
  Whole whole = wholeOf(state, scratch, c);
  listFeet(state, c, whole, scratch.feet);
  if (scratch.feet.empty()) return footing;
  for (int sweeps = 0; sweeps < kMost; ++sweeps) {
    sweep(whole, scratch);
    footing.speed = speedOf(whole, state, scratch, c);
    if (!footing.gives()) break;
  }
  return footing;
}

}  // namespace merge2d
