#include "src2d/merging/unmerge.h"

#include <algorithm>

#include "src2d/collections/collection.h"
#include "src2d/collections/cuts.h"
#include "src2d/contact/detection.h"
#include "src2d/dynamics/hits.h"
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

/// Whether hits of two bodies are followed (dynamics/hits.h) of which one is as fast as this [m/s]:
/// bounces, and later hits in their chain that are too slow to bounce.
bool isFollowed(const State& state, BodyId a, BodyId b, double speed) {
  return restitutionOf(state, a, b) > 0.0 && speed > state.settings.unmerging.velocity;
}

/// The speed that a body at rest gets from one that hits it, by Newton's law, as in a row of balls
/// [m/s].
double passedOn(const State& state, BodyId from, BodyId to, double speed) {
  if (!state.responds(to) || !isFollowed(state, from, to, speed)) return 0.0;
  const ContactKey key{from, to, state[from].first_shape, state[to].first_shape};
  const double e = speed > leastBounce(state, key) ? restitutionOf(state, from, to) : 0.0;
  return (1.0 + e) * speed * state[from].mass / (state[from].mass + state[to].mass);
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
  constexpr double kMore = 1.0 + 1e-9;  // or equal balls would pass on rounding errors for ever
  bool more = !arrives.empty();
  const auto passTo = [&](BodyId to, BodyId from) {
    const double speed = passedOn(state, from, to, arrives[index(from)]);
    if (speed <= kMore * arrives[index(to)]) return;
    arrives[index(to)] = speed;
    more = true;
  };
  const auto pass = [&](const auto& touching) {
    passTo(touching.a, touching.b);
    passTo(touching.b, touching.a);
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

/// No bounce arrives at the bodies of a weld: bodies that bounce are followed hit by hit, each on
/// its own (dynamics/hits.h).
Criterion bouncesNot(const State& state, const Weld& weld, const std::vector<double>& arrives) {
  const double speed = std::max(arrives[index(weld.a)], arrives[index(weld.b)]);
  return {"bounce", kOwnHits, speed, state.settings.unmerging.velocity,
          !isFollowed(state, weld.a, weld.b, speed)};
}

/// Cuts the welds of a collection at which bounces arrive.
bool cutBouncing(const State& state, const Scratch& scratch, Collection& c,
                 const std::vector<double>& arrives) {
  bool any = false;
  for (Weld& weld : c.welds) {
    if (weld.joints > 0) continue;
    const Criterion stays = bouncesNot(state, weld, arrives);
    if (stays.holds) continue;
    weld.cut = any = true;
    weld.reason = EventReason::RelativeMotion;
    if (!scratch.notes) continue;
    scratch.notes->decisions.push_back(
        record(stays, "Unmerge", weld.a, weld.b, "unmerge", {.count = 1}));
  }
  return any;
}

void releaseBouncing(State& state, Scratch& scratch, const std::vector<double>& arrives) {
  if (arrives.empty()) return;
  for (std::size_t slot = 0, slots = state.collections.size(); slot < slots; ++slot) {
    Collection& c = state.collections[slot];
    if (c.id == kNoCollection) continue;
    Noted noted(scratch.notes);
    if (!cutBouncing(state, scratch, c, arrives)) continue;
    noted.close();
    splitAtCuts(state, scratch, c.rigid, collectionMethod(state).parts(state, scratch, c));
    restate(state, noted, "cut");
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
    splitAtCuts(state, scratch, c.rigid, collectionMethod(state).parts(state, scratch, c));
  }
  finishSplits(state, scratch);
  layOutCollections(state);
}

}  // namespace merge2d
