#include "src2d/merging/quiet_rigids.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "src2d/core/memory.h"
#include "src2d/merging/pair_metric.h"
#include "src2d/sleeping/sleep.h"

namespace merge2d {
namespace {

/// Per rigid thing that is present.
const std::vector<Ties>& listTies(const State& state, Scratch& scratch) {
  std::vector<Ties>& ties = scratch.ties;
  resizeTightly(ties, state.rigids.size());
  for (const RigidId id : state.present) ties[index(id)] = {};
  const auto tie = [&](BodyId b) -> Ties& { return ties[index(state[b].rigid)]; };
  for (const BodyPair& pair : scratch.pairs) {
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      const Contact& contact = state.contacts[state.contacts.order[i]];
      const bool presses =
          std::any_of(contact.points.begin(), contact.points.begin() + contact.count,
                      [](const ContactPoint& p) { return p.lambda_n != 0.0; });
      if (presses) tie(pair.a).held = tie(pair.b).held = true;
    }
  }
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!holds(state, joint) || isInside(state, joint)) continue;
    tie(joint.a).held = true;
    if (!joint.to_world) tie(joint.b).held = true;
  }
  for (const Load& load : scratch.loads) tie(load.body).loaded = true;
  return ties;
}

/// The largest change of velocity in a step of a body in balance, at its corners [m/s]. Where no
/// force is found by iteration the loads cancel but for rounding.
double largestGain(const State& state, const Ties& ties, double velocity) {
  constexpr double kRounding = 1e-6, kSmallest = 1e-9;  // of gravity, and [m/s²]
  const SleepingSettings& sleeping = state.settings.sleeping;
  if (sleeping.time == 0.0) return kForever;
  if (ties.held) return velocity * state.h / sleeping.time;
  return state.h * (kSmallest + kRounding * state.gravity.norm());
}

/// A rigid thing that may be about to sleep.
struct Candidate {
  const State& state;
  const Rigid& rigid;
  Ties ties;
  OrientedBox box;
  double velocity;  ///< the threshold for things of its size [m/s]
};

/// Section 7, against the inertial frame; the threshold of small things is ours.
Criterion rests(const Candidate& c) {
  const double motion = fastestCorner(c.box, motionField(c.rigid), {});
  const bool usual = c.velocity == c.state.settings.sleeping.velocity;
  return below("rest", usual ? "Section 7" : kOwnSleeping, motion, c.velocity);
}

/// Forces and gravity balance.
Criterion isBalanced(const Candidate& c, const SolverVelocity& u) {
  const double gain =
      fastestCorner(c.box, {c.rigid.x, {u.gained[0], u.gained[1]}, u.gained[2]}, {});
  const double largest = largestGain(c.state, c.ties, c.velocity);
  return {"balance", kOwnSleeping, gain, largest, gain <= largest};
}

/// It has been slow under steady loads for as long as acceleration is looked ahead for.
Criterion isSteady(const Candidate& c) {
  const double time = c.rigid.slow_steps * c.state.h, least = c.state.settings.sleeping.time;
  return {"steady", kOwnSleeping, time, least, time >= least};
}

/// The test that decides whether it stays at rest: balance, where a load on it must have been
/// steady as well. For a thing that contacts or joints hold steadiness is enough: nothing came of
/// its acceleration.
Criterion staysAtRest(const Candidate& c, const SolverVelocity& u) {
  const Criterion balanced = isBalanced(c, u), steady = isSteady(c);
  if (balanced.holds) return c.ties.loaded ? steady : balanced;
  return c.ties.held && steady.holds ? steady : balanced;
}

void recordRest(const State& state, Scratch& scratch, RigidId id, const Criterion& test,
                int before) {
  const BodyId body = state.firstBody(id);
  scratch.notes->decisions.push_back(
      record(test, "AccumulateRelativeMotion", body, body, test.holds ? "below" : "awake",
             {before, state[id].quiet_steps, state.settings.sleeping.steps}));
}

/// Not slow, whatever its turn: the fastest corner of a box is no slower than a point inside, and
/// so no slower than the centre of mass.
bool isFast(const State& state, const Rigid& r) {
  constexpr double kRounding = 1e-6;
  const double velocity = (1.0 + kRounding) * state.settings.sleeping.velocity;
  return r.v.squaredNorm() > velocity * velocity;
}

}  // namespace

void countQuietRigids(State& state, Scratch& scratch) {
  const SleepingSettings& sleeping = state.settings.sleeping;
  const std::vector<Ties>& ties = listTies(state, scratch);
  for (const RigidId id : state.present) {
    Rigid& r = state[id];
    if (r.asleep || !canSleep(state, id)) continue;
    if (!scratch.notes && isFast(state, r)) {
      r.stir();
      continue;
    }
    const OrientedBox box = worldBox(state, r);
    const double scale = thresholdScale(2.0 * box.half.minCoeff());
    const Candidate candidate{state, r, ties[index(id)], box, sleeping.velocity * scale};
    const Criterion slow = rests(candidate);
    const int before = std::exchange(r.quiet_steps, 0);
    r.slow_steps = slow.holds ? r.slow_steps + 1 : 0;
    if (!slow.holds) {
      if (scratch.notes) recordRest(state, scratch, id, slow, before);
      continue;
    }
    const Criterion stays = staysAtRest(candidate, scratch.u[index(id)]);
    if (stays.holds) r.quiet_steps = before + 1;
    if (!scratch.notes) continue;
    recordRest(state, scratch, id, slow, before);
    if (sleeping.time > 0.0) recordRest(state, scratch, id, stays, before);
  }
}

}  // namespace merge2d
