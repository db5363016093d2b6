#include "src2d/merging/unmerge.h"

#include "src2d/collections/collection.h"
#include "src2d/collections/cuts.h"
#include "src2d/contact/detection.h"
#include "src2d/contact/parking.h"
#include "src2d/merging/bounces.h"
#include "src2d/merging/expected_contacts.h"
#include "src2d/merging/rule.h"

namespace merge2d {
namespace {

void finishSplits(State& state, Scratch& scratch) {
  if (!scratch.split) return;
  scratch.split = false;
  layOutFloating(state);
  collectPairs(state, scratch);
}

}  // namespace

void unmerge(State& state, Scratch& scratch) {
  const std::vector<double> arrives = arrivingSpeeds(state, scratch);
  const bool bounce = bounceAtWelds(state, arrives);
  if (scratch.sweeping) unmergingMethod(state).unmerge(state, scratch);
  releaseBouncing(state, scratch, arrives);
  if (bounce) scratch.solved = false;  // inside open collections nothing has bounced
  finishSplits(state, scratch);
  if (scratch.sweeping) forgetExpectedContacts(state, scratch);
}

void releaseBodies(State& state, Scratch& scratch, const std::vector<BodyId>& bodies) {
  bringBackAround(state, scratch, bodies);
  layOutCollections(state);  // a step that an error ended may have left some
  const std::vector<std::uint8_t> is_named = namedAmong(state, bodies);
  const std::size_t slots = state.collections.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    Collection& c = state.collections[slot];
    if (c.id == kNoCollection) continue;
    bool any = false;
    for (Weld& weld : c.welds) {
      weld.cut = (is_named[index(weld.a)] | is_named[index(weld.b)]) !=
                 0;  // marks of an earlier step parted nothing
      if (!weld.cut) continue;
      weld.reason = EventReason::User;
      any = true;
    }
    if (!any) continue;
    splitAtCuts(state, scratch, c.rigid, collectionMethod(state).parts(state, c));
  }
  finishSplits(state, scratch);
  layOutCollections(state);
}

}  // namespace merge2d
