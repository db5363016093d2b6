#include <algorithm>
#include <cstring>

#include "api/handles.h"
#include "lessons/why.h"
#include "lessons/words.h"

using merge2d::given;
using merge2d::guarded;

namespace merge2d {
namespace {

m2_body number(BodyId body) { return static_cast<m2_body>(body); }

m2_contact shown(const ContactView& c) {
  return {.a = number(c.a),
          .b = number(c.b),
          .feature = c.feature,
          .state = static_cast<std::uint8_t>(c.state),
          .internal = c.internal,
          .fresh = c.fresh,
          .reserved = 0,
          .x = c.x.x(),
          .y = c.x.y(),
          .nx = c.normal.x(),
          .ny = c.normal.y(),
          .gap = c.gap,
          .lambda_n = c.lambda_n,
          .lambda_t = c.lambda_t,
          .w_n = c.w_n,
          .w_t = c.w_t};
}

/// Their members go behind those of the collections before.
m2_collection shown(const CollectionView& c, std::vector<m2_body>& members) {
  const std::size_t first = members.size();
  for (const BodyId body : c.bodies) members.push_back(number(body));
  return {.id = value(c.id),
          .first = static_cast<std::uint32_t>(first),
          .count = static_cast<std::uint32_t>(c.bodies.size()),
          .anchor = c.anchored ? number(c.anchor) : M2_NO_BODY,
          .asleep = c.asleep,
          .mass = c.mass,
          .inertia = c.inertia,
          .x = c.x.x(),
          .y = c.x.y(),
          .vx = c.v.x(),
          .vy = c.v.y(),
          .omega = c.omega};
}

m2_joint_state shown(const JointView& j) {
  return {.kind = static_cast<std::int32_t>(j.kind),
          .a = number(j.a),
          .b = j.to_world ? M2_NO_BODY : number(j.b),
          .broken = j.broken,
          .internal = j.internal,
          .reserved = 0,
          .ax = j.from.x(),
          .ay = j.from.y(),
          .bx = j.to.x(),
          .by = j.to.y(),
          .fx = j.force.x(),
          .fy = j.force.y(),
          .torque = j.torque};
}

m2_spring_state shown(const SpringView& s) {
  return {.number = s.number,
          .a = number(s.body),
          .b = s.to_world ? M2_NO_BODY : number(s.other),
          .reserved = 0,
          .ax = s.from.x(),
          .ay = s.from.y(),
          .bx = s.to.x(),
          .by = s.to.y(),
          .force = s.force};
}

m2_event shown(const Event& e) {
  return {.type = static_cast<std::int32_t>(e.type),
          .reason = static_cast<std::int32_t>(e.reason),
          .a = number(e.a),
          .b = number(e.b),
          .collection = value(e.collection)};
}

template <std::size_t N>
void write(char (&out)[N], std::string_view word) {
  const std::size_t length = std::min(word.size(), N - 1);
  std::memset(out, 0, N);
  std::memcpy(out, word.data(), length);
}

m2_decision shown(const Decision& d) {
  m2_decision out{.a = number(d.a),
                  .b = number(d.b),
                  .value = d.value,
                  .threshold = d.threshold,
                  .count = d.count,
                  .needed = d.needed,
                  .before = d.before,
                  .reserved = 0,
                  .stage = {},
                  .criterion = {},
                  .equation = {},
                  .verdict = {}};
  write(out.stage, d.stage);
  write(out.criterion, d.criterion);
  write(out.equation, d.equation);
  write(out.verdict, d.verdict);
  return out;
}

template <class From, class To>
void showAll(const std::vector<From>& from, std::vector<To>& to) {
  to.clear();
  for (const From& one : from) to.push_back(shown(one));
}

template <class T>
void hand(const std::vector<T>& list, const T** first, size_t* count) {
  given(count, "count") = list.size();
  given(first, "the array") = list.data();
}

void requireNotes(const m2_world& world) {
  if (world.noted) return;
  throw InputError(
      "the last step did not note its decisions; before it, call m2_world_note_decisions (C) or "
      "noteDecisions (C++), or make the world with decisions=True (Python)");
}

void requireBody(const m2_world& world, m2_body body) {
  const std::size_t count = world.world.bodies().size();
  if (body >= count) {
    throw InputError(fmt::format("there is no body {}: the world has {}", body, count));
  }
}

}  // namespace
}  // namespace merge2d

const WorldRecords& m2_world::seen() {
  if (records.captured) return records;
  world.capture(records.snapshot);
  const merge2d::Snapshot& s = records.snapshot;
  merge2d::showAll(s.contacts, records.contacts);
  merge2d::showAll(s.joints, records.joints);
  merge2d::showAll(s.springs, records.springs);
  merge2d::showAll(s.events, records.events);
  merge2d::showAll(s.decisions, records.decisions);
  records.collections.clear();
  records.members.clear();
  for (const merge2d::CollectionView& c : s.collections) {
    records.collections.push_back(merge2d::shown(c, records.members));
  }
  records.captured = true;
  return records;
}

m2_status m2_world_contacts(m2_world* world, const m2_contact** contacts, size_t* count) {
  return guarded([&] { merge2d::hand(given(world, "world").seen().contacts, contacts, count); });
}

m2_status m2_world_joints(m2_world* world, const m2_joint_state** joints, size_t* count) {
  return guarded([&] { merge2d::hand(given(world, "world").seen().joints, joints, count); });
}

m2_status m2_world_springs(m2_world* world, const m2_spring_state** springs, size_t* count) {
  return guarded([&] { merge2d::hand(given(world, "world").seen().springs, springs, count); });
}

m2_status m2_world_collections(m2_world* world, const m2_collection** collections, size_t* count,
                               const m2_body** members) {
  return guarded([&] {
    const WorldRecords& records = given(world, "world").seen();
    merge2d::hand(records.collections, collections, count);
    if (members != nullptr) *members = records.members.data();
  });
}

m2_status m2_world_events(m2_world* world, const m2_event** events, size_t* count) {
  return guarded([&] {
    m2_world& w = given(world, "world");
    if (!w.records.captured) merge2d::showAll(w.world.events(), w.records.events);
    merge2d::hand(w.records.events, events, count);
  });
}

const char* m2_event_type_name(m2_event_type type) {
  if (type < M2_EVENT_MERGE || type > M2_EVENT_BREAK) return "unknown";
  return merge2d::name(static_cast<merge2d::EventType>(type));
}

const char* m2_reason_name(m2_reason reason) {
  if (reason < M2_REASON_NONE || reason > M2_REASON_USER) return "unknown";
  return merge2d::name(static_cast<merge2d::EventReason>(reason));
}

m2_status m2_world_note_decisions(m2_world* world, bool on) {
  return guarded([&] {
    m2_world& w = given(world, "world");
    w.noting = on;
    w.world.takeNotes(on);
  });
}

m2_status m2_world_decisions(m2_world* world, const m2_decision** decisions, size_t* count) {
  return guarded([&] {
    merge2d::requireNotes(given(world, "world"));
    merge2d::hand(world->seen().decisions, decisions, count);
  });
}

m2_status m2_world_why(m2_world* world, m2_body a, m2_body b, char** text) {
  return guarded([&] {
    m2_world& w = given(world, "world");
    merge2d::requireBody(w, a);
    merge2d::requireBody(w, b);
    if (a == b) throw merge2d::InputError("a body and itself are no pair");
    merge2d::requireNotes(w);
    const merge2d::PairReason reason =
        merge2d::reasonFor(merge2d::Words(w.world.bodies()), w.seen().snapshot, merge2d::BodyId{a},
                           merge2d::BodyId{b});
    std::string words = reason.heading + ": " + reason.text;
    const std::string outlook = merge2d::sentence(reason.condition);
    if (!outlook.empty()) words += " " + outlook;
    given(text, "text") = merge2d::copyOf(words);
  });
}

m2_status m2_world_counts(const m2_world* world, m2_counts* counts) {
  return guarded([&] {
    const merge2d::Stats& s = given(world, "world").world.stats();
    given(counts, "counts") = {.bodies = s.bodies,
                               .active_bodies = s.active_bodies,
                               .collections = s.collections,
                               .asleep = s.asleep,
                               .contacts = s.contacts,
                               .internal_contacts = s.internal_contacts};
  });
}

m2_status m2_world_sums(m2_world* world, m2_sums* sums) {
  return guarded([&] {
    const merge2d::Stats& s = given(world, "world").seen().snapshot.stats;
    given(sums, "sums") = {.residual = s.residual,
                           .max_penetration = s.max_penetration,
                           .kinetic_energy = s.kinetic_energy,
                           .potential_energy = s.potential_energy,
                           .momentum_x = s.momentum.x(),
                           .momentum_y = s.momentum.y(),
                           .angular_momentum = s.angular_momentum};
  });
}
