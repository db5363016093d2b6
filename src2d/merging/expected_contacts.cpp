#include "src2d/merging/expected_contacts.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "src2d/collections/collection.h"
#include "src2d/collections/weld_list.h"
#include "src2d/contact/detection.h"
#include "src2d/contact/parking.h"
#include "src2d/contact/table.h"
#include "src2d/proofs/proof_transfer.h"

namespace merge2d {
namespace {

/// A body with impulses in this step, and how far these can move it against its collection.
struct StruckBody {
  BodyId body{};
  double way = 0.0;  ///< [m]
};

/// All of them, ascending.
using StruckBodies = std::vector<StruckBody>;

StruckBodies struckBodies(const State& state, const Scratch& scratch) {
  StruckBodies struck;
  for (const Kick& kick : scratch.kicks) struck.push_back({kick.body});
  std::ranges::sort(struck, {}, &StruckBody::body);
  const auto isSame = [](const StruckBody& a, const StruckBody& b) { return a.body == b.body; };
  struck.erase(std::unique(struck.begin(), struck.end(), isSame), struck.end());
  for (const Kick& kick : scratch.kicks) {
    const Aabb& bounds = state.extent(rigidOf(kick.body)).bounds;
    const double radius = bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).norm();
    const double moment = cross(kick.at - state.pose(kick.body).position, kick.impulse);
    double& speed = std::ranges::lower_bound(struck, kick.body, {}, &StruckBody::body)->way;
    speed += kick.impulse.norm() / state[kick.body].mass;
    speed += radius * std::abs(moment) / state[kick.body].inertia;
  }
  for (StruckBody& s : struck) s.way *= state.h;
  return struck;
}

double wayOf(const StruckBodies& struck, BodyId body) {
  const auto at = std::ranges::lower_bound(struck, body, {}, &StruckBody::body);
  return at != struck.end() && at->body == body ? at->way : 0.0;
}

/// The collections that bodies with impulses belong to now, ascending.
std::vector<RigidId> struckCollections(const State& state, const Scratch& scratch) {
  std::vector<RigidId> ids;
  for (const Kick& kick : scratch.kicks) {
    if (state.isMember(kick.body)) ids.push_back(state[kick.body].rigid);
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// Detection leaves out pairs within a collection, and pairs that are fixed to one frame.
bool leftOut(const State& state, BodyId a, BodyId b) {
  if (a == b || !state.rigid(b).present() || joined(state, a, b)) return false;
  if (state[a].rigid == state[b].rigid) return true;
  const Rigid &ra = state.rigid(a), &rb = state.rigid(b);
  return !ra.floating() && ra.anchor == rb.anchor;
}

/// Lists the pairs of shapes that impulses can bring together and that are no contact inside a
/// collection yet.
class PairSearch {
 public:
  PairSearch(const State& state, const StruckBodies& struck) : state_(state), struck_(struck) {
    for (const StruckBody& s : struck) {
      if (!state.isMember(s.body)) farthest_frame_ = std::max(farthest_frame_, s.way);
    }
  }

  /// Ascending.
  std::vector<ContactKey> find() {
    for (const StruckBody& s : struck_) {
      if (state_.isMember(s.body)) addNeighbours(s);
    }
    addKnown();
    std::ranges::sort(keys_);
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    return std::move(keys_);
  }

 private:
  /// All pairs that can become contacts are found. A manifold has points only where two shapes are
  /// no farther apart than the margin and the ways of both bodies: then the box of the one, grown
  /// by that, meets the other one, and so its box in any frame; the rounding of boxes is
  /// less than the room of the trees' leaves (geometry/tree.h). Of two members that are struck the
  /// one with the longer way finds the pair, so that twice its own way is far enough; bodies that
  /// are no members search for nobody.
  void addNeighbours(const StruckBody& of) {
    const Body& body = state_[of.body];
    const Rigid& r = state_[body.rigid];
    const double ways = of.way + std::max(of.way, farthest_frame_);
    const double reach = std::max(state_.settings.solver.margin, ways);
    const Pose place{body.local, body.local_rotation};
    for (std::uint32_t s = body.first_shape; s < body.first_shape + body.shape_count; ++s) {
      const Aabb near = placed(place, state_.bounds(s)).grown(reach);
      addNear(s, body.rigid, near);
      if (r.floating()) continue;
      state_.broadphase.tree.query(placed(r.frame(), near), [&](std::uint32_t other) {
        const RigidId id{other};
        if (id == body.rigid || !sameFrame(r, state_[id])) return;
        addNear(s, id, placed(state_[id].frame().toLocal(r.frame()), near));
      });
    }
  }

  /// The shapes of a rigid thing whose boxes meet one in its frame.
  void addNear(std::uint32_t shape, RigidId id, const Aabb& near) {
    const auto add = [&](std::uint32_t other) { addKey(shape, other); };
    if (const auto& tree = state_.broadphase.shape_trees[index(id)]) return tree->query(near, add);
    add(state_.bodies[index(id)].first_shape);
  }

  /// Contacts that the table has between things that are fixed to one frame. Detection leaves them
  /// as they are, also those that are farther apart than the impulses of now reach.
  void addKnown() {
    for (const ContactTable::Slot slot : state_.contacts.order) {
      const ContactKey& key = state_.contacts[slot].key;
      if (isStruckMember(key.a)) addKey(key.shape_a, key.shape_b);
      if (isStruckMember(key.b)) addKey(key.shape_b, key.shape_a);
    }
  }

  bool isStruckMember(BodyId body) const {
    return state_.isMember(body) &&
           std::ranges::binary_search(struck_, body, {}, &StruckBody::body);
  }

  /// A shape of a struck member, and one of another body.
  void addKey(std::uint32_t own, std::uint32_t other) {
    ContactKey key{state_.shape_body[own], state_.shape_body[other], own, other};
    if (!leftOut(state_, key.a, key.b)) return;
    const Collection& c = state_.collection(state_[key.a].rigid);
    if (key.b < key.a) {
      std::swap(key.a, key.b);
      std::swap(key.shape_a, key.shape_b);
    }
    const double way = wayOf(struck_, key.a) + wayOf(struck_, key.b);
    const Pose seen = state_.pose(key.a).toLocal(state_.pose(key.b));
    const Aabb box = placed(seen, state_.bounds(key.shape_b)).grown(way);
    if (!box.overlaps(state_.bounds(key.shape_a)) || isInside(c, key)) return;
    keys_.push_back(key);
  }

  static bool isInside(const Collection& c, const ContactKey& key) {
    const Weld* weld = findWeld(c, key.a, key.b);
    if (!weld) return false;
    const auto run = std::span(c.contacts).subspan(weld->first, weld->count);
    return std::ranges::binary_search(run, key, {}, &InternalContact::key);
  }

  const State& state_;
  const StruckBodies& struck_;
  double farthest_frame_ = 0.0;  ///< the longest way of those that are no members [m]
  std::vector<ContactKey> keys_;
};

}  // namespace

void expectContactsOfStruck(State& state, Scratch& scratch) {
  if (std::ranges::none_of(scratch.kicks, [&](const Kick& k) { return state.isMember(k.body); })) {
    return;
  }
  const StruckBodies struck = struckBodies(state, scratch);
  const std::vector<ContactKey> keys = PairSearch(state, struck).find();
  if (keys.empty()) return;
  std::vector<Contact> found;
  for (const ContactKey& key : keys) {
    const double way = wayOf(struck, key.a) + wayOf(struck, key.b);
    if (const auto* slot = findContact(state.contacts, key)) {
      updateManifold(state, state.contacts[*slot], way);
      continue;
    }
    Contact contact;
    contact.key = key;
    updateManifold(state, contact, way);
    if (contact.count > 0) found.push_back(contact);
  }
  addContacts(state.contacts, found);
  bringBackTouched(state);
  absorbContacts(state);
  for (const RigidId id : struckCollections(state, scratch)) {
    for (InternalContact& inner : state.collection(id).contacts) {
      if (std::ranges::binary_search(keys, inner.key)) inner.since = kExpected;
    }
  }
  layOutCollections(state);
  collectPairs(state, scratch);
}

void forgetExpectedContacts(State& state, const Scratch& scratch) {
  if (scratch.kicks.empty()) return;
  // One end of each was struck, and it is in the collection that this body is in now.
  for (const RigidId id : struckCollections(state, scratch)) {
    Collection& c = state.collection(id);
    const auto expected = [](const InternalContact& inner) { return inner.since == kExpected; };
    if (std::ranges::none_of(c.contacts, expected)) continue;
    c.stale = true;
    c.block_contact.clear();
    std::erase_if(c.contacts, expected);
    releaseFromProofs(state, c);
  }
  layOutFloating(state);
}

}  // namespace merge2d
