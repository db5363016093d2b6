#include "lessons/step_text.h"

#include <algorithm>
#include <utility>

#include "lessons/ledger.h"
#include "lessons/snapshot_feed.h"
#include "lessons/tables.h"
#include "src2d/trace/json_text.h"

namespace merge2d {
namespace {

/// One step as a recording, so that prepared and live runs are judged and kept alike.
Recording recordingOf(const Snapshot& seen, const std::vector<BodyInfo>& bodies) {
  Recording out;
  out.bodies = bodies;
  SnapshotFeed(out).add(seen);
  return out;
}

void writeBodies(JsonText& out, const Recording& r) {
  out.key("bodies").open('[');
  for (std::size_t i = 0; i < r.tracks.size(); ++i) {
    const BodyTrack& t = r.tracks[i];
    if (t.x.empty()) continue;
    out.row(i, t.x[0], t.y[0], t.angle[0], t.vx[0], t.vy[0], t.omega[0], t.collection[0],
            static_cast<int>(t.asleep[0]));
  }
  out.close(']');
}

void writeContacts(JsonText& out, const Recording& r) {
  out.array("contacts", r.contacts, [&](const ContactTrack& t) {
    out.row(t.a, t.b, t.feature, t.mu, t.x[0], t.y[0], t.normal[0], t.gap[0], t.lambda_n[0],
            t.lambda_t[0], t.w_n[0], t.w_t[0], static_cast<int>(t.state[0]),
            static_cast<int>(t.internal[0]), static_cast<int>(t.fresh[0]));
  });
}

void writeDecisions(JsonText& out, const Recording& r) {
  out.array("decisions", r.decisions, [&](const DecisionTrack& t) {
    out.row(t.a, t.b, t.stage, t.criterion, t.equation, t.threshold, t.needed, t.value[0],
            static_cast<int>(t.count[0]), static_cast<int>(t.passed[0]));
  });
}

void writeStats(JsonText& out, const Stats& s) {
  out.key("stats").row(s.active_bodies, s.collections, s.asleep, s.contacts, s.internal_contacts,
                       s.max_penetration, s.kinetic_energy, s.potential_energy, s.momentum.x(),
                       s.momentum.y(), s.angular_momentum);
}

void writeEventsOfStep(JsonText& out, const Recording& r) {
  out.array("events", r.events, [&](const TimedEvent& e) {
    out.row(e.step, name(e.event.type), e.event.a, e.event.b, e.event.collection,
            name(e.event.reason));
  });
}

/// Per contact, by its place among the contacts of this step.
void writeInside(JsonText& out, const ImpulsesInside& inside) {
  out.field("sweeping", inside.sweeping);
  out.key("inside").open('[');
  for (std::size_t i = 0; i < inside.contact.size(); ++i) {
    out.row(inside.contact[i], inside.warm_n[i], inside.warm_t[i], inside.swept_n[i],
            inside.swept_t[i], inside.begin_n[i], inside.begin_t[i],
            static_cast<int>(inside.inner[i]));
  }
  out.close(']');
}

void writeOrder(JsonText& out, const Notes& notes) {
  out.key("order").open('[');
  for (const NotedVisit& visit : notes.order) {
    if (!notes.seeds.empty() && visit.depth > 0) out.row(visit.a, visit.b, visit.depth);
  }
  out.close(']');
}

/// The colour of each collection.
void writeColors(JsonText& out, const CollectionSlots& colors) {
  out.key("colors").open('[');
  for (const auto& [id, slot] : colors) out.row(id, slot);
  out.close(']');
}

void writeState(JsonText& out, const Recording& r, const Snapshot& seen) {
  out.field("step", seen.step).field("t", seen.time);
  writeBodies(out, r);
  writeContacts(out, r);
  writeDecisions(out, r);
  writeEventsOfStep(out, r);
  writeStats(out, r.stats[0]);
}

}  // namespace

std::string stateText(const Snapshot& seen, const std::vector<BodyInfo>& bodies,
                      const CollectionSlots& colors) {
  JsonText out;
  out.open('{');
  writeState(out, recordingOf(seen, bodies), seen);
  writeColors(out, colors);
  out.close('}');
  return std::string(out.text());
}

std::string stepText(const StepRecord& record, const std::vector<BodyInfo>& bodies,
                     const CollectionSlots& colors) {
  const Recording r = recordingOf(record.after, bodies);
  JsonText out;
  out.open('{');
  writeState(out, r, record.after);
  writeColors(out, colors);
  ContactTracks tracks;
  tracks.update(r);
  writeInside(out, impulsesInside(record, tracks));
  writeOrder(out, record.notes);
  out.key("ledger").open('[');
  for (const LedgerEntry& entry : ledgerOf(record, bodies)) writeLedger(out, entry);
  out.close(']').key("results").open('[');
  for (std::size_t i = 0; i < kStages; ++i) out.value(result(record, static_cast<Stage>(i)));
  out.close(']').close('}');
  return std::string(out.text());
}

}  // namespace merge2d
