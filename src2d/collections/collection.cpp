#include "src2d/collections/collection.h"

#include <algorithm>
#include <optional>

#include "src2d/collections/collection_method.h"
#include "src2d/contact/broadphase.h"
#include "src2d/contact/table.h"
#include "src2d/core/memory.h"
#include "src2d/core/sorted_tail.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/proofs/proof_transfer.h"

namespace merge2d {
namespace {

/// Makes a body a member: it keeps its place in the world and leaves the broadphase.
void enlist(State& state, RigidId id, BodyId b, const Pose& world, double angle) {
  Body& body = state[b];
  const Rigid& r = state[id];
  const Pose local = r.frame().toLocal(world);
  body.rigid = id;
  body.local = local.position;
  body.local_angle = angle - r.angle;
  body.local_rotation = local.rotation;
}

/// A collection of the one body, which keeps pose and motion.
RigidId collectionOf(State& state, BodyId b) {
  const RigidId own = rigidOf(b);
  const RigidId id = newCollection(state);
  const Rigid single = state[own];
  takeMotion(state, id, single);
  state[id].center = Vec2::Zero();
  removeRigid(state, own);
  enlist(state, id, b, {single.x, single.rotation}, single.angle);
  state.collection(id).members = {b};
  addShapes(state, id, {b});
  insertRigid(state, id);
  state.collection(id).stale = true;
  return id;
}

RigidId asCollection(State& state, RigidId id) {
  return state.isCollection(id) ? id : collectionOf(state, BodyId{static_cast<std::uint32_t>(id)});
}

/// The longer of two runs that go on, or the later one.
HitRun united(const HitRun& x, const HitRun& y) {
  HitRun run = x.last < y.last ? y : x;
  if (x.last == y.last) run.first = std::min(x.first, y.first);
  run.blow = std::max(x.blow, y.blow);
  run.met = std::max(x.met, y.met);
  return run;
}

/// Moves the members of `from` into `to`, whose frame stays.
void absorbMembers(State& state, RigidId to, RigidId from) {
  Collection &target = state.collection(to), &source = state.collection(from);
  const Pose relative = state[to].frame().toLocal(state[from].frame());
  for (const BodyId b : source.members) enlist(state, to, b, state.pose(b), state.angle(b));
  writeImpulses(source);
  reserveTightly(target.contacts, target.contacts.size() + source.contacts.size());
  for (InternalContact& inner : source.contacts) {
    dropBlock(source, inner);
    inner.normal = relative.rotation * inner.normal;
    for (InternalPoint& p : inner.points) p.position = relative * p.position;
    target.contacts.push_back(inner);
  }
  admitToProofs(state, target, source.members);
  addShapes(state, to, source.members);
  reserveTightly(target.members, target.members.size() + source.members.size());
  target.members.insert(target.members.end(), source.members.begin(), source.members.end());
  if (source.members.front() < target.members.front()) {  // its name, and all places change
    sortTail(target.members);
    target.laid_out.members = 0;
  }
  if (state[to].floating()) {  // else a layout does
    state.extents[state[to].extent].bounds.include(placed(relative, state.extent(from).bounds));
  }
  state[to].resized = true;
  target.hits = united(target.hits, source.hits);
  target.stale = true;
  removeRigid(state, from);
  freeCollection(state, from);
}

/// Fixes the floating collection to a frame: no mass, and the frame's pose becomes its own.
void fix(State& state, RigidId id, FrameId frame, const Rigid& anchor) {
  Rigid& r = state[id];
  const Pose old = r.frame();
  const double old_angle = r.angle;
  r.anchor = frame;
  r.inv_mass = r.inv_inertia = 0.0;
  r.center = Vec2::Zero();
  r.x = frame == kWorldFrame ? Vec2::Zero() : anchor.x;
  r.rest = frame == kWorldFrame ? Vec2::Zero() : anchor.rest;
  r.angle = frame == kWorldFrame ? 0.0 : anchor.angle;
  r.rotation = frame == kWorldFrame ? Rotation{} : anchor.rotation;
  r.previous_rotation = frame == kWorldFrame ? Rotation{} : anchor.previous_rotation;
  r.v = frame == kWorldFrame ? Vec2::Zero() : anchor.v;
  r.omega = frame == kWorldFrame ? 0.0 : anchor.omega;

  // Re-express members, contacts and shapes in the new frame.
  Collection& c = state.collection(id);
  writeImpulses(c);
  const Pose relative = r.frame().toLocal(old);
  removeShapes(state, id, c.members);
  for (const BodyId b : c.members) {
    const Pose local{state[b].local, state[b].local_rotation};
    enlist(state, id, b, old * local, old_angle + state[b].local_angle);
  }
  for (InternalContact& inner : c.contacts) {
    dropBlock(c, inner);
    inner.normal = relative.rotation * inner.normal;
    for (InternalPoint& p : inner.points) p.position = relative * p.position;
  }
  addShapes(state, id, c.members);
  r.resized = true;
  c.stale = true;
  c.certificate.clear();  // proofs are for loads in the frame
}

}  // namespace

void reserveCollections(State& state, std::size_t more) {
  const std::size_t slots = state.collections.size() + more;
  state.collections.reserve(slots);
  reserveTightly(state.rigids, state.bodies.size() + slots);
  reserveTightly(state.extents, state.extents.size() + more);
  reserveTightly(state.broadphase.shape_trees, state.broadphase.shape_trees.size() + more);
}

RigidId newCollection(State& state) {
  std::size_t slot = state.used_slots;
  while (slot < state.collections.size() && state.collections[slot].id != kNoCollection) ++slot;
  if (slot == state.collections.size()) {
    state.collections.append();
    appendTightly(state.rigids);
    appendTightly(state.extents);
    appendTightly(state.broadphase.shape_trees);
  }
  state.used_slots = slot + 1;
  const RigidId id{static_cast<std::uint32_t>(state.bodies.size() + slot)};
  Collection& c = state.collections[slot];
  c = {};
  c.id = CollectionId{state.next_collection++};
  c.rigid = id;
  state[id] = {};
  // One per collection, after those of the bodies.
  const std::size_t of_bodies = state.extents.size() - state.collections.size();
  state[id].extent = static_cast<std::uint32_t>(of_bodies + slot);
  return id;
}

void takeMotion(State& state, RigidId id, const Rigid& of) {
  Rigid& r = state[id];
  const std::uint32_t extent = r.extent;
  r = of;
  r.extent = extent;
  state.extents[extent] = state.extent(of);
  r.leaf = -1;
}

void freeCollection(State& state, RigidId id) {
  state.collection(id) = {};
  state.used_slots = std::min(state.used_slots, index(id) - state.bodies.size());
  dropShapeTree(state, id);
}

void dropFreeSlots(State& state) {
  std::size_t used = state.collections.size();
  while (used > 0 && state.collections[used - 1].id == kNoCollection) --used;
  const std::size_t gone = state.collections.size() - used;
  const auto shorten = [&](auto& slots) {
    slots.resize(slots.size() - gone);
    if (slots.capacity() - slots.size() > slots.size() / 32) slots.shrink_to_fit();
  };
  state.collections.dropLast(gone);
  state.used_slots = std::min(state.used_slots, used);
  shorten(state.rigids);
  shorten(state.extents);
  shorten(state.broadphase.shape_trees);
  if (gone == 0) return;
  std::erase_if(state.broadphase.near,
                [&](const NearPair& p) { return index(p.b) >= state.rigids.size(); });
}

void addMotion(Rigid& c, const Rigid& b) {
  const double mass = c.mass + b.mass;
  const Vec2 between = (b.x - c.x) + (b.rest - c.rest);
  const Vec2 step = b.mass / mass * between;  // of the centre of mass: Eq. (14)
  const Vec2 r_c = -step, r_b = between - step;
  const double inertia =
      c.inertia + c.mass * r_c.squaredNorm() + b.inertia + b.mass * r_b.squaredNorm();
  c.omega = (c.inertia * c.omega + c.mass * cross(r_c, c.v) + b.inertia * b.omega +
             b.mass * cross(r_b, b.v)) /
            inertia;                           // Eq. (10)
  c.v = (c.mass * c.v + b.mass * b.v) / mass;  // Eq. (11)
  c.center += c.rotation.inverse() * step;
  c.moveBy(step);
  c.mass = mass;        // Eq. (12)
  c.inertia = inertia;  // Eq. (13)
  c.inv_mass = 1.0 / mass;
  c.inv_inertia = 1.0 / inertia;
}

RigidId mergeRigids(State& state, RigidId a, RigidId b) {
  a = asCollection(state, a);
  b = asCollection(state, b);
  // The larger part keeps its id; of equals the older one.
  const auto rank = [&](RigidId id) {
    const Collection& c = state.collection(id);
    return std::pair(-static_cast<std::int64_t>(c.members.size()), value(c.id));
  };
  const RigidId to = rank(a) <= rank(b) ? a : b, from = to == a ? b : a;
  Rigid &target = state[to], &source = state[from];
  if (target.floating() && source.floating()) {
    addMotion(target, source);
  } else if (target.floating()) {
    fix(state, to, source.anchor, source);
    state.collection(to).anchor = state.collection(from).anchor;
  }
  target.stir();
  target.asleep = false;
  absorbMembers(state, to, from);
  return to;
}

RigidId anchorRigid(State& state, RigidId id, BodyId anchor) {
  id = asCollection(state, id);
  if (state[id].floating()) {
    fix(state, id, frameOf(state, anchor), state[rigidOf(anchor)]);
    state.collection(id).anchor = anchor;
    state[id].stir();
  }
  return id;
}

bool isSwept(const State& state, const Collection& c) {
  return c.id != kNoCollection && !state[c.rigid].asleep;
}

FrameId frameOf(const State& state, BodyId body) { return state[rigidOf(body)].anchor; }

namespace {

/// The collection within which two bodies are now, a member and its frame included.
std::optional<RigidId> commonCollection(const State& state, const ContactKey& key) {
  const RigidId ra = state[key.a].rigid, rb = state[key.b].rigid;
  const bool a_in = state.isCollection(ra), b_in = state.isCollection(rb);
  const bool with_frame =
      a_in != b_in && !state[ra].floating() && state[ra].anchor == state[rb].anchor;
  if (ra != rb && !with_frame) return std::nullopt;
  return a_in ? ra : rb;
}

}  // namespace

void absorbContacts(State& state) {
  std::erase_if(state.contacts.idle, [&](const IdlePair& pair) {
    return commonCollection(state, pair.key).has_value();
  });
  dropContacts(state.contacts, [&](const Contact& contact) {
    const std::optional<RigidId> id = commonCollection(state, contact.key);
    if (!id) return false;
    if (contact.count == 0) return true;
    Collection& c = state.collection(*id);
    c.stale = true;

    InternalContact inner;
    inner.key = contact.key;
    inner.count = contact.count;
    inner.since = state.step;
    const Pose from_a = state[*id].frame().toLocal(state.pose(contact.key.a));
    inner.normal = from_a.rotation * contact.normal;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
      const ContactPoint& p = contact.points[i];
      inner.points[i] = {from_a * p.position, p.lambda_n, p.lambda_t};
      inner.gap[i] = p.gap;
      inner.feature[i] = p.feature;
      inner.watch[i].active = p.lambda_n > 0.0 || isHeld(state, contact);
    }
    if (contact.count == 1) inner.points[1].lambda_t = rollingImpulse(state, contact);
    collectionMethod(state).enter(inner);
    reserveTightly(c.contacts, c.contacts.size() + 1);
    c.contacts.push_back(inner);
    return true;
  });
}

void dropBlock(const Collection& c, InternalContact& contact) {
  if (contact.block == InternalContact::kNoBlock) return;
  const ContactBlock& k = c.blocks[contact.block];
  contact.block = InternalContact::kNoBlock;
  for (int i = 0; i < k.count; ++i) {
    contact.point(i).lambda_n = k.lambda_n(i);
    contact.point(i).lambda_t = k.lambda_t(i);
  }
  if (k.count == 1) contact.point(1).lambda_t = k.lambda_r();
}

}  // namespace merge2d
