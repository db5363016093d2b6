/// The work of each stage, in one line.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "lessons/lookup.h"
#include "lessons/tables.h"

namespace merge2d {
namespace {

std::size_t countOf(const Snapshot& s, EventType type) {
  return static_cast<std::size_t>(std::ranges::count(s.events, type, &Event::type));
}

/// Pairs of which some test cut the weld, whether or not others hold them together.
std::size_t cutWelds(const Snapshot& s) {
  std::set<std::pair<BodyId, BodyId>> pairs;
  for (const Decision& d : s.decisions) {
    const bool cut = d.verdict == "cut" || d.verdict == "unmerge";
    if (d.stage == "Unmerge" && cut) pairs.insert(std::minmax(d.a, d.b));
  }
  return pairs.size();
}

std::size_t countVerdict(const Snapshot& s, std::string_view verdict) {
  return static_cast<std::size_t>(std::ranges::count(s.decisions, verdict, &Decision::verdict));
}

std::string solveSummary(const StepRecord& record) {
  std::size_t sticking = 0, sliding = 0, open = 0;
  for (const ContactView& c : record[Stage::SolveLCP].after.contacts) {
    if (c.internal) continue;
    sticking += c.state == ContactState::Sticking;
    sliding += c.state == ContactState::Sliding;
    open += c.state == ContactState::Broken;
  }
  return fmt::format("{} between them: {} stick, {} slide, {} carry nothing; residual {}",
                     counted(sticking + sliding + open, "contact", "contacts"), sticking, sliding,
                     open, shortNumber(record.after.stats.residual));
}

/// How many bodies moved, and how far at most.
std::string motionSummary(const Snapshot& before, const Snapshot& after) {
  double farthest = 0.0;
  std::size_t moved = 0;
  for (const BodyState& b : after.bodies) {
    const BodyState* old = bodyIn(before, b.id);
    if (old == nullptr) continue;
    const double way = (b.x - old->x).norm();
    moved += way > 0.0;
    farthest = std::max(farthest, way);
  }
  return fmt::format("{} moved, at most {} m", counted(moved, "body", "bodies"),
                     shortNumber(farthest));
}

std::string detectionSummary(const StepRecord& record) {
  const Snapshot& after = record[Stage::ContactDetection].after;
  std::size_t fresh = 0, inside = 0;
  for (const ContactView& c : after.contacts) fresh += c.fresh, inside += c.internal;
  return fmt::format("{}: {} inside collections, {} new, {} pruned",
                     counted(after.contacts.size(), "contact", "contacts"), inside, fresh,
                     record.notes.pruned.size());
}

std::string orderingSummary(const StepRecord& record) {
  if (record.notes.order.empty()) return "no sweep goes breadth first";
  return fmt::format("{} ordered, from {}",
                     counted(record.notes.order.size(), "contact", "contacts"),
                     counted(record.notes.seeds.size(), "seed", "seeds"));
}

std::string sleepSummary(const Snapshot& after) {
  const auto asleep = std::ranges::count(after.bodies, true, &BodyState::asleep);
  return fmt::format("{} asleep; {} fell asleep, {} woke up",
                     counted(static_cast<std::size_t>(asleep), "body", "bodies"),
                     countVerdict(after, "sleep"), countVerdict(after, "wake"));
}

std::string warmStartSummary(const StepRecord& record) {
  const auto& own = record[Stage::WarmStart].own;
  if (!own.empty()) {
    return fmt::format("{} start from the impulses of the last step",
                       counted(own.size(), "body", "bodies"));
  }
  const auto collections = [](std::size_t n) { return counted(n, "collection", "collections"); };
  const std::size_t opened = openedCollections(record), searched = searchedCollections(record);
  if (opened > 0) return collections(opened) + " open: their bodies are solved one by one";
  if (searched > 0) return "the forces inside " + collections(searched) + " are sought";
  return "no new load inside collections, so there is nothing to sweep";
}

std::string sweepSummary(const Snapshot& before, const Snapshot& after) {
  double largest = 0.0;
  const auto old = byKey(before);
  for (const ContactView& c : after.contacts) {
    const auto found = old.find(keyOf(c));
    if (found == old.end()) continue;
    largest = std::max(largest, std::abs(c.lambda_n - found->second->lambda_n));
  }
  return fmt::format("the largest change of a normal impulse is {} N s", shortNumber(largest));
}

/// "3 collections → 2"
std::string collectionsSummary(const Snapshot& before, const Snapshot& after) {
  return fmt::format("{} → {}", counted(before.collections.size(), "collection", "collections"),
                     after.collections.size());
}

std::string unmergeSummary(const Snapshot& before, const Snapshot& after) {
  return fmt::format("{} cut, {} came apart; {}", counted(cutWelds(after), "weld", "welds"),
                     counted(countOf(after, EventType::Unmerge), "pair", "pairs"),
                     collectionsSummary(before, after));
}

std::string velocitySummary(const Snapshot& before, const Snapshot& after) {
  double largest = 0.0;
  for (const BodyState& b : after.bodies) {
    const BodyState* old = bodyIn(before, b.id);
    if (old != nullptr) largest = std::max(largest, (b.v - old->v).norm());
  }
  return fmt::format("the largest change of a velocity is {} m/s", shortNumber(largest));
}

std::string relativeMotionSummary(const Snapshot& after) {
  std::size_t quiet = 0, pairs = 0;
  for (const Decision& d : after.decisions) {
    if (d.criterion != "relative-motion") continue;
    ++pairs;
    quiet += d.count > 0;
  }
  return fmt::format("{} tested, {} passed all tests", counted(pairs, "pair", "pairs"), quiet);
}

std::string mergeSummary(const Snapshot& before, const Snapshot& after) {
  return fmt::format("{}; {}", counted(countOf(after, EventType::Merge), "merge", "merges"),
                     collectionsSummary(before, after));
}

}  // namespace

std::string summary(const StepRecord& record, Stage stage) {
  const Snapshot &before = record.before_stage(stage), &after = record[stage].after;
  switch (stage) {
    case Stage::ContactDetection:
      return detectionSummary(record);
    case Stage::ContactOrdering:
      return orderingSummary(record);
    case Stage::SleepAndWake:
      return sleepSummary(after);
    case Stage::WarmStart:
      return warmStartSummary(record);
    case Stage::SingleIterationPGS:
      return sweepSummary(before, after);
    case Stage::Unmerge:
      return unmergeSummary(before, after);
    case Stage::SolveLCP:
      return solveSummary(record);
    case Stage::AdvanceVelocities:
      return velocitySummary(before, after);
    case Stage::AccumulateRelativeMotion:
      return relativeMotionSummary(after);
    case Stage::AdvancePositions:
      return motionSummary(before, after);
    case Stage::Merge:
      return mergeSummary(before, after);
  }
  return {};
}

}  // namespace merge2d
