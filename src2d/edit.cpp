#include "src2d/edit.h"

#include <fmt/format.h>

#include <utility>

#include "src2d/begin_step.h"
#include "src2d/collections/collection.h"
#include "src2d/contact/broadphase.h"
#include "src2d/contact/detection.h"
#include "src2d/contact/table.h"
#include "src2d/core/error.h"
#include "src2d/merging/unmerge.h"
#include "src2d/proofs/proof_impulses.h"

namespace merge2d {
namespace {

/// A body and what touches it must not sleep through the next step, also when they part now.
void stirAround(Setup& setup, BodyId body) {
  listAround(setup.state, {body}, setup.actions.stirred);
}

/// Takes a body out of its collection, or all that is merged with a pinned one away from it. While
/// that happens it belongs to no frame, so that its contacts come free too.
void detach(Setup& setup, Scratch& scratch, BodyId body) {
  State& state = setup.state;
  const FrameId frame = std::exchange(state[rigidOf(body)].anchor, kFloating);
  releaseBodies(state, scratch, {body});
  state[rigidOf(body)].anchor = frame;
}

/// Its contacts are of another place.
void forgetContacts(State& state, Scratch& scratch, BodyId body) {
  const auto concerned = [&](const ContactKey& key) { return key.a == body || key.b == body; };
  dropContacts(state.contacts, [&](const Contact& contact) { return concerned(contact.key); });
  std::erase_if(state.contacts.idle, [&](const IdlePair& pair) { return concerned(pair.key); });
  collectPairs(state, scratch);
}

/// Takes the bodies of a joint out of their collections. Those that are merged with a fixed one
/// stay.
void releaseEnds(Setup& setup, Scratch& scratch, BodyId a, BodyId b) {
  const State& state = setup.state;
  for (const BodyId body : {a, b}) {
    if (state[body].alive && state.responds(body)) release(setup, scratch, body);
  }
}

/// Bodies that are fixed have no contacts with each other: those of a pinned one would make it a
/// member.
void dropContactsOfFixed(State& state, Scratch& scratch) {
  const auto are_fixed = [&](const ContactKey& key) {
    return !state.responds(key.a) && !state.responds(key.b);
  };
  dropContacts(state.contacts, [&](const Contact& contact) { return are_fixed(contact.key); });
  std::erase_if(state.contacts.idle, [&](const IdlePair& pair) { return are_fixed(pair.key); });
  collectPairs(state, scratch);
}

bool isScripted(const State& state, BodyId body) { return state[body].motion == Motion::Scripted; }

void letFloat(Rigid& r) {
  r.anchor = kFloating;
  r.inv_mass = 1.0 / r.mass;
  r.inv_inertia = 1.0 / r.inertia;
  r.resized = true;
}

/// A body that is pinned at first is no longer let go at its time.
void forgetLaunch(Actions& actions, BodyId body) {
  for (Actions::Launch& launch : actions.launches) {
    if (launch.body == body) launch.done = true;
  }
}

void takeApart(State& state, Scratch& scratch, RigidId id) {
  const auto members = static_cast<std::uint32_t>(state.collection(id).members.size());
  std::vector<std::uint32_t> part(members);
  for (std::uint32_t i = 0; i < members; ++i) part[i] = i;
  splitCollection(state, id, part, std::vector<std::uint8_t>(members, 0));
  collectPairs(state, scratch);
}

}  // namespace

BodyId addBody(Setup& setup, const BodyDesc& desc) {
  if (desc.motion == Motion::Scripted) {
    throw InputError(
        fmt::format("body '{}': a scripted body must be in the scene from the start", desc.name));
  }
  const BodyId id = appendBody(setup, desc);
  if (setup.added.back().name.empty()) {
    setup.added.back().name = fmt::format("body{}", index(id) + 1);
  }
  bringIn(setup.state, id);
  return id;
}

void removeBody(Setup& setup, Scratch& scratch, BodyId body) {
  State& state = setup.state;
  stirAround(setup, body);
  detach(setup, scratch, body);
  forgetContacts(state, scratch, body);
  state.joint_lists.of_body.forEach(body, [&](std::uint32_t j) { removeJoint(setup, scratch, j); });
  for (std::uint32_t s = 0; s < setup.actions.springs.size(); ++s) {
    const TimedSpring& spring = setup.actions.springs[s];
    const auto i = static_cast<std::int64_t>(index(body));
    if (spring.body == index(body) || spring.to_body == i) removeSpring(setup, s);
  }
  std::erase_if(setup.actions.user_kicks, [&](const Kick& kick) { return kick.body == body; });
  std::erase_if(setup.actions.user_loads, [&](const Load& load) { return load.body == body; });
  forgetLaunch(setup.actions, body);
  dropShapeTree(state, rigidOf(body));
  removeRigid(state, rigidOf(body));
  state[body].alive = false;
}

void setPose(Setup& setup, Scratch& scratch, BodyId body, const Vec2& x, double angle) {
  State& state = setup.state;
  stirAround(setup, body);
  detach(setup, scratch, body);
  forgetContacts(state, scratch, body);
  Rigid& r = state[rigidOf(body)];
  r.x = Vec2::Zero();
  r.rest = Vec2::Zero();
  r.moveBy(x);
  r.angle = angle;
  r.rotation = r.previous_rotation = Rotation::of(angle);
  if (!r.floating()) r.anchor = static_cast<FrameId>(index(body)) + 1;
  r.resized = true;
  state.ready_before.clear();
  stirAround(setup, body);
}

void setVelocity(Setup& setup, Scratch& scratch, BodyId body, const Vec2& v, double omega) {
  State& state = setup.state;
  if (!state.responds(body)) return;
  stirAround(setup, body);
  detach(setup, scratch, body);
  Rigid& r = state[rigidOf(body)];
  r.v = v;
  r.omega = omega;
}

void pin(Setup& setup, Scratch& scratch, BodyId body) {
  State& state = setup.state;
  forgetLaunch(setup.actions, body);
  if (isScripted(state, body) || !state.responds(body)) return;
  stirAround(setup, body);
  detach(setup, scratch, body);
  Rigid& r = state[rigidOf(body)];
  r.anchor = kWorldFrame;
  r.v.setZero();
  r.omega = r.inv_mass = r.inv_inertia = 0.0;
  r.resized = true;
  dropContactsOfFixed(state, scratch);
}

void unpin(Setup& setup, Scratch& scratch, BodyId body) {
  State& state = setup.state;
  if (isScripted(state, body) || state.responds(body)) return;
  forgetLaunch(setup.actions, body);
  stirAround(setup, body);
  detach(setup, scratch, body);
  letFloat(state[rigidOf(body)]);
}

void release(Setup& setup, Scratch& scratch, BodyId body) {
  stirAround(setup, body);
  detach(setup, scratch, body);
}

void setFriction(Setup& setup, BodyId body, double friction) {
  setup.state[body].friction = friction;
  stirAround(setup, body);
}

void wake(Setup& setup, BodyId body) { stirAround(setup, body); }

void wakeAll(Setup& setup) {
  for (std::uint32_t i = 0; i < setup.state.bodies.size(); ++i) {
    const BodyId body{i};
    if (setup.state[body].alive && setup.state.responds(body)) {
      setup.actions.stirred.push_back(body);
    }
  }
}

void setSettings(State& state, const Settings& settings) {
  if (settings.unmerging.rule != state.settings.unmerging.rule) {
    for (Collection& c : state.collections) {
      bringBlocksBack(state, c);
      writeImpulses(c);
      c.certificate.clear();
    }
  }
  state.settings = settings;
}

void setMode(Setup& setup, Scratch& scratch, Mode mode) {
  State& state = setup.state;
  if (mode == state.mode) return;
  state.mode = mode;
  wakeAll(setup);
  if (merges(mode)) return;
  for (std::size_t slot = 0; slot < state.collections.size(); ++slot) {
    if (state.collections[slot].id == kNoCollection) continue;
    takeApart(state, scratch, state.collections[slot].rigid);
  }
  dropFreeSlots(state);
}

std::uint32_t addJoint(Setup& setup, Scratch& scratch, const JointDesc& desc) {
  State& state = setup.state;
  const BodyId a{static_cast<std::uint32_t>(desc.a)};
  releaseEnds(setup, scratch, a, desc.b ? BodyId{static_cast<std::uint32_t>(*desc.b)} : a);
  appendJoint(state, desc);
  listNewJoint(state);
  if (!desc.collide && desc.b) {
    const BodyId b{static_cast<std::uint32_t>(*desc.b)};
    const auto between = [&](const ContactKey& key) {
      return key.a == std::min(a, b) && key.b == std::max(a, b);
    };
    dropContacts(state.contacts, [&](const Contact& contact) { return between(contact.key); });
    std::erase_if(state.contacts.idle, [&](const IdlePair& pair) { return between(pair.key); });
    collectPairs(state, scratch);
  }
  return static_cast<std::uint32_t>(state.joints.size() - 1);
}

void removeJoint(Setup& setup, Scratch& scratch, std::uint32_t joint) {
  State& state = setup.state;
  if (state.joints[joint].broken) return;
  const Joint& held = state.joints[joint];
  releaseEnds(setup, scratch, held.a, held.to_world ? held.a : held.b);
  breakJoint(state, scratch, state.joints[joint]);
}

std::uint32_t addSpring(Setup& setup, const SpringDesc& desc, const Vec2& center_of_body,
                        const Vec2& center_of_other) {
  appendSpring(setup.actions, desc, center_of_body, center_of_other);
  wake(setup, BodyId{static_cast<std::uint32_t>(desc.body)});
  if (desc.to_body) wake(setup, BodyId{static_cast<std::uint32_t>(*desc.to_body)});
  return static_cast<std::uint32_t>(setup.actions.springs.size() - 1);
}

void moveSpring(Setup& setup, std::uint32_t spring, const Vec2& to) {
  TimedSpring& s = setup.actions.springs[spring];
  s.to = placedOnGrid(to);
  wake(setup, BodyId{static_cast<std::uint32_t>(s.body)});
}

void removeSpring(Setup& setup, std::uint32_t spring) {
  TimedSpring& s = setup.actions.springs[spring];
  if (s.removed) return;
  s.removed = true;
  wake(setup, BodyId{static_cast<std::uint32_t>(s.body)});
  if (s.to_body >= 0) wake(setup, BodyId{static_cast<std::uint32_t>(s.to_body)});
}

}  // namespace merge2d
