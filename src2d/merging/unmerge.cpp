#include "src2d/merging/unmerge.h"

#include "src2d/contact/detection.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/cuts.h"
#include "src2d/merging/kicked.h"
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
  if (!scratch.sweeping) return;
  unmergingMethod(state).unmerge(state, scratch);
  finishSplits(state, scratch);
  forgetExpectedContacts(state, scratch);
}

void releaseBody(State& state, Scratch& scratch, BodyId body) {
  const std::size_t slots = state.collections.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    Collection& c = state.collections[slot];
    if (c.id == kNoCollection) continue;
    bool any = false;
    for (Weld& weld : c.welds) {
      if (weld.a != body && weld.b != body) continue;
      weld.cut = any = true;
      weld.reason = EventReason::User;
    }
    if (!any) continue;
    splitAtCuts(state, scratch, c.rigid, unmergingMethod(state).parts(state, scratch, c));
  }
  finishSplits(state, scratch);
  layOutCollections(state);
}

}  // namespace merge2d
