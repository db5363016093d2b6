#include "src2d/merging/relative_motion.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "src2d/merging/merge_criteria.h"
#include "src2d/merging/pair_metric.h"
#include "src2d/merging/quiet_rigids.h"
#include "src2d/merging/ready_joints.h"
#include "src2d/merging/rule.h"
#include "src2d/proofs/decided_settings.h"

namespace merge2d {
namespace {

constexpr std::string_view kStage = "AccumulateRelativeMotion";

/// A pair that parted slowly has waited, but for the last step, which counts.
Criterion hasWaited(int count) {
  return {"patience", kOwnMerging, static_cast<double>(-count), 1.0, count >= -1};
}

/// A pair that waits, as it parted slowly, and does not move half as fast as it would by now with
/// the gain of that step, after a tenth of the longest wait: a load that swings, or was
/// near the edge of what its contacts carry, has gone back. Guarded by
/// Merge.APairThatPartedSlowlyAndStoppedWaitsNoLonger.
Criterion hasStopped(const State& state, const BodyPair& pair, const Contact& contact) {
  const auto gain = static_cast<double>(contact.parting);
  const double steps = stepsUntilSeen(state, gain) + contact.quiet_steps;
  return below("stopped", kOwnMerging, relativeMotion(state, pair), 0.5 * steps * gain);
}

/// It has waited for long enough to be asked for that: for a tenth of the longest wait.
bool isAskedWhetherItStopped(const State& state, const Contact& contact) {
  constexpr int kLongEnough = kDecided.patience / 10;  // steps
  if (contact.parting <= 0.0F || contact.quiet_steps >= -1) return false;
  const auto gain = static_cast<double>(contact.parting);
  return stepsUntilSeen(state, gain) + contact.quiet_steps >= kLongEnough;
}

/// A pair that has stopped waits no longer.
void endWait(const State& state, const BodyPair& pair, Contact& first, Notes* notes) {
  if (!isAskedWhetherItStopped(state, first)) return;
  const Criterion stopped = hasStopped(state, pair, first);
  if (notes) {
    notes->decisions.push_back(
        record(stopped, kStage, pair.a, pair.b, stopped.holds ? "below" : "wait"));
  }
  if (stopped.holds) first.quiet_steps = -1;
}

/// The criteria of one pair in one step.
struct Readiness {
  bool pressed = false, ready = true;
  std::vector<Criterion> asked{};  ///< for the record; empty where nobody asks for one
};

/// Asks the criteria of the rule. Where nobody asks for a record the first one that does not hold
/// ends it: the expensive ones come last.
Readiness readinessOf(const State& state, const BodyPair& pair, bool recorded) {
  Readiness r;
  const auto ask = [&](const Criterion& test) {
    if (recorded) r.asked.push_back(test);
    r.ready &= test.holds;
  };
  const PairInContact seen = lookAt(state, pair);
  const Criterion press = pressed(seen);
  if (!press.holds) {
    ask(press);
    return r;
  }
  r.pressed = true;
  for (const PairCriterion criterion : mergingMethod(state).criteria) {
    ask(criterion(seen));
    if (!r.ready && !recorded) break;
  }
  return r;
}

/// Records the criteria of a pair with its count before and after this step.
void recordReadiness(const State& state, Notes* notes, const BodyPair& pair, const Readiness& r,
                     int before, int now) {
  if (!notes) return;
  if (const Criterion waited = hasWaited(before); !waited.holds) {
    notes->decisions.push_back(record(waited, kStage, pair.a, pair.b, "wait"));
  }
  const TestCount count{before, now, state.settings.merging.steps};
  for (const Criterion& test : r.asked) {
    notes->decisions.push_back(
        record(test, kStage, pair.a, pair.b, test.holds ? "below" : "apart", count));
  }
  if (r.pressed) noteCorners(state, pair, notes);
}

constexpr int kMostSteps = std::numeric_limits<std::int16_t>::max();  ///< that are counted

void countQuietPair(State& state, const BodyPair& pair, Notes* notes) {
  Contact& first = state.contacts[state.contacts.order[pair.first]];
  endWait(state, pair, first, notes);
  const int count = first.quiet_steps;
  const Readiness r = readinessOf(state, pair, notes != nullptr);
  // The last step of a wait counts: at 0 a pair would seem not to wait for anything, and sleep.
  const int now =
      r.ready ? std::min(kMostSteps, count == -1 ? 1 : count + 1) : std::min(0, count + 1);
  recordReadiness(state, notes, pair, r, count, now);
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    Contact& contact = state.contacts[state.contacts.order[i]];
    contact.quiet_steps = static_cast<std::int16_t>(now);
    const Vec2 impulse = impulseOf(contact);
    contact.borne = {static_cast<float>(impulse.x()), static_cast<float>(impulse.y())};
  }
}

void countQuietPairs(State& state, Scratch& scratch) {
  for (const BodyPair& pair : scratch.pairs) {
    if (!isWatched(state, pair.a, pair.b)) continue;
    const Criterion free = isNotCarried(state, pair.a, pair.b);
    if (free.holds) countQuietPair(state, pair, scratch.notes);
    if (free.holds || !scratch.notes) continue;
    scratch.notes->decisions.push_back(record(free, kStage, pair.a, pair.b, "apart"));
  }
}

}  // namespace

void accumulateRelativeMotion(State& state, Scratch& scratch) {
  if (merges(state.mode)) countQuietPairs(state, scratch);
  if (merges(state.mode) && !state.joints.empty()) countQuietJoints(state, scratch);
  if (sleeps(state.mode)) countQuietRigids(state, scratch);
}

}  // namespace merge2d
