#include "src2d/merging/joint_welds.h"

#include <algorithm>

#include "src2d/dynamics/solver.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/pair_metric.h"

namespace merge2d {
namespace {

using Pair = std::pair<BodyId, BodyId>;

Pair pairOf(const Joint& joint) { return std::minmax(joint.a, joint.b); }
Pair pairOf(const Weld& weld) { return {weld.a, weld.b}; }

Vec2 endOf(const State& state, const Joint& joint) {
  return joint.to_world ? joint.anchor_b : state.pose(joint.b) * joint.anchor_b;
}

/// The relative freedoms that the joints of one pair take away.
struct Hold {
  int freedoms = 0;
  bool pivot = false;  ///< some point is shared

  void add(JointKind kind, int taken) {
    freedoms += taken;
    pivot |= kind == JointKind::Revolute;
  }
  /// Counted in contacts: a pivot takes two of the three relative freedoms, two contacts take all.
  int contacts() const {
    if (freedoms >= kFreedoms) return 2;
    return freedoms == 2 && pivot ? 1 : 0;
  }
};

/// Inside a collection motor and limit hold until they have yielded.
int freedomsInside(const State& state, const JointBlock& k) {
  const Joint& joint = state.joints[k.joint];
  if (joint.kind == JointKind::Weld) return 3;
  const auto yields = [&](std::size_t row) {
    return std::abs(joint.yielded[row - kMotorRow]) > state.settings.unmerging.sliding;
  };
  const bool brake = k.motor && joint.motor->speed == 0.0 && !yields(kMotorRow);
  const bool limit = k.limit && k.rows[kLimitRow].bias == 0.0 && !yields(kLimitRow);
  if (joint.kind == JointKind::Distance) return (joint.limits ? limit : joint.stiffness == 0.0);
  return brake || limit ? 3 : 2;
}

/// The first weld that is not before the pair.
auto weldAt(std::vector<Weld>& welds, const Pair& pair) {
  return std::lower_bound(welds.begin(), welds.end(), pair,
                          [](const Weld& w, const Pair& p) { return pairOf(w) < p; });
}

/// Counts the joints of each weld anew, in contacts: `found(weld, contacts)`.
template <class F>
void countHolds(const State& state, Collection& c, F&& found) {
  std::vector<Hold> holds(c.welds.size());
  for (const JointBlock& k : c.joints) {
    const Joint& joint = state.joints[k.joint];
    if (joint.to_world) continue;
    const auto weld = weldAt(c.welds, pairOf(joint));
    if (weld == c.welds.end() || pairOf(*weld) != pairOf(joint)) continue;
    holds[static_cast<std::size_t>(weld - c.welds.begin())].add(joint.kind,
                                                                freedomsInside(state, k));
  }
  for (std::uint32_t i = 0; i < c.welds.size(); ++i) found(i, holds[i].contacts());
}

/// True when some weld holds less than before.
bool updateWelds(const State& state, Collection& c) {
  bool less = false;
  countHolds(state, c, [&](std::uint32_t i, int contacts) {
    Weld& weld = c.welds[i];
    if (contacts == weld.joints) return;
    less |= contacts < weld.joints;
    weld.joints = static_cast<std::uint8_t>(contacts);
  });
  return less;
}

/// Calls `f(yielded, w)` for motors and limits, with the velocity at them, 0 inside their bounds.
template <class F>
void forEachBound(State& state, const Collection& c, const std::vector<SolverVelocity>& u, F&& f) {
  const Rotation& turn = state[c.rigid].rotation;
  for (const JointBlock& k : c.joints) {
    for (const std::size_t row : {kMotorRow, kLimitRow}) {
      if (!(row == kMotorRow ? k.motor : k.limit)) continue;
      const JointRow& r = k.rows[row];
      const bool inside = k.lambda[row] > r.lower && k.lambda[row] < r.upper;
      const double w = inside ? 0.0 : jointVelocity(r, turn, u[k.a], u[k.b]);
      f(state.joints[k.joint].yielded[row - kMotorRow], w, inside);
    }
  }
}

/// Records one decision if somebody asks; `now` is the count after it.
void record(const Scratch& scratch, const Joint& joint, std::string_view criterion,
            std::string_view equation, double value, double threshold, int now, int needed) {
  if (!scratch.notes) return;
  const auto [a, b] = pairOf(joint);
  scratch.notes->decisions.push_back({.a = a,
                                      .b = b,
                                      .stage = "AccumulateRelativeMotion",
                                      .criterion = criterion,
                                      .equation = equation,
                                      .value = value,
                                      .threshold = threshold,
                                      .count = now,
                                      .needed = needed,
                                      .verdict = value < threshold ? "below" : "apart",
                                      .before = joint.quiet_steps});
}

}  // namespace

void addJointWelds(const State& state, Collection& c) {
  for (const JointBlock& k : c.joints) {
    const Joint& joint = state.joints[k.joint];
    if (joint.to_world) continue;  // it is no weld
    const Pair pair = pairOf(joint);
    const auto at = weldAt(c.welds, pair);
    if (at != c.welds.end() && pairOf(*at) == pair) continue;
    c.welds.insert(at, Weld{.a = pair.first, .b = pair.second});
  }
  if (!c.joints.empty()) updateWelds(state, c);
}

bool loosenJoints(State& state, Collection& c, const std::vector<SolverVelocity>& u) {
  if (c.joints.empty()) return false;
  forEachBound(state, c, u, [](float& yielded, double w, bool inside) {
    yielded = inside ? 0.0F : yielded + static_cast<float>(w);
  });
  return updateWelds(state, c);
}

bool anyJointBreaks(const State& state, const Collection& c) {
  return std::any_of(c.joints.begin(), c.joints.end(),
                     [&](const JointBlock& k) { return breaks(state, state.joints[k.joint]); });
}

std::vector<std::uint32_t> takeOverloadedJoints(const State& state, Collection& c) {
  c.stale = true;
  std::vector<std::uint32_t> taken;
  std::erase_if(c.joints, [&](const JointBlock& k) {
    const bool overloaded = breaks(state, state.joints[k.joint]);
    if (overloaded) taken.push_back(k.joint);
    return overloaded;
  });
  countHolds(state, c, [&](std::uint32_t i, int contacts) {
    Weld& weld = c.welds[i];
    const bool held = weld.joints > 0;
    weld.joints = static_cast<std::uint8_t>(contacts);
    if (!held || weld.joints > 0 || weld.count > 0) return;
    weld.cut = true;
    weld.reason = EventReason::Broken;
  });
  return taken;
}

void breakWhatStaysInside(State& state, Scratch& scratch, std::span<const std::uint32_t> joints) {
  for (const std::uint32_t i : joints) {
    if (isInside(state, state.joints[i]) || scratch.solved) {
      breakJoint(state, scratch, state.joints[i]);
    } else {
      scratch.overloaded_joints.push_back(i);
    }
  }
}

void countQuietJoints(State& state, Scratch& scratch) {
  const MergingSettings& m = state.settings.merging;
  for (Joint& joint : state.joints) {
    if (joint.to_world || !holds(state, joint) || isInside(state, joint)) continue;
    const Rigid &a = state.rigid(joint.a), &b = state.rigid(joint.b);
    if (a.asleep || b.asleep || !(a.floating() || b.floating() || a.anchor == b.anchor)) continue;
    if (hasBelt(state, joint.a, joint.b)) continue;
    const auto [first, second] = pairOf(joint);
    const double motion = relativeMotion(state, {first, second, 0, 0}, scratch.notes);
    const double scale = thresholdScale(contactSize(state, joint.a, joint.b));
    const double breathing = scale * m.breathing, velocity = scale * m.velocity;
    const bool quiet = joint.breath < breathing && motion < velocity;
    const int now = quiet ? joint.quiet_steps + 1 : 0;
    record(scratch, joint, "breathing", "Section 5.3", joint.breath, breathing, now, m.steps);
    record(scratch, joint, "relative-motion", "(17)", motion, velocity, now, m.steps);
    joint.yielded = {};
    joint.quiet_steps = now;
  }
}

std::vector<JointEdge> readyJoints(const State& state) {
  std::vector<const Joint*> ready;
  for (const Joint& joint : state.joints) {
    const bool quiet = joint.quiet_steps >= state.settings.merging.steps && !joint.to_world;
    if (quiet && holds(state, joint) && !isInside(state, joint)) ready.push_back(&joint);
  }
  std::ranges::stable_sort(ready, {}, [](const Joint* joint) { return pairOf(*joint); });
  std::vector<JointEdge> edges;
  for (std::size_t i = 0; i < ready.size();) {
    const Joint& first = *ready[i];
    Hold hold;
    for (; i < ready.size() && pairOf(*ready[i]) == pairOf(first); ++i) {
      hold.add(ready[i]->kind, freedomsTaken(state, *ready[i]));
    }
    const auto [a, b] = pairOf(first);
    edges.push_back(
        {a, b, std::min(hold.freedoms, kFreedoms), hold.contacts(), endOf(state, first)});
  }
  return edges;
}

}  // namespace merge2d
