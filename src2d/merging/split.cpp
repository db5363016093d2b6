/// Taking a collection apart (Section 4, "in reverse").

#include <algorithm>

#include "src2d/contact/broadphase.h"
#include "src2d/contact/detection.h"
#include "src2d/contact/table.h"
#include "src2d/merging/collection.h"

namespace merge2d {
namespace {

/// The members of each part, ascending.
std::vector<std::vector<BodyId>> membersOfParts(const Collection& c,
                                                const std::vector<std::uint32_t>& part,
                                                std::size_t parts) {
  std::vector<std::vector<BodyId>> members(parts);
  for (std::size_t i = 0; i < c.members.size(); ++i) members[part[i]].push_back(c.members[i]);
  return members;
}

/// A member goes its own way, with the velocity that its collection has where it is.
RigidId freeBody(State& state, BodyId b, const Rigid& whole) {
  const Pose pose = state.pose(b);
  const double angle = state.angle(b);
  Rigid& r = state[rigidOf(b)];
  r.x = pose.position;
  r.rest = Vec2::Zero();
  r.angle = angle;
  r.rotation = Rotation::of(angle);
  r.previous_rotation = r.rotation;
  r.v = whole.velocityAt(r);
  r.omega = whole.omega;
  r.quiet_steps = 0;
  r.asleep = false;
  state[b].rigid = rigidOf(b);
  insertRigid(state, rigidOf(b));
  return rigidOf(b);
}

/// What leaves the world's frame gets a frame of its own at one of its bodies: as it turns, the
/// rounding must not depend on how far from the world's origin it was.
void leaveWorldFrame(State& state, RigidId id) {
  Collection& c = state.collection(id);
  const Vec2 offset = state[c.members.front()].local;
  state[id].x += offset;
  for (const BodyId b : c.members) state[b].local -= offset;
  for (InternalContact& inner : c.contacts) {
    dropBlock(c, inner);
    for (InternalPoint& point : inner.points) point.position -= offset;
  }
}

/// Makes a rigid thing that has the whole's frame move as the whole did, floating or anchored.
void inheritMotion(State& state, RigidId id, const Rigid& whole, bool anchored) {
  Rigid& r = state[id];
  if (!anchored) {
    if (r.anchor == kWorldFrame) leaveWorldFrame(state, id);
    r.anchor = kFloating;
  }
  gatherMass(state, id);
  r.v = whole.velocityAt(r);
  r.omega = whole.omega;
}

RigidId newPart(State& state, const std::vector<BodyId>& members,
                std::vector<InternalContact>&& contacts, const Rigid& whole, BodyId anchor,
                bool anchored) {
  const RigidId id = newCollection(state);
  Collection& c = state.collection(id);
  c.members = members;
  c.contacts = std::move(contacts);
  c.anchor = anchor;
  c.stale = true;
  Rigid& r = state[id];
  const std::uint32_t extent = r.extent;
  r = whole;
  r.extent = extent;
  state.extents[extent] = state.extent(whole);
  r.leaf = -1;
  r.quiet_steps = 0;
  r.asleep = false;
  for (const BodyId b : members) state[b].rigid = id;
  inheritMotion(state, id, whole, anchored);
  addShapes(state, id, members);
  insertRigid(state, id);
  return id;
}

/// A contact that leaves a collection.
struct Released {
  InternalContact inner;
  int patience;  ///< steps before its pair may merge again
};

/// The weld that a contact belongs to, when a test of this step found it broken, sliding or moving.
const Weld* cutByTest(const Collection& c, const InternalContact& inner) {
  const auto pair = [](const auto& x) { return std::pair(x.a, x.b); };
  const auto weld = std::ranges::lower_bound(c.welds, pair(inner.key), {}, pair);
  if (weld == c.welds.end() || pair(*weld) != pair(inner.key)) return nullptr;
  return weld->cut && weld->reason != EventReason::User ? &*weld : nullptr;
}

/// What turns as slowly as this seems to be at rest for so many steps.
int stepsUntilSeen(const State& state, const Drift& turning) {
  constexpr double kMost = 200.0;  // steps
  const double seen = state.settings.merging.velocity * turning.steps;
  const double sum = std::abs(turning.sum);
  return std::max(turning.steps, static_cast<int>(std::min(seen / std::max(sum, 1e-12), kMost)));
}

/// How long a pair that parts has to wait.
/// Deviation: a weld that broke soon after it had formed waits for the rest of this time before its
/// contacts are looked at again, or the pair would merge and part in turn while it barely moves.
/// Guarded by Unmerge.AWeldThatBrokeAtOnceDoesNotFormAtOnce. And one that turned slowly waits for
/// as long as it would still seem at rest. Guarded by
/// Seesaw.BarelyOutOfBalanceTipsAsInTheReference.
int patienceAfter(const State& state, const InternalContact& inner, const Weld* cut) {
  constexpr std::int64_t kFlicker = 20;  // steps
  if (state.settings.unmerging.rule == Rule::Paper) return 0;
  const auto rest =
      static_cast<int>(std::max(std::int64_t{0}, kFlicker - (state.step - inner.since)));
  const bool turned = cut && cut->reason == EventReason::RelativeMotion;
  return turned ? std::max(rest, stepsUntilSeen(state, cut->turning)) : rest;
}

/// How far ahead to look for its points again: contacts of what was struck may still be open [m].
double farthestPoint(const InternalContact& inner) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(inner.count); ++i) {
    farthest = std::max(farthest, inner.gap[i]);
  }
  return 1.001 * farthest;
}

/// Contacts between the parts return to the table with their impulses and today's geometry.
void releaseContacts(State& state, const std::vector<Released>& released) {
  std::vector<Contact> contacts;
  for (const auto& [inner, patience] : released) {
    Contact& contact = contacts.emplace_back(inner.released());
    contact.quiet_steps = -patience;
    updateManifold(state, contact, farthestPoint(inner));
  }
  std::ranges::sort(contacts, {}, &Contact::key);
  addContacts(state.contacts, contacts);
}

/// What parted is not remembered, should it come back before the collection is laid out.
void forgetPartedWelds(const State& state, Collection& c, FrameId frame) {
  std::erase_if(c.welds, [&](const Weld& weld) {
    const bool a_in = state[weld.a].rigid == c.rigid, b_in = state[weld.b].rigid == c.rigid;
    const bool on_frame =
        a_in != b_in && frame != kFloating && frameOf(state, a_in ? weld.b : weld.a) == frame;
    return !(a_in && b_in) && !on_frame;
  });
}

}  // namespace

std::vector<RigidId> splitCollection(State& state, RigidId id,
                                     const std::vector<std::uint32_t>& part,
                                     const std::vector<std::uint8_t>& anchored) {
  const Rigid whole = state[id];
  const BodyId anchor = state.collection(id).anchor;
  const auto members = membersOfParts(state.collection(id), part, anchored.size());
  std::size_t largest = 0;
  for (std::size_t p = 1; p < members.size(); ++p) {
    if (members[p].size() > members[largest].size()) largest = p;
  }

  // Contacts first, while membership can still be asked.
  std::vector<std::vector<InternalContact>> kept(members.size());
  std::vector<Released> released;
  {
    Collection& c = state.collection(id);
    std::size_t staying = 0;
    const auto partOf = [&](BodyId b) { return part[state[rigidOf(b)].member]; };
    for (InternalContact& inner : c.contacts) {
      const BodyId a = inner.key.a, b = inner.key.b;
      const bool a_in = state[a].rigid == id, b_in = state[b].rigid == id;
      const std::uint32_t p = partOf(a_in ? a : b), q = partOf(b_in ? b : a);
      const bool on_frame = frameOf(state, a_in ? b : a) == whole.anchor;
      const bool stays = p == q && ((a_in && b_in) || (anchored[p] && on_frame));
      if (stays && p == largest) {
        c.contacts[staying++] = inner;
      } else if (stays) {
        dropBlock(c, inner);
        kept[p].push_back(inner);
      } else {
        dropBlock(c, inner);
        const Weld* cut = cutByTest(c, inner);
        released.push_back({inner, patienceAfter(state, inner, cut)});
        if (cut) ++released.back().inner.vain;
      }
    }
    c.contacts.resize(staying);
  }

  // The other parts leave …
  std::vector<RigidId> result{id};
  for (std::size_t p = 0; p < members.size(); ++p) {
    if (p == largest) continue;
    removeShapes(state, id, members[p]);
    if (members[p].size() == 1 && !anchored[p]) {
      result.push_back(freeBody(state, members[p].front(), whole));
    } else {
      result.push_back(
          newPart(state, members[p], std::move(kept[p]), whole, anchor, anchored[p] != 0));
    }
  }

  // … and the largest stays, unless it is a single body that nothing holds.
  if (members[largest].size() == 1 && !anchored[largest]) {
    removeRigid(state, id);
    result.front() = freeBody(state, members[largest].front(), whole);
    freeCollection(state, id);
  } else {
    Collection& c = state.collection(id);
    c.members = members[largest];
    c.block_contact.clear();
    forgetPartedWelds(state, c, anchored[largest] != 0 ? whole.anchor : kFloating);
    c.stale = true;
    const bool new_frame = whole.anchor == kWorldFrame && !anchored[largest];
    if (new_frame) removeShapes(state, id, c.members);
    inheritMotion(state, id, whole, anchored[largest] != 0);
    if (new_frame) addShapes(state, id, c.members);
    state[id].resized = true;
    state[id].quiet_steps = 0;
  }
  releaseContacts(state, released);
  return result;
}

}  // namespace merge2d
