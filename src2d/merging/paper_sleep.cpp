/// Section 7 to the letter.

#include "src2d/merging/paper_rule.h"
#include "src2d/sleeping/sleep.h"

namespace merge2d {

void sleepEachByItself(State& state, Scratch& scratch) {
  markRestless(state, scratch);
  for (const Meeting& meeting : scratch.meetings) {  // "a new contact wakes"
    const BodyPair& pair = scratch.pairs[meeting.pair];
    for (const BodyId b : {pair.a, pair.b}) scratch.restless[index(state[b].rigid)] = 1;
  }
  for (const RigidId id : state.present) {
    if (!canSleep(state, id)) continue;
    const Rigid& r = state[id];
    const Criterion quiet = isQuiet(state, scratch, id);
    recordSleep(state, scratch, id, quiet);
    if (r.asleep && !quiet.holds) wakeUp(state, scratch, id);
    if (!r.asleep && quiet.holds) fallAsleep(state, scratch, id);
  }
}

}  // namespace merge2d
