#include "src2d/merging/disturbance.h"

#include <algorithm>

#include "src2d/core/memory.h"
#include "src2d/merging/kicked.h"
#include "src2d/merging/sweep.h"

namespace merge2d {
namespace {

/// A contact that closes slower than this is no meeting [m/s].
constexpr double kGentle = 1e-3;

/// The closing speed of a contact that was open in the last step and closes in this one, or that
/// slowed its bodies down then and is hit with the rest of their speed now [m/s]; 0 for any other.
double closingSpeed(const State& state, const Contact& contact) {
  const Rigid &a = state.rigid(contact.key.a), &b = state.rigid(contact.key.b);
  if (sameFrame(a, b)) return 0.0;
  const Pose pose_a = state.pose(contact.key.a);
  const Vec2 n = pose_a.rotation * contact.normal;
  double fastest = 0.0;
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    const Vec2 p = pose_a * point.position;
    const double w_n = n.dot(b.velocityAt(p) - a.velocityAt(p));
    const double closing = -w_n - std::max(0.0, point.gap) / state.h;
    if (closing <= (point.fresh ? kGentle : impactSpeed(state))) continue;
    fastest = std::max(fastest, -w_n);
  }
  return fastest;
}

/// True when the acceleration of the frame has changed by more than a hundredth of gravity since
/// the last step: then one sweep cannot follow the load.
bool frameJumps(const State& state, Collection& c) {
  constexpr double kPart = 1e-2;
  const Rigid& r = state[c.rigid];
  const bool scripted = !r.floating() && r.anchor != kWorldFrame;
  const Vec2 v = scripted ? state[rigidOf(c.anchor)].v : r.v;
  const Vec2 gain = v - c.frame_v;
  const double jump = (gain - c.frame_gain).norm();
  const bool known = c.frame_known >= 2;
  c.frame_v = v;
  c.frame_gain = gain;
  if (!known) ++c.frame_known;
  return known && jump > kPart * state.h * std::max(state.gravity.norm(), 1.0);
}

/// Lists the contacts that close anew.
void findMeetings(const State& state, Scratch& scratch) {
  scratch.meetings.clear();
  for (std::uint32_t p = 0; p < scratch.pairs.size(); ++p) {
    const BodyPair& pair = scratch.pairs[p];
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      const double speed = closingSpeed(state, state.contacts[state.contacts.order[i]]);
      if (speed > 0.0) scratch.meetings.push_back({p, i, speed});
    }
  }
  trim(scratch.meetings);  // in a first step they are many
}

/// Each pair that meets, with the speed of its fastest contact.
template <class Visit>
void forEachPairThatMeets(const Scratch& scratch, Visit&& visit) {
  const auto& meetings = scratch.meetings;
  for (auto m = meetings.begin(); m != meetings.end();) {
    const std::uint32_t pair = m->pair;
    double fastest = 0.0;
    for (; m != meetings.end() && m->pair == pair; ++m) fastest = std::max(fastest, m->speed);
    visit(scratch.pairs[pair], fastest);
  }
}

/// Whether a pair was in contact in the last step already.
bool touched(const State& state, const BodyPair& pair) {
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    for (int k = 0; k < contact.count; ++k) {
      if (!contact.points[static_cast<std::size_t>(k)].fresh) return true;
    }
  }
  return false;
}

/// An event for each pair that touched nowhere in the last step and hits in this one.
void reportImpacts(const State& state, Scratch& scratch) {
  const double threshold = impactSpeed(state);
  forEachPairThatMeets(scratch, [&](const BodyPair& pair, double speed) {
    if (touched(state, pair)) return;
    const bool hits = speed > threshold;
    if (hits) scratch.events.push_back({EventType::Impact, pair.a, pair.b});
    if (!scratch.notes) return;
    scratch.notes->decisions.push_back({.a = pair.a,
                                        .b = pair.b,
                                        .stage = "ContactOrdering",
                                        .criterion = "impact",
                                        .equation = "Section 6.2",
                                        .value = speed,
                                        .threshold = threshold,
                                        .verdict = hits ? "impact" : "touch"});
  });
}

void ageJolts(State& state) {
  for (Collection& c : state.collections) {
    if (c.jolted == 0) continue;
    --c.jolted;
    for (const BodyId b : c.members) {
      std::uint8_t& left = state[b].jolted;
      left = static_cast<std::uint8_t>(left - (left > 0));
    }
  }
}

void jolt(State& state, BodyId b) {
  const RigidId id = state[b].rigid;
  if (state.isCollection(id)) state.collection(id).jolted = state[b].jolted = kFollowed;
}

}  // namespace

double impactSpeed(const State& state) {
  return std::max(2.0 * state.h * state.gravity.norm(), state.settings.unmerging.velocity);
}

double joltVelocity(const State& state) {
  constexpr double kMuch = 5.0;
  return kMuch * state.settings.unmerging.sliding;
}

void noteJolt(State& state, std::uint32_t body, double change) {
  const double much = joltVelocity(state);
  if (change > much * much && body < state.bodies.size()) jolt(state, BodyId{body});
}

bool isJolted(const State& state, const Collection& c) {
  constexpr std::ptrdiff_t kPart = 4;
  if (c.jolted == 0) return false;
  const auto jolted =
      std::ranges::count_if(c.members, [&](BodyId b) { return state[b].jolted > 0; });
  return kPart * jolted >= std::ssize(c.members);
}

void orderContacts(State& state, Scratch& scratch) {
  expectContactsOfKicked(state, scratch);
  findMeetings(state, scratch);
  reportImpacts(state, scratch);
  scratch.seeds.clear();
  scratch.disturbed.assign(state.collections.size(), 0);
  ageJolts(state);
  if (!state.settings.unmerging.ordering) return;
  enum class Entry { Stir, Touch, Hit };
  const auto seed = [&](BodyId b, Entry entry) {
    scratch.seeds.push_back(static_cast<std::uint32_t>(b));
    const RigidId id = state[b].rigid;
    if (!state.isCollection(id)) return;
    scratch.disturbed[index(id) - state.bodies.size()] = 1;
    jolt(state, b);
    Collection& c = state.collection(id);
    if (entry == Entry::Stir) c.stirred = kFollowed;
    if (entry == Entry::Touch) c.struck = std::max<std::int16_t>(c.struck, kFollowed - 1);
    if (entry == Entry::Hit) c.struck = kFollowed;
  };
  for (Collection& c : state.collections) {
    if (c.struck > 0) --c.struck;
    if (c.stirred > 0) --c.stirred;
    if (isSwept(state, c) && frameJumps(state, c)) {
      scratch.disturbed[index(c.rigid) - state.bodies.size()] = 1;
    }
  }
  for (const Kick& kick : scratch.kicks) seed(kick.body, Entry::Hit);
  for (const BodyId b : scratch.stirred) seed(b, Entry::Stir);
  forEachPairThatMeets(scratch, [&](const BodyPair& pair, double speed) {
    const Entry entry = speed > impactSpeed(state) ? Entry::Hit : Entry::Touch;
    for (const BodyId b : {pair.a, pair.b}) seed(b, entry);
  });
  trim(scratch.seeds);  // as above
  if (scratch.notes) {
    for (const std::uint32_t s : scratch.seeds) scratch.notes->seeds.push_back(BodyId{s});
  }
}

void spreadDisturbance(const State& state, Scratch& scratch) {
  constexpr std::uint32_t kOutside = ~0U;
  const auto slotOf = [&](std::uint32_t b) {
    if (b >= state.bodies.size()) return kOutside;  // the world
    const RigidId id = state.bodies[b].rigid;
    return state.isCollection(id) ? static_cast<std::uint32_t>(index(id) - state.bodies.size())
                                  : kOutside;
  };
  DisjointSets together;
  together.reset(state.collections.size());
  const auto unite = [&](std::uint32_t body_a, std::uint32_t body_b) {
    const std::uint32_t a = slotOf(body_a), b = slotOf(body_b);
    if (a != kOutside && b != kOutside) together.unite(a, b);
  };
  for (const SweepContact& outer : scratch.sweep_contacts) unite(outer.block.a, outer.block.b);
  for (const JointBlock& k : scratch.sweep_joints) unite(k.a, k.b);
  auto& disturbed = scratch.disturbed;
  for (std::uint32_t slot = 0; slot < disturbed.size(); ++slot) {
    if (disturbed[slot]) disturbed[together.find(slot)] = 1;
  }
  for (std::uint32_t slot = 0; slot < disturbed.size(); ++slot) {
    disturbed[slot] = disturbed[together.find(slot)];
  }
}

}  // namespace merge2d
