#include "src2d/begin_step.h"

#include <algorithm>
#include <utility>

#include "src2d/collections/collection.h"
#include "src2d/contact/parking.h"
#include "src2d/merging/unmerge.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/setup.h"
#include "src2d/sleeping/sleep.h"

namespace merge2d {
namespace {

/// True from the step that begins nearest to `time` on.
bool reached(const State& state, double time) { return time < state.time + 0.5 * state.h; }

void emitBodies(State& state, Actions& actions, Scratch& scratch) {
  auto& next = actions.next_emission;
  for (; next < actions.emissions.size(); ++next) {
    const Actions::Emission& emission = actions.emissions[next];
    if (!reached(state, emission.time)) break;
    bringIn(state, emission.body);
    scratch.events.push_back({EventType::Emit, emission.body, emission.body});
  }
}

/// Bodies that the user has changed since the last step are awake from its start on.
void takeOverStirred(State& state, Actions& actions, Scratch& scratch) {
  for (const BodyId body : actions.stirred) {
    if (!state[body].alive) continue;
    scratch.stirred.push_back(body);
    if (state.rigid(body).asleep) wakeUp(state, scratch, state[body].rigid);
  }
  actions.stirred.clear();
}

void letGo(State& state, Actions& actions, Scratch& scratch) {
  auto& launches = actions.launches;
  std::vector<std::uint32_t> due = actions.timetable.launches.begun(
      launches.size(), [&](std::uint32_t i) { return launches[i].time; },
      [&](double time) { return reached(state, time); });
  std::erase_if(due, [&](std::uint32_t i) { return std::exchange(launches[i].done, true); });
  if (due.empty()) return;
  std::vector<BodyId> bodies;
  for (const std::uint32_t i : due) bodies.push_back(launches[i].body);
  bringBackAround(state, scratch, bodies);
  listAround(state, bodies, scratch.stirred);  // none of these may sleep through this step
  for (const BodyId body : bodies) state[rigidOf(body)].anchor = kFloating;
  releaseBodies(state, scratch, bodies);
  for (const std::uint32_t i : due) {
    Rigid& r = state[rigidOf(launches[i].body)];
    r.inv_mass = 1.0 / r.mass;
    r.inv_inertia = 1.0 / r.inertia;
    r.v = launches[i].v;
    r.omega = launches[i].omega;
    r.resized = true;
  }
}

void switchMagnets(State& state, const Actions& actions, Scratch& scratch) {
  for (const MagnetDesc& magnet : actions.magnets) {
    const BodyId id{static_cast<std::uint32_t>(magnet.body)};
    const bool on = std::any_of(magnet.on.begin(), magnet.on.end(), [&](const auto& interval) {
      return reached(state, interval.from) && !reached(state, interval.until);
    });
    Body& body = state[id];
    if (body.magnet_on == on) continue;
    body.magnet_on = on;
    bringBackAround(state, scratch, {id});
    listAround(state, {id}, scratch.stirred);
    // Contacts inside collections turn bilateral, or back.
    for (Collection& c : state.collections) {
      const bool concerned = std::any_of(c.welds.begin(), c.welds.end(),
                                         [&](const Weld& w) { return w.a == id || w.b == id; });
      if (c.id == kNoCollection || !concerned) continue;
      writeImpulses(c);
      for (InternalContact& inner : c.contacts) {
        if (inner.key.a == id || inner.key.b == id) dropBlock(c, inner);
      }
      c.stale = true;
      c.certificate.clear();
    }
    layOutCollections(state);
  }
}

}  // namespace

void listAround(const State& state, const std::vector<BodyId>& bodies, std::vector<BodyId>& out) {
  const std::vector<std::uint8_t> is_named = namedAmong(state, bodies);
  out.insert(out.end(), bodies.begin(), bodies.end());
  const auto addOther = [&](BodyId a, BodyId b) {
    if (is_named[index(a)] != 0) out.push_back(b);
    if (is_named[index(b)] != 0) out.push_back(a);
  };
  for (const ContactTable::Slot slot : state.contacts.order) {
    const Contact& contact = state.contacts[slot];
    if (contact.count > 0) addOther(contact.key.a, contact.key.b);
  }
  for (const Collection& c : state.collections) {
    for (const Weld& weld : c.welds) addOther(weld.a, weld.b);
  }
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!joint.to_world && holds(state, joint)) addOther(joint.a, joint.b);
  }
}

void beginStep(State& state, Actions& actions, Scratch& scratch) {
  layOutCollections(state);  // a step that an error ended may have left some
  scratch.events.clear();
  scratch.stirred.clear();
  takeOverStirred(state, actions, scratch);
  emitBodies(state, actions, scratch);
  letGo(state, actions, scratch);
  switchMagnets(state, actions, scratch);
  moveScripted(state, actions, scratch);
  bringBackAround(state, scratch, scratch.started);
  listLoads(state, actions, scratch);
  listKicks(state, actions, scratch);
  // Bodies that are about to be struck look ahead for contacts already in this step.
  for (const Kick& kick : scratch.kicks) {
    if (state.rigid(kick.body).asleep) wakeUp(state, scratch, state[kick.body].rigid);
  }
  bringBackActedOn(state, scratch);
}

}  // namespace merge2d
