/// AccumulateRelativeMotion: for how many steps each pair could have merged, and each rigid thing
/// could have slept.

#include <algorithm>

#include "src2d/merging/joint_welds.h"
#include "src2d/merging/merge.h"
#include "src2d/merging/metric.h"
#include "src2d/merging/pair_test.h"

namespace merge2d {
namespace {

VelocityField fieldOf(const Rigid& r) { return {r.x, r.v, r.omega}; }

OrientedBox worldBox(const State& state, const Rigid& r) {
  OrientedBox box = state.extent(r).box;
  box.frame = r.frame() * box.frame;
  return box;
}

/// The corners of a box and how the two move against each other there, for who asks.
void noteCorners(Notes* notes, const BodyPair& pair, const OrientedBox& box, const Rigid& a,
                 const Rigid& b) {
  if (!notes) return;
  NotedCorners seen{.a = pair.a, .b = pair.b, .at = box.corners()};
  for (std::size_t i = 0; i < seen.at.size(); ++i) {
    seen.velocity[i] = fieldOf(a).at(seen.at[i]) - fieldOf(b).at(seen.at[i]);
  }
  notes->corners.push_back(seen);
}

/// The fastest of a pair's contact points: what a beam at its pivot does not show.
double fastestContact(const State& state, const BodyPair& pair) {
  const Pose pose = state.pose(pair.a);
  double fastest = 0.0;
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    for (int k = 0; k < contact.count; ++k) {
      const Vec2 at = pose * contact.points[static_cast<std::size_t>(k)].position;
      const Vec2 w = fieldOf(state.rigid(pair.a)).at(at) - fieldOf(state.rigid(pair.b)).at(at);
      fastest = std::max(fastest, w.norm());
    }
  }
  return fastest;
}

/// A pair that parted soon after it had merged may not be looked at yet.
void notePatience(Notes* notes, const BodyPair& pair, int count) {
  if (!notes) return;
  notes->decisions.push_back({.a = pair.a,
                              .b = pair.b,
                              .stage = "AccumulateRelativeMotion",
                              .criterion = "patience",
                              .equation = "Section 5.1",
                              .value = static_cast<double>(-count),
                              .threshold = 0.0,
                              .verdict = "wait"});
}

/// Sums up how far a pair that was cut in vain slips while it is free: it is known as such until it
/// has got somewhere, or touches nothing any more. What a heap jostles comes and goes, and stays
/// where it is. Guarded by Caution.LastsWhileAPairIsOnlyJostled and
/// Caution.EndsWhereAPairGetsSomewhere.
void followWhatWasCutInVain(const State& state, Contact& contact) {
  constexpr double kSeconds = 0.4;  // at the velocity at which it could merge
  if (contact.vain == 0) return;
  double slip = 0.0;
  for (int k = 0; k < contact.count; ++k) {
    const double w_t = contact.points[static_cast<std::size_t>(k)].w_t;
    if (std::abs(w_t) > std::abs(slip)) slip = w_t;
  }
  contact.strayed += static_cast<float>(slip * state.h);
  const double somewhere = kSeconds * state.settings.merging.velocity;
  if (contact.count > 0 && std::abs(contact.strayed) < somewhere) return;
  contact.vain = 0;
  contact.strayed = 0.0F;
}

void countQuietPairs(State& state, Scratch& scratch) {
  for (const BodyPair& pair : scratch.pairs) {
    const Rigid &a = state.rigid(pair.a), &b = state.rigid(pair.b);
    if (a.asleep || b.asleep || !(a.floating() || b.floating() || a.anchor == b.anchor)) continue;
    Contact& first = state.contacts[state.contacts.order[pair.first]];
    const int count = first.quiet_steps;
    if (count < 0) notePatience(scratch.notes, pair, count);
    PairTest test(state, pair, scratch.notes);
    const bool ready = test.ready();
    const int now = ready || count < 0 ? count + 1 : 0;
    test.noteCount(count, now);
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      Contact& contact = state.contacts[state.contacts.order[i]];
      contact.quiet_steps = now;
      followWhatWasCutInVain(state, contact);
    }
  }
}

/// Section 7: each rigid thing against the inertial frame.
void countQuietRigids(State& state, Notes* notes) {
  const SleepingSettings& sleeping = state.settings.sleeping;
  const VelocityField still;
  for (const RigidId id : state.present) {
    Rigid& r = state[id];
    if (r.asleep) continue;
    const double motion = fastestCorner(worldBox(state, r), fieldOf(r), still);
    const int before = r.quiet_steps;
    const bool quiet = motion < sleeping.velocity;
    r.quiet_steps = quiet ? r.quiet_steps + 1 : 0;
    const bool collection = state.isCollection(id);
    if (!notes || !(r.floating() || collection)) continue;
    const BodyId body = state.firstBody(id);
    notes->decisions.push_back({.a = body,
                                .b = body,
                                .stage = "AccumulateRelativeMotion",
                                .criterion = "rest",
                                .equation = "Section 7",
                                .value = motion,
                                .threshold = sleeping.velocity,
                                .count = r.quiet_steps,
                                .needed = sleeping.steps,
                                .verdict = quiet ? "below" : "awake",
                                .before = before});
  }
}

}  // namespace

double relativeMotion(const State& state, const BodyPair& pair, Notes* notes) {
  const bool touches = pair.count > 0;  // or is held by joints alone
  if (touches && state.settings.merging.metric == Metric::Naive) return fastestContact(state, pair);
  const Rigid &a = state.rigid(pair.a), &b = state.rigid(pair.b);
  double fastest = 0.0;
  for (const Rigid* r : {&a, &b}) {
    if (!r->floating()) continue;
    const OrientedBox box = worldBox(state, *r);
    fastest = std::max(fastest, fastestCorner(box, fieldOf(a), fieldOf(b)));
    noteCorners(notes, pair, box, a, b);
  }
  return fastest;
}

void accumulateRelativeMotion(State& state, Scratch& scratch) {
  if (merges(state.mode)) countQuietPairs(state, scratch);
  if (merges(state.mode) && !state.joints.empty()) countQuietJoints(state, scratch);
  if (sleeps(state.mode)) countQuietRigids(state, scratch.notes);
}

}  // namespace merge2d
