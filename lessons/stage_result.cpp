/// The result of each stage in a few words: beside its name in a list of the stages.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lessons/lookup.h"
#include "lessons/tables.h"

namespace merge2d {
namespace {

std::string contactsFoundResult(const Snapshot& after) {
  std::size_t fresh = 0, inside = 0;
  for (const ContactView& c : after.contacts) fresh += c.fresh, inside += c.internal;
  if (after.contacts.empty()) return "nothing touches";
  if (fresh > 0) return fmt::format("{} new, {} known", fresh, after.contacts.size() - fresh);
  if (inside == after.contacts.size()) return fmt::format("{} known, inside", inside);
  return fmt::format("{} known", after.contacts.size());
}

std::string orderResult(const Notes& notes) {
  if (notes.seeds.empty()) return "nothing new";
  return fmt::format("{}, from {} new", notes.order.size(), notes.seeds.size());
}

std::string sleepResult(const Snapshot& after) {
  const auto verdicts = [&](std::string_view verdict) {
    return std::ranges::count(after.decisions, verdict, &Decision::verdict);
  };
  const auto slept = verdicts("sleep"), woke = verdicts("wake");
  if (slept > 0) return fmt::format("{} fell asleep", slept);
  if (woke > 0) return fmt::format("{} woke up", woke);
  return "nothing to do";
}

std::string warmStartResult(const StepRecord& record) {
  const std::size_t swept = record[Stage::WarmStart].own.size();
  if (swept > 0) return counted(swept, "body", "bodies");
  const std::size_t opened = openedCollections(record), searched = searchedCollections(record);
  if (opened > 0) return fmt::format("{} opened", opened);
  return searched > 0 ? fmt::format("{} searched", searched) : "nothing to sweep";
}

/// The largest change of a normal impulse.
std::string sweepResult(const StepRecord& record) {
  if (record[Stage::SingleIterationPGS].own.empty()) return "nothing to sweep";
  double largest = 0.0;
  const auto old = byKey(record.before_stage(Stage::SingleIterationPGS));
  for (const ContactView& c : record[Stage::SingleIterationPGS].after.contacts) {
    const auto found = old.find(keyOf(c));
    if (found == old.end()) continue;
    largest = std::max(largest, std::abs(c.lambda_n - found->second->lambda_n));
  }
  return fmt::format("largest change {:.2g} N s", largest);
}

std::string unmergeResult(const Snapshot& after) {
  std::set<std::pair<BodyId, BodyId>> cut;
  for (const Decision& d : after.decisions) {
    if (d.verdict == "cut" || d.verdict == "unmerge") cut.insert(std::minmax(d.a, d.b));
  }
  return cut.empty() ? "nothing to cut" : counted(cut.size(), "weld cut", "welds cut");
}

/// Contacts of the full solve that are not inside a collection: some body at them may move.
std::ptrdiff_t solvedBetween(const Snapshot& after) {
  const auto moves = [&](BodyId id) {
    const BodyState* body = bodyIn(after, id);
    return body != nullptr && !body->asleep && !body->pinned;
  };
  return std::ranges::count_if(after.contacts, [&](const ContactView& c) {
    return !c.internal && (moves(c.a) || moves(c.b));
  });
}

std::string velocityResult(const Snapshot& before, const Snapshot& after) {
  double largest = 0.0;
  for (const BodyState& b : after.bodies) {
    const BodyState* old = bodyIn(before, b.id);
    if (old != nullptr) largest = std::max(largest, (b.v - old->v).norm());
  }
  return fmt::format("by {:.2g} m/s at most", largest);
}

std::string pairsResult(const Snapshot& after) {
  const auto pairs = std::ranges::count(after.decisions, "relative-motion", &Decision::criterion);
  if (pairs == 0) return "nothing to watch";
  return fmt::format("{} watched", counted(static_cast<std::size_t>(pairs), "pair", "pairs"));
}

std::string motionResult(const Snapshot& before, const Snapshot& after) {
  std::size_t moved = 0;
  for (const BodyState& b : after.bodies) {
    const BodyState* old = bodyIn(before, b.id);
    moved += old != nullptr && (b.x - old->x).norm() > 0.0;
  }
  return moved == 0 ? "nothing moved" : fmt::format("{} moved", counted(moved, "body", "bodies"));
}

std::string mergeResult(const Snapshot& after) {
  const auto merges = std::ranges::count(after.events, EventType::Merge, &Event::type);
  return merges == 0
             ? "none ready"
             : fmt::format("{} merged", counted(static_cast<std::size_t>(merges), "pair", "pairs"));
}

}  // namespace

std::string result(const StepRecord& record, Stage stage) {
  const Snapshot &before = record.before_stage(stage), &after = record[stage].after;
  switch (stage) {
    case Stage::ContactDetection:
      return contactsFoundResult(after);
    case Stage::ContactOrdering:
      return orderResult(record.notes);
    case Stage::SleepAndWake:
      return sleepResult(after);
    case Stage::WarmStart:
      return warmStartResult(record);
    case Stage::SingleIterationPGS:
      return sweepResult(record);
    case Stage::Unmerge:
      return unmergeResult(after);
    case Stage::SolveLCP: {
      const std::ptrdiff_t solved = after.stats.contacts, between = solvedBetween(after);
      const std::ptrdiff_t inside = solved - between;  // of opened collections
      if (inside > 0 && between > 0) return fmt::format("{} between, {} inside", between, inside);
      return solved == 0 ? "nothing to solve" : fmt::format("{} solved", solved);
    }
    case Stage::AdvanceVelocities:
      return velocityResult(before, after);
    case Stage::AccumulateRelativeMotion:
      return pairsResult(after);
    case Stage::AdvancePositions:
      return motionResult(before, after);
    case Stage::Merge:
      return mergeResult(after);
  }
  return {};
}

}  // namespace merge2d
