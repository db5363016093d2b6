#include "src2d/contact/detection.h"

#include <algorithm>
#include <array>
#include <span>

#include "src2d/contact/approach.h"
#include "src2d/contact/broadphase.h"
#include "src2d/contact/cast.h"
#include "src2d/contact/followed_hits.h"
#include "src2d/contact/hidden_sides.h"
#include "src2d/contact/internal_edges.h"
#include "src2d/contact/parking.h"
#include "src2d/contact/table.h"
#include "src2d/core/memory.h"
#include "src2d/dynamics/thread_memory.h"

namespace merge2d {
namespace {

/// Of b's box, seen from a, to a's box [m].
double boxDistance(const State& state, const ContactKey& key, const Pose& b_in_a) {
  return placed(b_in_a, state.bounds(key.shape_b)).distance(state.bounds(key.shape_a));
}

/// Nearer than this two shapes get a manifold when they can approach by `ahead` in this step [m].
double reach(const State& state, double ahead) {
  return std::max(state.settings.solver.margin, ahead);
}

/// True where two shapes that do not touch cannot meet in this step. `apart` is a lower bound of
/// their distance: it shrinks by the largest motion of all bodies, and is measured again only where
/// the two can approach by more than that.
bool staysApart(const State& state, const Approaches& approaches, const ContactKey& key,
                float& apart) {
  apart -= static_cast<float>(2.0 * state.moved);
  if (apart > reach(state, approaches.farthest())) return true;
  const double near = reach(state, approaches.between(key.a, key.b));
  if (apart > near) return true;
  const Pose b_in_a = state.pose(key.a).toLocal(state.pose(key.b));
  apart = static_cast<float>(boxDistance(state, key, b_in_a));
  return apart > near;
}

/// Hands on what is remembered of a point, or marks it as new. `inv_mass` is the larger of the two.
void inherit(ContactPoint& point, std::span<const ContactPoint> old, double inv_mass) {
  constexpr double kRounding = 1e-9;  // m/s: the body came as near as this in its last free step
  for (const ContactPoint& before : old) {
    if (before.feature != point.feature) continue;
    point.breath = static_cast<float>(point.gap - before.gap);
    point.lambda_n = before.lambda_n;
    point.lambda_t = before.lambda_t;
    point.w_n = before.w_n;
    point.w_t = before.w_t;
    point.fresh = before.lambda_n * inv_mass <= kRounding;
    return;
  }
  point.fresh = true;
}

/// Keeps the points of a pair that bear; those that go are noted when somebody asks.
void prune(State& state, const BodyPair& pair, PruneMemory& memory, Notes* notes) {
  const Pose frame = state.pose(pair.a);
  const auto points = [&] {
    std::vector<Vec2> all;
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      const Contact& contact = state.contacts[state.contacts.order[i]];
      for (int k = 0; k < contact.count; ++k) {
        all.push_back(frame * contact.points[static_cast<std::size_t>(k)].position);
      }
    }
    return all;
  };
  const std::vector<Vec2> found = notes ? points() : std::vector<Vec2>{};
  prunePair(state.contacts, pair, memory);
  if (!notes) return;
  const std::vector<Vec2> kept = points();
  for (const Vec2& x : found) {
    if (std::find(kept.begin(), kept.end(), x) != kept.end()) continue;
    notes->pruned.push_back({.a = pair.a, .b = pair.b, .x = x});
  }
}

/// Between two things at rest nothing changes, and so nothing breathes.
void holdBreath(Contact& contact) {
  for (ContactPoint& point : contact.points) point.breath = 0.0F;
}

bool resting(const Rigid& r) { return r.asleep || r.anchor == kWorldFrame; }

constexpr std::size_t kGrain = 64;  ///< contacts or pairs that one task looks at
constexpr double kDone = -1.0;      ///< instead of the way ahead: nothing is left to do

/// The manifold of now. Returns how far the two can come nearer in this step, if they are to be
/// followed to where they meet [m]; else kDone.
double findManifold(const State& state, const Approaches& approaches, Contact& contact) {
  const double ahead = approaches.between(contact.key.a, contact.key.b);
  updateManifold(state, contact, ahead);
  return contact.count > 0 ? ahead : kDone;
}

/// The same for a contact that there is.
double followContact(const State& state, const Approaches& approaches, Contact& contact) {
  const ContactKey& key = contact.key;
  const Rigid &a = state.rigid(key.a), &b = state.rigid(key.b);
  const bool fixed = resting(a) && resting(b);
  if (fixed) holdBreath(contact);
  if (fixed || (contact.count == 0 && sameFrame(a, b))) return kDone;
  return findManifold(state, approaches, contact);
}

/// Follows the contacts that there are. Casts share a list, and are few.
void followContacts(State& state, Scratch& scratch, const Approaches& approaches,
                    std::vector<SoftHit>& soft) {
  const auto& order = state.contacts.order;
  const auto cast = [&](Contact& contact, double ahead) {
    if (ahead != kDone) castContact(state, scratch, contact, ahead, soft);
  };
  if (!scratch.tasks) {
    for (const ContactTable::Slot slot : order) {
      Contact& contact = state.contacts[slot];
      cast(contact, followContact(state, approaches, contact));
    }
    return;
  }
  scratch.ahead.resize(order.size());
  forEachIndex(scratch.tasks, order.size(), kGrain, [&](std::size_t i, int) {
    scratch.ahead[i] = followContact(state, approaches, state.contacts[order[i]]);
  });
  for (std::size_t i = 0; i < order.size(); ++i) cast(state.contacts[order[i]], scratch.ahead[i]);
}

/// The manifold of an idle pair, if it may touch now; else the contact has no points.
Contact lookAt(const State& state, const Approaches& approaches, IdlePair& pair) {
  Contact contact;
  contact.key = pair.key;
  const Rigid &a = state.rigid(pair.key.a), &b = state.rigid(pair.key.b);
  if ((resting(a) && resting(b)) || sameFrame(a, b)) {
    pair.apart = 0.0F;  // earlier motion does not count from here on
  } else if (!staysApart(state, approaches, pair.key, pair.apart)) {
    findManifold(state, approaches, contact);
  }
  return contact;
}

/// Follows an idle pair that may touch now to where it meets.
void castIdle(const State& state, Scratch& scratch, const Approaches& approaches, IdlePair& pair,
              Contact& contact, std::vector<SoftHit>& soft) {
  castContact(state, scratch, contact, approaches.between(pair.key.a, pair.key.b), soft);
  if (contact.count > 0) scratch.touching.push_back(contact);
}

/// Finds the idle pairs that touch now.
void findTouching(State& state, Scratch& scratch, const Approaches& approaches,
                  std::vector<SoftHit>& soft) {
  scratch.touching.clear();
  auto& idle = state.contacts.idle;
  if (scratch.tasks) {
    scratch.found.resize(std::max(scratch.found.size(), idle.size() / kGrain + 1));
    forEachIndex(scratch.tasks, idle.size(), kGrain, [&](std::size_t i, int) {
      const Contact contact = lookAt(state, approaches, idle[i]);
      if (contact.count == 0) return;
      scratch.found[i / kGrain].touching.emplace_back(static_cast<std::uint32_t>(i), contact);
    });
    for (FoundByTask& found : scratch.found) {
      for (auto& [i, contact] : found.touching)
        castIdle(state, scratch, approaches, idle[i], contact, soft);
      found.touching.clear();
    }
  } else {
    for (IdlePair& pair : idle) {
      Contact contact = lookAt(state, approaches, pair);
      if (contact.count > 0) castIdle(state, scratch, approaches, pair, contact, soft);
    }
  }
  addContacts(state.contacts, scratch.touching);
  releaseMany(scratch.touching);
}

constexpr double kWholeFace = 1e9;  ///< both ends of a face, wherever the farther one is [m]

/// A magnet that touches one end of a face draws all of it: by one end alone the body would hang as
/// from a pivot. Guarded by Magnet.DrawsAFaceFlatThatItTouchesAtOneEnd.
bool isHeldAtOneEnd(const State& state, const ContactKey& key, const Manifold& manifold) {
  return manifold.count == 1 && manifold.points[0].gap <= state.settings.solver.margin &&
         isBilateral(state, key.a, key.b);
}

}  // namespace

void updateManifold(const State& state, Contact& contact, double ahead) {
  const Pose b_in_a = state.pose(contact.key.a).toLocal(state.pose(contact.key.b));
  const double margin = reach(state, ahead);
  if (boxDistance(state, contact.key, b_in_a) > margin) return contact.loseTouch();
  const Collider& a = state.collider(contact.key.shape_a);
  const Collider& b = state.collider(contact.key.shape_b);
  Manifold manifold = collide(a, b, b_in_a, margin, &contact.faces);
  if (isHeldAtOneEnd(state, contact.key, manifold)) manifold = collide(a, b, b_in_a, kWholeFace);
  const std::array<ContactPoint, 2> points = contact.points;
  const std::span old(points.data(), static_cast<std::size_t>(contact.count));
  const double inv_mass =
      std::max(state.rigid(contact.key.a).inv_mass, state.rigid(contact.key.b).inv_mass);
  contact.count = static_cast<std::int16_t>(manifold.count);
  contact.normal = manifold.normal;
  for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
    ContactPoint point;
    point.position = manifold.points[i].position;
    point.gap = manifold.points[i].gap;
    point.feature = manifold.points[i].feature;
    inherit(point, old, inv_mass);
    contact.points[i] = point;
  }
  dropInternalEdges(state, b_in_a, contact);
  if (contact.count == 0) contact.quiet_steps = 0;
}

void collectPairs(const State& state, Scratch& scratch) {
  const auto& order = state.contacts.order;
  scratch.pairs.clear();
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const Contact& contact = state.contacts[order[i]];
    if (contact.count == 0) continue;
    const bool same = !scratch.pairs.empty() && scratch.pairs.back().a == contact.key.a &&
                      scratch.pairs.back().b == contact.key.b;
    if (!same) {
      appendTightly(scratch.pairs);
      scratch.pairs.back() = {contact.key.a, contact.key.b, i, 0};
    }
    scratch.pairs.back().count = i + 1 - scratch.pairs.back().first;
  }
}

void settleContacts(State& state, Scratch& scratch) {
  retireContacts(state.contacts, Upkeep::Now);
  compactContacts(state.contacts, Upkeep::Now);
  collectPairs(state, scratch);
}

void detectContacts(State& state, Scratch& scratch) {
  orderKicks(state, scratch);
  scratch.load_order.clear();
  scratch.casts.clear();
  const Approaches approaches(state, scratch);
  updateBroadphase(state, scratch, approaches);
  std::vector<SoftHit> soft;  // none in most steps
  followContacts(state, scratch, approaches, soft);
  findTouching(state, scratch, approaches, soft);
  bringBackTouched(state);
  followSoftHits(state, scratch, soft);
  sortCasts(scratch);
  dropHiddenSides(state, scratch);
  retireContacts(state.contacts);
  collectPairs(state, scratch);
  TaskPool* const tasks = scratch.notes ? nullptr : scratch.tasks;
  scratch.pruning.resize(static_cast<std::size_t>(threadsOf(scratch)));
  forEachIndex(tasks, scratch.pairs.size(), kGrain, [&](std::size_t i, int thread) {
    PruneMemory& memory = scratch.pruning[static_cast<std::size_t>(thread)];
    if (scratch.pairs[i].count > 1) prune(state, scratch.pairs[i], memory, scratch.notes);
  });
}

}  // namespace merge2d
