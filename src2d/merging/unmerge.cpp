#include "src2d/merging/unmerge.h"

#include <algorithm>

#include "src2d/contact/detection.h"
#include "src2d/dynamics/hits.h"
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

/// The speed that passes from one body to another that it touches: e times the speed of arrival, as
/// in a row of balls. 0 where they do not bounce, or it is too slow for that [m/s].
double passedOn(const State& state, BodyId a, BodyId b, const std::vector<double>& arrives) {
  const double e = restitutionOf(state, a, b);
  if (e == 0.0) return 0.0;
  const double speed = e * std::max(arrives[index(a)], arrives[index(b)]);
  const ContactKey key{a, b, state[a].first_shape, state[b].first_shape};
  return speed > leastBounce(state, key) ? speed : 0.0;
}

/// How fast the bounces of this step arrive at each body [m/s]; empty when there are none, or no
/// collections.
std::vector<double> arrivingSpeeds(const State& state, const Scratch& scratch) {
  std::vector<double> arrives;
  if (state.collections.empty()) return arrives;
  for (const Meeting& meeting : scratch.meetings) {
    const BodyPair& pair = scratch.pairs[meeting.pair];
    if (restitutionOf(state, pair.a, pair.b) == 0.0) continue;
    if (arrives.empty()) arrives.assign(state.bodies.size(), 0.0);
    for (const BodyId b : {pair.a, pair.b}) {
      if (state.responds(b)) arrives[index(b)] = std::max(arrives[index(b)], meeting.speed);
    }
  }
  bool more = !arrives.empty();
  const auto pass = [&](const auto& touching) {
    const double speed = passedOn(state, touching.a, touching.b, arrives);
    for (const BodyId b : {touching.a, touching.b}) {
      if (!state.responds(b) || arrives[index(b)] >= speed) continue;
      arrives[index(b)] = speed;
      more = true;
    }
  };
  while (more) {
    more = false;
    for (const BodyPair& pair : scratch.pairs) pass(pair);
    for (const Collection& c : state.collections) {
      if (c.id == kNoCollection) continue;
      for (const Weld& weld : c.welds) pass(weld);
    }
  }
  return arrives;
}

/// A bouncing body that was hit is followed hit by hit (dynamics/hits.h), on its own.
void releaseBouncing(State& state, Scratch& scratch, const std::vector<double>& arrives) {
  if (arrives.empty()) return;
  for (std::size_t slot = 0, slots = state.collections.size(); slot < slots; ++slot) {
    Collection& c = state.collections[slot];
    bool any = false;
    for (Weld& weld : c.welds) {
      if (c.id == kNoCollection || weld.joints > 0) continue;
      if (passedOn(state, weld.a, weld.b, arrives) == 0.0) continue;
      weld.cut = any = true;
      weld.reason = EventReason::RelativeMotion;
    }
    if (any) splitAtCuts(state, scratch, c.rigid, unmergingMethod(state).parts(state, scratch, c));
  }
}

}  // namespace

void unmerge(State& state, Scratch& scratch) {
  const std::vector<double> arrives = arrivingSpeeds(state, scratch);
  if (scratch.sweeping) unmergingMethod(state).unmerge(state, scratch);
  releaseBouncing(state, scratch, arrives);
  finishSplits(state, scratch);
  if (scratch.sweeping) forgetExpectedContacts(state, scratch);
}

void releaseBody(State& state, Scratch& scratch, BodyId body) {
  const std::size_t slots = state.collections.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    Collection& c = state.collections[slot];
    if (c.id == kNoCollection) continue;
    bool any = false;
    for (Weld& weld : c.welds) {
      weld.cut = weld.a == body || weld.b == body;  // marks of an earlier step parted nothing
      if (!weld.cut) continue;
      weld.reason = EventReason::User;
      any = true;
    }
    if (!any) continue;
    splitAtCuts(state, scratch, c.rigid, unmergingMethod(state).parts(state, scratch, c));
  }
  finishSplits(state, scratch);
  layOutCollections(state);
}

}  // namespace merge2d
