#include "src2d/merging/expected_contacts.h"

#include <algorithm>
#include <span>

#include "src2d/collections/collection.h"
#include "src2d/collections/weld_list.h"
#include "src2d/contact/detection.h"
#include "src2d/contact/table.h"
#include "src2d/proofs/proof_transfer.h"

namespace merge2d {
namespace {

/// How far the impulses of this step can move a body against its collection [m].
double wayOf(const State& state, const Scratch& scratch, BodyId body) {
  const Aabb& bounds = state.extent(rigidOf(body)).bounds;
  const double radius = bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).norm();
  double speed = 0.0;
  for (const Kick& kick : scratch.kicks) {
    if (kick.body != body) continue;
    const double moment = cross(kick.at - state.pose(body).position, kick.impulse);
    speed += kick.impulse.norm() / state[body].mass;
    speed += radius * std::abs(moment) / state[body].inertia;
  }
  return state.h * speed;
}

/// Detection leaves out pairs within a collection, and pairs that are fixed to one frame.
bool leftOut(const State& state, BodyId a, BodyId b) {
  if (a == b || !state.rigid(b).present() || joined(state, a, b)) return false;
  if (state[a].rigid == state[b].rigid) return true;
  const Rigid &ra = state.rigid(a), &rb = state.rigid(b);
  return !ra.floating() && ra.anchor == rb.anchor;
}

/// The pairs of shapes of two bodies that `way` [m] can bring together and that are no contact yet.
void addKeys(const State& state, BodyId a, BodyId b, double way, std::vector<ContactKey>& keys) {
  const Body &first = state[std::min(a, b)], &second = state[std::max(a, b)];
  const Pose seen = state.pose(std::min(a, b)).toLocal(state.pose(std::max(a, b)));
  const Collection& c = state.collection(state[a].rigid);
  const Weld* weld = findWeld(c, std::min(a, b), std::max(a, b));
  const auto run = weld ? std::span(c.contacts).subspan(weld->first, weld->count)
                        : std::span<const InternalContact>();
  for (std::uint32_t s = first.first_shape; s < first.first_shape + first.shape_count; ++s) {
    for (std::uint32_t t = second.first_shape; t < second.first_shape + second.shape_count; ++t) {
      const ContactKey key{std::min(a, b), std::max(a, b), s, t};
      if (!placed(seen, state.bounds(t)).grown(way).overlaps(state.bounds(s))) continue;
      const bool known = std::ranges::binary_search(run, key, {}, &InternalContact::key);
      if (!known) keys.push_back(key);
    }
  }
}

}  // namespace

void expectContactsOfStruck(State& state, Scratch& scratch) {
  std::vector<ContactKey> keys;
  for (const Kick& kick : scratch.kicks) {
    if (!state.isCollection(state[kick.body].rigid)) continue;
    const double way = wayOf(state, scratch, kick.body);
    for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
      const BodyId other{i};
      if (!leftOut(state, kick.body, other)) continue;
      addKeys(state, kick.body, other, way + wayOf(state, scratch, other), keys);
    }
  }
  if (keys.empty()) return;
  std::ranges::sort(keys);
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::vector<Contact> found;
  for (const ContactKey& key : keys) {
    const double way = wayOf(state, scratch, key.a) + wayOf(state, scratch, key.b);
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
  absorbContacts(state);
  for (Collection& c : state.collections) {
    for (InternalContact& inner : c.contacts) {
      if (std::ranges::binary_search(keys, inner.key)) inner.since = kExpected;
    }
  }
  layOutCollections(state);
  collectPairs(state, scratch);
}

void forgetExpectedContacts(State& state, const Scratch& scratch) {
  if (scratch.kicks.empty()) return;
  for (Collection& c : state.collections) {
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
