#include "src2d/merging/ready_joints.h"

#include <algorithm>

#include "src2d/collections/joint_welds.h"
#include "src2d/dynamics/solver.h"
#include "src2d/merging/merge_criteria.h"
#include "src2d/merging/pair_metric.h"
#include "src2d/proofs/decided_settings.h"

namespace merge2d {
namespace {

Vec2 endOf(const State& state, const Joint& joint) {
  return joint.to_world ? joint.anchor_b : state.pose(joint.b) * joint.anchor_b;
}

/// The joint has come to rest.
Criterion jointHardlyBreathes(const State& state, const Joint& joint, double scale) {
  return below("breathing", kOwnMerging, joint.breath, scale * state.settings.merging.breathing);
}

/// Eqs. (15) to (17) for the bodies of a joint. Those of a soft one must have come to rest: merged
/// they would be found to move at once.
Criterion jointedBodiesMoveAsOne(const State& state, const Joint& joint, const BodyPair& pair,
                                 double scale) {
  double most = scale * state.settings.merging.velocity;
  if (joint.compliance > 0.0) most = std::min(most, cutSpeed(state));
  return below("relative-motion", kOwnMerging, relativeMotion(state, pair), most);
}

void countQuietJoint(State& state, Joint& joint, Notes* notes) {
  const auto [a, b] = pairOf(joint);
  const BodyPair pair{a, b, 0, 0};
  const double scale = thresholdScale(contactSize(state, joint.a, joint.b));
  const Criterion breath = jointHardlyBreathes(state, joint, scale);
  const Criterion motion = jointedBodiesMoveAsOne(state, joint, pair, scale);
  joint.yielded = {};
  const int before = joint.quiet_steps;
  joint.quiet_steps = breath.holds && motion.holds ? before + 1 : 0;
  if (!notes) return;
  noteCorners(state, pair, notes);
  const TestCount count{before, joint.quiet_steps, state.settings.merging.steps};
  for (const Criterion& test : {breath, motion}) {
    const std::string_view verdict = test.holds ? "below" : "apart";
    notes->decisions.push_back(record(test, "AccumulateRelativeMotion", a, b, verdict, count));
  }
}

}  // namespace

void countQuietJoints(State& state, Scratch& scratch) {
  for (const std::uint32_t i : state.joint_lists.present) {
    Joint& joint = state.joints[i];
    if (joint.to_world || !holds(state, joint) || isInside(state, joint)) continue;
    if (!isWatched(state, joint.a, joint.b)) continue;
    if (!isNotCarried(state, joint.a, joint.b).holds) continue;
    countQuietJoint(state, joint, scratch.notes);
  }
}

std::vector<JointEdge> pairsOfQuietJoints(const State& state) {
  std::vector<const Joint*> ready;
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
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
