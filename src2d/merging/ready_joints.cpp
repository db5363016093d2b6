#include "src2d/merging/ready_joints.h"

#include <algorithm>

#include "src2d/collections/joint_welds.h"
#include "src2d/dynamics/solver.h"
#include "src2d/merging/pair_metric.h"

namespace merge2d {
namespace {

Vec2 endOf(const State& state, const Joint& joint) {
  return joint.to_world ? joint.anchor_b : state.pose(joint.b) * joint.anchor_b;
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
    record(scratch, joint, "breathing", kOwnMerging, joint.breath, breathing, now, m.steps);
    record(scratch, joint, "relative-motion", kOwnMerging, motion, velocity, now, m.steps);
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
    JointHold hold;
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
