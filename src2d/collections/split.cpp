/// Taking a collection apart (Section 4, "in reverse").

#include <algorithm>

#include "src2d/collections/collection.h"
#include "src2d/collections/collection_method.h"
#include "src2d/collections/weld_list.h"
#include "src2d/contact/broadphase.h"
#include "src2d/contact/detection.h"
#include "src2d/contact/table.h"
#include "src2d/core/sorted_tail.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/proofs/proof_transfer.h"

namespace merge2d {
namespace {

/// The members of each part, ascending.
std::vector<std::vector<BodyId>> membersOfParts(const Collection& c,
                                                const std::vector<std::uint32_t>& part,
                                                std::size_t parts) {
  std::vector<std::vector<BodyId>> members(parts);
  for (std::size_t i = 0; i < c.members.size(); ++i) members[part[i]].push_back(c.members[i]);
  for (std::vector<BodyId>& of : members) sortTail(of);
  return members;
}

/// Makes a member a free body, with the velocity that its collection has there.
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
  r.stir();
  r.asleep = false;
  state[b].rigid = rigidOf(b);
  insertRigid(state, rigidOf(b));
  return rigidOf(b);
}

/// A part that leaves the world's frame gets a frame of its own at one of its bodies: as it turns,
/// the rounding must not depend on how far from the world's origin it was.
void leaveWorldFrame(State& state, RigidId id) {
  Collection& c = state.collection(id);
  const Vec2 offset = state[c.members.front()].local;
  state[id].x += offset;
  for (const BodyId b : c.members) state[b].local -= offset;
  c.certificate.clear();  // proofs are for loads in the frame
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
  takeMotion(state, id, whole);
  state[id].stir();
  state[id].asleep = false;
  for (const BodyId b : members) state[b].rigid = id;
  inheritMotion(state, id, whole, anchored);
  addShapes(state, id, members);
  insertRigid(state, id);
  return id;
}

/// A contact that leaves a collection.
struct Released {
  InternalContact inner;
  int patience;   ///< steps before its pair may merge again
  float parting;  ///< as Contact::parting
};

/// The weld that a contact belongs to, when a test of this step found it broken, sliding or moving.
const Weld* cutByTest(const Collection& c, const InternalContact& inner) {
  const Weld* weld = findWeld(c, inner.key.a, inner.key.b);
  return weld && weld->cut && weld->reason != EventReason::User ? weld : nullptr;
}

/// How far ahead to look for its points again: contacts of a struck body may still be open [m].
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
  for (const auto& [inner, patience, parting] : released) {
    Contact& contact = contacts.emplace_back(inner.released());
    contact.quiet_steps = static_cast<std::int16_t>(-patience);
    contact.parting = parting;
    updateManifold(state, contact, farthestPoint(inner));
  }
  std::ranges::sort(contacts, {}, &Contact::key);
  addContacts(state.contacts, contacts);
}

/// Forgets the welds of pairs that parted, should they come back before the next layout.
void forgetPartedWelds(const State& state, Collection& c, FrameId frame) {
  std::erase_if(c.welds, [&](const Weld& weld) {
    const bool a_in = state[weld.a].rigid == c.rigid, b_in = state[weld.b].rigid == c.rigid;
    const bool on_frame =
        a_in != b_in && frame != kFloating && frameOf(state, a_in ? weld.b : weld.a) == frame;
    return !(a_in && b_in) && !on_frame;
  });
  c.laid_out.sorted_welds = static_cast<std::uint32_t>(c.welds.size());
}

/// One collection that comes apart. `part` gives each member's part, `anchored` which parts stay
/// fixed to its frame. The largest part keeps the collection's place.
class Split {
 public:
  Split(State& state, RigidId id, const std::vector<std::uint32_t>& part,
        const std::vector<std::uint8_t>& anchored)
      : state_(state),
        id_(id),
        part_(part),
        anchored_(anchored),
        whole_(state[id]),
        anchor_(state.collection(id).anchor),
        last_blow_(state.collection(id).hits.blow),
        members_(membersOfParts(state.collection(id), part, anchored.size())),
        kept_(members_.size()) {
    for (std::size_t p = 1; p < members_.size(); ++p) {
      if (members_[p].size() > members_[largest_].size()) largest_ = p;
    }
  }

  std::vector<RigidId> run() {
    sortContacts();
    std::vector<RigidId> result{id_};
    for (std::size_t p = 0; p < members_.size(); ++p) {
      if (p != largest_) result.push_back(leave(p));
    }
    if (isFreeBody(largest_)) {
      removeRigid(state_, id_);
      result.front() = freeBody(state_, members_[largest_].front(), whole_);
      freeCollection(state_, id_);
    } else {
      stay();
    }
    releaseContacts(state_, released_);
    return result;
  }

 private:
  static constexpr std::size_t kNowhere = ~std::size_t{0};

  /// A single body that nothing holds.
  bool isFreeBody(std::size_t p) const { return members_[p].size() == 1 && !anchored_[p]; }

  /// The part inside which a contact stays, or kNowhere.
  std::size_t partOf(const ContactKey& key) const {
    const bool a_in = state_[key.a].rigid == id_, b_in = state_[key.b].rigid == id_;
    const auto of = [&](BodyId b) { return part_[state_[rigidOf(b)].member]; };
    const std::uint32_t p = of(a_in ? key.a : key.b), q = of(b_in ? key.b : key.a);
    const bool on_frame = frameOf(state_, a_in ? key.b : key.a) == whole_.anchor;
    const bool stays = p == q && ((a_in && b_in) || (anchored_[p] && on_frame));
    return stays ? p : kNowhere;
  }

  /// Which contacts stay, go with a part, or come free: while membership can still be asked.
  void sortContacts() {
    Collection& c = state_.collection(id_);
    if (!c.certificate.empty()) bringBlocksBack(state_, c), writeImpulses(c);
    sortWelds(c);
    std::size_t staying = 0;
    for (InternalContact& inner : c.contacts) {
      const std::size_t p = partOf(inner.key);
      if (p == largest_) {
        c.contacts[staying++] = inner;
        continue;
      }
      dropBlock(c, inner);
      if (p != kNowhere) {
        kept_[p].push_back(inner);
        continue;
      }
      const Weld* cut = cutByTest(c, inner);
      released_.push_back(
          {inner, collectionMethod(state_).waitAfterSplit(state_, cut), cut ? cut->motion : 0.0F});
    }
    c.contacts.resize(staying);
    releaseFromProofs(state_, c);
  }

  RigidId leave(std::size_t p) {
    removeShapes(state_, id_, members_[p]);
    if (isFreeBody(p)) return freeBody(state_, members_[p].front(), whole_);
    const RigidId id =
        newPart(state_, members_[p], std::move(kept_[p]), whole_, anchor_, anchored_[p] != 0);
    // The hit has cut its movers already: the part is shaken, but no longer hit, and its run of
    // hits begins anew.
    state_.collection(id).hits.blow = std::min(last_blow_, state_.step - hitSteps(state_));
    return id;
  }

  /// The largest part goes on as the collection.
  void stay() {
    const bool anchored = anchored_[largest_] != 0;
    Collection& c = state_.collection(id_);
    c.members = members_[largest_];
    c.block_contact.clear();
    forgetPartedWelds(state_, c, anchored ? whole_.anchor : kFloating);
    c.stale = true;
    const bool new_frame = whole_.anchor == kWorldFrame && !anchored;
    if (new_frame) removeShapes(state_, id_, c.members);
    inheritMotion(state_, id_, whole_, anchored);
    if (new_frame) addShapes(state_, id_, c.members);
    state_[id_].resized = true;
    state_[id_].stir();
  }

  State& state_;
  RigidId id_;
  const std::vector<std::uint32_t>& part_;
  const std::vector<std::uint8_t>& anchored_;
  Rigid whole_;    ///< as it was
  BodyId anchor_;  ///< its own
  std::int64_t last_blow_;
  std::vector<std::vector<BodyId>> members_;  ///< of each part
  std::size_t largest_ = 0;
  std::vector<std::vector<InternalContact>> kept_;  ///< contacts that go with each part
  std::vector<Released> released_;
};

}  // namespace

std::vector<RigidId> splitCollection(State& state, RigidId id,
                                     const std::vector<std::uint32_t>& part,
                                     const std::vector<std::uint8_t>& anchored) {
  return Split(state, id, part, anchored).run();
}

}  // namespace merge2d
