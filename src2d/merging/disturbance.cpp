#include "src2d/merging/disturbance.h"

#include <algorithm>
#include <cmath>

#include "src2d/core/memory.h"
#include "src2d/dynamics/casts.h"
#include "src2d/dynamics/hit_rows.h"
#include "src2d/merging/expected_contacts.h"
#include "src2d/proofs/decided_settings.h"

namespace merge2d {
namespace {

/// A slower approach is no meeting [m/s].
constexpr double kGentle = 1e-3;

/// An upper bound of the speeds at the points of a contact of two bodies on their own [m/s]: most
/// contacts rest, and need no look at where their points are.
double speedBound(const Rigid& a, const Rigid& b, const Contact& contact) {
  const auto size = [](const Vec2& v) { return std::abs(v.x()) + std::abs(v.y()); };
  double arm = 0.0;
  for (int i = 0; i < contact.count; ++i) {
    arm = std::max(arm, size(contact.points[static_cast<std::size_t>(i)].position));
  }
  const double from_a = arm + size(a.rest), from_b = arm + size(b.x - a.x) + size(b.rest);
  return size(b.v - a.v) + std::abs(a.omega) * from_a + std::abs(b.omega) * from_b;
}

/// Surely below the closing speed that `closingSpeed` asks for.
bool isSlow(const State& state, const Contact& contact, double impact) {
  constexpr double kRounding = 1e-9;
  if (state.isMember(contact.key.a)) return false;  // its points are seen from a
  bool fresh = false;
  for (int i = 0; i < contact.count; ++i) {
    fresh |= contact.points[static_cast<std::size_t>(i)].fresh;
  }
  const double bound = speedBound(state.rigid(contact.key.a), state.rigid(contact.key.b), contact);
  return bound < (1.0 - kRounding) * (fresh ? std::min(kGentle, impact) : impact);
}

/// Two bodies that pass each other by (contact/cast.h).
bool isMiss(const Scratch& scratch, const Contact& contact) {
  const Cast* cast = castOf(scratch, contact);
  return cast && !cast->hit;
}

/// The speed of approach at a contact that was open in the last step and closes in this one,
/// however late; or that slowed its bodies down then and is hit with the rest of their speed now
/// [m/s]; 0 for any other.
double closingSpeed(const State& state, const Scratch& scratch, const Contact& contact,
                    double impact) {
  if (isSlow(state, contact, impact) || isMiss(scratch, contact)) return 0.0;
  const Rigid &a = state.rigid(contact.key.a), &b = state.rigid(contact.key.b);
  if (sameFrame(a, b)) return 0.0;
  const Pose pose_a = state.pose(contact.key.a);
  const Vec2 n = pose_a.rotation * contact.normal;
  double fastest = 0.0;
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    const CastEnd* end = castOf(scratch, contact, point);
    const Vec2 on_a = pose_a * point.position;
    const Vec2 on_b = end ? state.pose(contact.key.b) * end->on_b : on_a;
    const double w_n = n.dot(b.velocityAt(on_b) - a.velocityAt(on_a));
    const double gap = end ? end->carried : point.gap;
    const double closing = -w_n - std::max(0.0, gap) / state.h;
    const bool meets =
        point.fresh ? -w_n > kGentle && closing > kEndOfStep * -w_n : closing > impact;
    if (!meets) continue;
    fastest = std::max(fastest, -w_n);
  }
  return fastest;
}

/// Lists the contacts that close anew.
void findMeetings(const State& state, Scratch& scratch) {
  scratch.meetings.clear();
  const double impact = impactSpeed(state);
  for (std::uint32_t p = 0; p < scratch.pairs.size(); ++p) {
    const BodyPair& pair = scratch.pairs[p];
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      const double speed =
          closingSpeed(state, scratch, state.contacts[state.contacts.order[i]], impact);
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

/// Two bodies that meet no faster than by gravity alone.
Criterion meetGently(const State& state, double speed) {
  const double most = impactSpeed(state);
  return {"impact", kOwnDecided, speed, most, speed <= most};
}

/// An event for each pair that touched nowhere in the last step and hits in this one.
void reportImpacts(const State& state, Scratch& scratch) {
  forEachPairThatMeets(scratch, [&](const BodyPair& pair, double speed) {
    if (touched(state, pair)) return;
    const Criterion gentle = meetGently(state, speed);
    if (!gentle.holds) scratch.events.push_back({EventType::Impact, pair.a, pair.b});
    if (!scratch.notes) return;
    scratch.notes->decisions.push_back(
        record(gentle, "ContactOrdering", pair.a, pair.b, gentle.holds ? "touch" : "impact"));
  });
}

}  // namespace

void orderContacts(State& state, Scratch& scratch) {
  expectContactsOfStruck(state, scratch);
  findMeetings(state, scratch);
  reportImpacts(state, scratch);
  scratch.seeds.clear();
  if (!state.settings.unmerging.ordering) return;
  const auto seed = [&](BodyId b) { scratch.seeds.push_back(static_cast<std::uint32_t>(b)); };
  for (const Kick& kick : scratch.kicks) seed(kick.body);
  for (const BodyId b : scratch.stirred) seed(b);
  forEachPairThatMeets(scratch, [&](const BodyPair& pair, double) {
    seed(pair.a);
    seed(pair.b);
  });
  trim(scratch.seeds);  // in a first step they are many
  if (scratch.notes) {
    for (const std::uint32_t s : scratch.seeds) scratch.notes->seeds.push_back(BodyId{s});
  }
}

}  // namespace merge2d
