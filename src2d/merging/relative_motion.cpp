#include "src2d/merging/relative_motion.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "src2d/core/memory.h"
#include "src2d/merging/pair_metric.h"
#include "src2d/merging/pair_readiness.h"
#include "src2d/merging/ready_joints.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/sleeping/sleep.h"

namespace merge2d {
namespace {

/// A pair that parted slowly may not be looked at yet.
void notePatience(Notes* notes, const BodyPair& pair, int count) {
  if (!notes) return;
  notes->decisions.push_back({.a = pair.a,
                              .b = pair.b,
                              .stage = "AccumulateRelativeMotion",
                              .criterion = "patience",
                              .equation = kOwnMerging,
                              .value = static_cast<double>(-count),
                              .threshold = 0.0,
                              .verdict = "wait"});
}

/// A pair that waits, as it parted slowly, and does not move half as fast as it would by now with
/// the gain of that step, after a tenth of the longest wait: a load that swings, or was
/// near the edge of what its contacts carry, has gone back. Guarded by
/// Merge.APairThatPartedSlowlyAndStoppedWaitsNoLonger.
bool hasStopped(const State& state, const BodyPair& pair, const Contact& contact) {
  if (contact.parting <= 0.0F || contact.quiet_steps >= -1) return false;
  const auto gain = static_cast<double>(contact.parting);
  const double steps = stepsUntilSeen(state, gain) + contact.quiet_steps;
  return steps >= kDecided.tolerance * kDecided.past_steps &&
         relativeMotion(state, pair, nullptr) < 0.5 * steps * gain;
}

constexpr int kMostSteps = std::numeric_limits<std::int16_t>::max();  ///< that are counted

void countQuietPairs(State& state, Scratch& scratch) {
  for (const BodyPair& pair : scratch.pairs) {
    const Rigid &a = state.rigid(pair.a), &b = state.rigid(pair.b);
    if (a.asleep || b.asleep || !(a.floating() || b.floating() || a.anchor == b.anchor)) continue;
    if (hasBelt(state, pair.a, pair.b)) continue;  // a carried body moves, however slowly
    Contact& first = state.contacts[state.contacts.order[pair.first]];
    if (hasStopped(state, pair, first)) first.quiet_steps = -1;
    const int count = first.quiet_steps;
    if (count < -1) notePatience(scratch.notes, pair, count);
    PairTest test(state, pair, scratch.notes);
    const bool ready = test.ready();
    // The last step of a wait counts: at 0 a pair would seem not to wait for anything, and sleep.
    const int now =
        ready ? std::min(kMostSteps, count == -1 ? 1 : count + 1) : std::min(0, count + 1);
    test.noteCount(count, now);
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      Contact& contact = state.contacts[state.contacts.order[i]];
      contact.quiet_steps = static_cast<std::int16_t>(now);
      const Vec2 impulse = impulseOf(contact);
      contact.borne = {static_cast<float>(impulse.x()), static_cast<float>(impulse.y())};
    }
  }
}

/// The forces on a rigid thing beside gravity.
struct Ties {
  bool held = false;    ///< forces that are found by iteration: of contacts or joints
  bool loaded = false;  ///< loads
};

/// Per rigid thing that is present.
const std::vector<Ties>& listTies(const State& state, const Scratch& scratch) {
  thread_local std::vector<Ties> ties;  // its memory is kept
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
  for (const Joint& joint : state.joints) {
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

/// Section 7: each rigid thing against the inertial frame. Deviation: an accelerating body does not
/// sleep, however slow it is, or a stone would stay at the top of its flight. A load must have been
/// steady for as long as acceleration is looked ahead for; so may one that is held by contacts
/// prove that nothing comes of its acceleration. Guarded by Balance.WhatFallsSlowlyFallsOn.
void countQuietRigids(State& state, Scratch& scratch) {
  const SleepingSettings& sleeping = state.settings.sleeping;
  const VelocityField still;
  const std::vector<Ties>& all_ties = listTies(state, scratch);
  for (const RigidId id : state.present) {
    Rigid& r = state[id];
    if (r.asleep || !canSleep(state, id)) continue;
    const OrientedBox box = worldBox(state, r);
    const double motion = fastestCorner(box, motionField(r), still);
    const double velocity = sleeping.velocity * thresholdScale(2.0 * box.half.minCoeff());
    r.slow_steps = motion < velocity ? r.slow_steps + 1 : 0;
    const bool slow = r.slow_steps > 0;
    if (!slow && !scratch.notes) {  // the dearer question need not be asked
      r.quiet_steps = 0;
      continue;
    }
    const Ties& ties = all_ties[index(id)];
    const auto& gained = scratch.u[index(id)].gained;
    const double gain = fastestCorner(box, {r.x, {gained[0], gained[1]}, gained[2]}, still);
    const double largest = largestGain(state, ties, velocity);
    const bool balanced = gain <= largest, lasts = r.slow_steps * state.h >= sleeping.time;
    const bool at_rest =
        ties.held ? lasts || (balanced && !ties.loaded) : balanced && (lasts || !ties.loaded);
    const int before = r.quiet_steps;
    r.quiet_steps = slow && at_rest ? r.quiet_steps + 1 : 0;
    if (!scratch.notes) continue;
    const auto note = [&](std::string_view criterion, std::string_view equation, double value,
                          double threshold, bool below) {
      const BodyId body = state.firstBody(id);
      scratch.notes->decisions.push_back({.a = body,
                                          .b = body,
                                          .stage = "AccumulateRelativeMotion",
                                          .criterion = criterion,
                                          .equation = equation,
                                          .value = value,
                                          .threshold = threshold,
                                          .count = r.quiet_steps,
                                          .needed = sleeping.steps,
                                          .verdict = below ? "below" : "awake",
                                          .before = before});
    };
    note("rest", "Section 7", motion, velocity, slow);
    if (slow && sleeping.time > 0.0) note("balance", kOwnSleeping, gain, largest, at_rest);
  }
}

}  // namespace

void accumulateRelativeMotion(State& state, Scratch& scratch) {
  if (merges(state.mode)) countQuietPairs(state, scratch);
  if (merges(state.mode) && !state.joints.empty()) countQuietJoints(state, scratch);
  if (sleeps(state.mode)) countQuietRigids(state, scratch);
}

}  // namespace merge2d
