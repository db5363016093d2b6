#include "src2d/collections/cuts.h"

#include "src2d/collections/collection.h"
#include "src2d/collections/collection_method.h"
#include "src2d/collections/joint_welds.h"
#include "src2d/core/assert.h"

namespace merge2d {
namespace {

/// A weld that was not cut ends because no contact of it is in the contact graph: only the others
/// held its bodies together.
constexpr Criterion kNothingPresses{"pressed", "Section 6.3", 0.0, 1.0, false};

/// One event per weld that ends.
void reportCuts(const State& state, const Collection& before, Scratch& scratch) {
  for (const Weld& weld : before.welds) {
    if (stillTogether(state, weld.a, weld.b)) continue;
    scratch.events.push_back({EventType::Unmerge, weld.a, weld.b, before.id,
                              weld.cut ? weld.reason : EventReason::Broken});
    if (weld.cut || !scratch.notes) continue;
    scratch.notes->decisions.push_back(
        record(kNothingPresses, "Unmerge", weld.a, weld.b, "unmerge"));
  }
}

}  // namespace

bool stillTogether(const State& state, BodyId a, BodyId b) {
  const Rigid &ra = state.rigid(a), &rb = state.rigid(b);
  return &ra == &rb || (!ra.floating() && ra.anchor == rb.anchor);
}

void splitAtCuts(State& state, Scratch& scratch, RigidId id, const Parts& parts) {
  const std::size_t members = state.collection(id).members.size();
  const std::size_t laid_out = state.collection(id).laid_out.members;
  MERGE2D_ASSERT(members == laid_out, "{} members, parts of {}", members, laid_out);
  Collection before;
  before.id = state.collection(id).id;
  before.welds = state.collection(id).welds;
  before.joints = state.collection(id).joints;
  std::erase_if(before.welds, [](const Weld& weld) { return weld.expected; });
  const std::vector<RigidId> out = splitCollection(state, id, parts.part, parts.anchored);
  if (!scratch.opened.empty()) scratch.opened.insert(scratch.opened.end(), out.begin(), out.end());
  reportCuts(state, before, scratch);
  for (const JointBlock& k : before.joints) {
    Joint& joint = state.joints[k.joint];
    if (!isInside(state, joint)) joint.quiet_steps = 0;
  }
  scratch.split = true;
}

bool breakJointsInside(State& state, Scratch& scratch, Collection& c) {
  if (!anyJointBreaks(state, c)) return false;
  const std::vector<std::uint32_t> joints = takeOverloadedJoints(state, c);
  const Parts parts = collectionMethod(state).parts(state, c);
  if (fallsApart(state, c, parts)) splitAtCuts(state, scratch, c.rigid, parts);
  breakWhatStaysInside(state, scratch, joints);
  scratch.split = true;  // to be laid out anew
  return true;
}

}  // namespace merge2d
