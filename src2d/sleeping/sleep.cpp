#include "src2d/sleeping/sleep.h"

#include <algorithm>

#include "src2d/collections/collection.h"
#include "src2d/core/memory.h"

namespace merge2d {
namespace {

/// Sum of the loads on each body that has any. A load that changes stirs its body, and is steady
/// from then on; `stirred` is told of bodies that sleep.
template <class F>
void sumLoads(State& state, const Scratch& scratch, F&& stirred) {
  constexpr double kTrace = 1e-6;  // of the load, and of the force that gives 1 m/s²
  for (const Load& load : scratch.loads) state[load.body].load.setZero();
  for (const Load& load : scratch.loads) state[load.body].load += load.force;
  for (const Load& load : scratch.loads) {
    Body& body = state[load.body];
    const double change = (body.load - body.steady_load).norm();
    if (change <= kTrace * (body.load.norm() + body.mass)) continue;
    body.steady_load = body.load;
    Rigid& r = state.rigid(load.body);
    if (r.asleep) stirred(load.body);
    if (!r.asleep) r.stir();
  }
}

}  // namespace

bool canSleep(const State& state, RigidId id) {
  return state[id].present() && (state[id].floating() || state.isCollection(id));
}

void markRestless(State& state, Scratch& scratch) {
  auto& restless = scratch.restless;
  resizeTightly(restless, state.rigids.size());
  for (const RigidId id : state.present) restless[index(id)] = 0;
  const auto mark = [&](BodyId b) { restless[index(state[b].rigid)] = 1; };
  for (const Kick& kick : scratch.kicks) mark(kick.body);
  for (const BodyId b : scratch.stirred) mark(b);
  sumLoads(state, scratch, mark);
  for (const Collection& c : state.collections) {
    if (c.id == kNoCollection || state[c.rigid].floating()) continue;
    if (state[rigidOf(c.anchor)].isOnMovingFrame()) restless[index(c.rigid)] = 1;
  }
  for (const BodyPair& pair : scratch.pairs) {
    const Rigid &a = state.rigid(pair.a), &b = state.rigid(pair.b);
    if (a.isOnMovingFrame()) mark(pair.b);
    if (b.isOnMovingFrame()) mark(pair.a);
  }
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (joint.to_world || !holds(state, joint)) continue;
    if (state.rigid(joint.a).isOnMovingFrame()) mark(joint.b);
    if (state.rigid(joint.b).isOnMovingFrame()) mark(joint.a);
  }
}

void fallAsleep(State& state, Scratch& scratch, RigidId id) {
  Rigid& r = state[id];
  r.asleep = true;
  r.v.setZero();
  r.omega = 0.0;
  Collection* c = state.isCollection(id) ? &state.collection(id) : nullptr;
  const BodyId first = state.firstBody(id);
  if (c && !c->certificate.empty()) putBlocksAway(*c);
  scratch.events.push_back(
      {EventType::Sleep, first, first, c ? c->id : kNoCollection, EventReason::None});
}

namespace {

Criterion keepsAwake(std::string_view criterion) {
  return {criterion, kOwnSleeping, 1.0, 0.0, false};
}

}  // namespace

Criterion isQuiet(const State& state, const Scratch& scratch, RigidId id) {
  if (scratch.restless[index(id)] != 0) return keepsAwake("disturbed");
  const Rigid& r = state[id];
  const int needed = state.settings.sleeping.steps;
  return {"rest", "Section 7", static_cast<double>(r.quiet_steps), static_cast<double>(needed),
          r.asleep || r.quiet_steps >= needed};
}

void recordSleep(const State& state, const Scratch& scratch, RigidId id, const Criterion& test) {
  const Rigid& r = state[id];
  if (!scratch.notes || (r.asleep && test.holds)) return;
  const BodyId first = state.firstBody(id);
  const std::string_view verdict = test.holds ? "sleep" : r.asleep ? "wake" : "wait";
  scratch.notes->decisions.push_back(
      record(test, "SleepAndWake", first, first, verdict,
             {r.quiet_steps, r.quiet_steps, state.settings.sleeping.steps}));
}

namespace {

/// It is quiet, and so are the forces inside.
Criterion maySleep(const State& state, const Scratch& scratch, RigidId id) {
  const Criterion quiet = isQuiet(state, scratch, id);
  if (!quiet.holds || state[id].asleep || !state.isCollection(id)) return quiet;
  return state.collection(id).settled ? quiet : keepsAwake("inner-forces");
}

/// Whether something in its island stays awake.
std::uint8_t& awakeOfIsland(Scratch& scratch, RigidId id) {
  return scratch.island_awake[scratch.sets.find(static_cast<std::uint32_t>(id))];
}

/// True while a pair of which one is free counts the steps until it merges, or those before it may
/// be looked at again: asleep it would never merge.
bool isAboutToMerge(const State& state, const BodyPair& pair) {
  if (!merges(state.mode) || state.rigid(pair.a).asleep || state.rigid(pair.b).asleep) return false;
  const auto free = [&](BodyId b) { return state.rigid(b).floating() && !state.isMember(b); };
  if (!free(pair.a) && !free(pair.b)) return false;
  const int quiet = state.contacts[state.contacts.order[pair.first]].quiet_steps;
  return quiet != 0 && quiet < state.settings.merging.steps;
}

/// Keeps the islands of those awake.
void awaitMerges(const State& state, Scratch& scratch) {
  for (const BodyPair& pair : scratch.pairs) {
    if (!isAboutToMerge(state, pair)) continue;
    for (const BodyId b : {pair.a, pair.b}) {
      const RigidId id = state[b].rigid;
      if (canSleep(state, id)) awakeOfIsland(scratch, id) = 1;
    }
  }
}

/// Islands over everything that can sleep, sleeping or not: things that touch, or that a joint
/// holds.
void uniteIslands(const State& state, Scratch& scratch) {
  auto& sets = scratch.sets;
  sets.reset(state.rigids.size());
  const auto unite = [&](BodyId body_a, BodyId body_b) {
    const RigidId a = state[body_a].rigid, b = state[body_b].rigid;
    if (!canSleep(state, a) || !canSleep(state, b)) return;
    sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  };
  for (const BodyPair& pair : scratch.pairs) unite(pair.a, pair.b);
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!joint.to_world && holds(state, joint)) unite(joint.a, joint.b);
  }
}

void findWhatStaysAwake(const State& state, Scratch& scratch) {
  resizeTightly(scratch.island_awake, state.rigids.size());
  for (const RigidId id : state.present) scratch.island_awake[index(id)] = 0;
  for (const RigidId id : state.present) {
    if (canSleep(state, id) && !maySleep(state, scratch, id).holds) awakeOfIsland(scratch, id) = 1;
  }
  awaitMerges(state, scratch);
}

}  // namespace

void wakeUp(State& state, Scratch& scratch, RigidId id) {
  Rigid& r = state[id];
  r.asleep = false;
  r.stir();
  const Collection* c = state.isCollection(id) ? &state.collection(id) : nullptr;
  const BodyId first = state.firstBody(id);
  scratch.events.push_back(
      {EventType::Wake, first, first, c ? c->id : kNoCollection, EventReason::None});
}

void sleepByIslands(State& state, Scratch& scratch) {
  markRestless(state, scratch);
  uniteIslands(state, scratch);
  findWhatStaysAwake(state, scratch);
  for (const RigidId id : state.present) {
    if (!canSleep(state, id)) continue;
    const bool stays_awake = awakeOfIsland(scratch, id) != 0;
    if (scratch.notes) {
      const Criterion own = maySleep(state, scratch, id);
      recordSleep(state, scratch, id, own.holds && stays_awake ? keepsAwake("neighbours") : own);
    }
    const bool asleep = state[id].asleep;
    if (asleep && stays_awake) wakeUp(state, scratch, id);
    if (!asleep && !stays_awake) fallAsleep(state, scratch, id);
  }
}

}  // namespace merge2d
