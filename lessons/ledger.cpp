#include "lessons/ledger.h"

#include <algorithm>
#include <utility>

namespace merge2d {
namespace {

bool joinsOrParts(const Event& e) {
  return e.type == EventType::Merge || e.type == EventType::Unmerge;
}

/// Of the bodies that respond to forces, and of those that are merged with fixed ones.
LedgerEntry::Sums sumsOf(const Snapshot& seen, const std::vector<BodyInfo>& bodies) {
  LedgerEntry::Sums s;
  for (const BodyState& b : seen.bodies) {
    const BodyInfo& info = bodies[index(b.id)];
    if (info.motion != Motion::Dynamic || b.pinned) continue;
    s.px += info.mass * b.v.x();
    s.py += info.mass * b.v.y();
    s.angular += info.inertia * b.omega + info.mass * cross(b.x, b.v);
    s.kinetic += 0.5 * (info.mass * b.v.squaredNorm() + info.inertia * b.omega * b.omega);
  }
  return s;
}

}  // namespace

std::vector<LedgerEntry> ledgerOf(const StepRecord& record, const std::vector<BodyInfo>& bodies) {
  std::vector<LedgerEntry> out;
  for (const Stage stage : {Stage::Unmerge, Stage::Merge}) {
    const Snapshot& after = record[stage].after;
    if (!std::ranges::any_of(after.events, joinsOrParts)) continue;
    const bool anchored = std::ranges::any_of(after.collections, &CollectionView::anchored);
    out.push_back({.step = record.step,
                   .stage = stage,
                   .before = sumsOf(record.before_stage(stage), bodies),
                   .after = sumsOf(after, bodies),
                   .anchored = anchored});
  }
  return out;
}

void writeLedger(JsonText& out, const LedgerEntry& e) {
  const auto change = [&](double LedgerEntry::Sums::*of) {
    return std::pair{e.before.*of, e.after.*of};
  };
  out.open('[').value(e.step).value(static_cast<int>(e.stage)).value(e.anchored ? 1 : 0);
  for (const auto of : {&LedgerEntry::Sums::px, &LedgerEntry::Sums::py, &LedgerEntry::Sums::angular,
                        &LedgerEntry::Sums::kinetic}) {
    const auto [before, after] = change(of);
    out.value(static_cast<float>(before)).value(static_cast<float>(after));
  }
  out.close(']');
}

}  // namespace merge2d
