#include "lessons/why.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lessons/lookup.h"

namespace merge2d {
namespace {

/// The quantity that a criterion measures, and its unit.
struct Measure {
  std::string_view criterion, name, unit;
};
constexpr Measure kMeasures[] = {
    {"relative-motion", "relative motion", "m/s"},
    {"sliding", "slip", "m/s"},
    {"breathing", "change of overlap", "m"},
    {"motion", "relative motion", "m/s"},
    {"rest", "motion in the world", "m/s"},
    {"hits", "time of hits", "s"},
    {"load", "change of load", "1/s"},
    {"proof", "part of the load that known ones leave over", "m/s"},
    {"proof-motion", "motion that known impulses leave", "m/s"},
    {"residual", "residual of the rows inside", "m/s"},
    {"search-motion", "motion that a search found", "m/s"},
    {"noise", "motion at one of the boxes", "m/s"},
    {"bounce", "speed of the bounce that arrives", "m/s"},
    {"stopped", "motion of the waiting pair", "m/s"},
};

const Measure* measureOf(std::string_view criterion) {
  const auto found = std::ranges::find(kMeasures, criterion, &Measure::criterion);
  return found == std::end(kMeasures) ? nullptr : &*found;
}

/// The test that is farthest above its limit, of those that are.
const Decision* worst(const std::vector<Decision>& tests) {
  const Decision* found = nullptr;
  for (const Decision& d : tests) {
    if (measureOf(d.criterion) == nullptr || !(d.threshold > 0.0) ||
        std::abs(d.value) < d.threshold)
      continue;
    if (found == nullptr || d.value / d.threshold > found->value / found->threshold) found = &d;
  }
  return found;
}

using Kind = Condition::Kind;

Condition whenApart(const std::vector<Decision>& tests) {
  if (tests.back().criterion == "frames") return {.kind = Kind::OneFrame};
  if (tests.back().criterion == "belt") return {};
  const int needed = std::max(1, tests.back().needed);
  const Decision* high = worst(tests);
  if (high == nullptr) return {.kind = Kind::PassAll, .steps = needed};
  return {Kind::Below, high->criterion, high->threshold, needed};
}

Condition whenWaiting(const std::vector<Decision>& tests) {
  const Decision& last = tests.back();
  if (last.criterion == "cycle" || last.criterion == "freedoms") return {.kind = Kind::Hold};
  const auto patience = std::ranges::find(tests, "patience", &Decision::criterion);
  if (patience != tests.end()) {
    return {.kind = Kind::Wait, .steps = std::max(1, static_cast<int>(patience->value))};
  }
  const Decision* nearest = nearestTest(tests);
  const int more = std::max(1, last.needed - last.count);
  if (nearest == nullptr || measureOf(nearest->criterion) == nullptr) {
    return {.kind = Kind::CalmMore, .steps = more};
  }
  return {Kind::BelowMore, nearest->criterion, nearest->threshold, more};
}

Condition whenHeld(const std::vector<Decision>& tests) {
  const Decision* nearest = nearestTest(tests);
  if (nearest == nullptr || measureOf(nearest->criterion) == nullptr) {
    return {.kind = Kind::BreakOrSlide};
  }
  return {Kind::Above, nearest->criterion, nearest->threshold, nearest->needed};
}

/// Where no test was made.
PairReason untested(const Words& words, const Snapshot& after, BodyId a, BodyId b) {
  const BodyState *one = bodyIn(after, a), *other = bodyIn(after, b);
  const std::string who = words.pair(a, b);
  PairReason out{.outcome = "untested", .heading = "Not tested"};
  const auto contact = std::ranges::find_if(
      after.contacts, [&](const ContactView& c) { return c.a == a && c.b == b; });
  const bool touch = contact != after.contacts.end();
  // A pinned or scripted body is welded too, but is a member of no collection.
  const bool welded = touch && contact->internal;
  if (one == nullptr || other == nullptr) {
    out.outcome = "absent";
    out.text = fmt::format("{} are not both in the world now.", who);
  } else if (welded || (one->collection != kNoCollection && one->collection == other->collection)) {
    const bool asleep = one->asleep || other->asleep;
    out.outcome = !touch ? "by-others" : asleep ? "one-asleep" : "one";
    out.heading = touch ? "One collection" : "One, by way of others";
    out.text =
        fmt::format("{} are {} {}{}.", who, welded ? "welded in" : "both in",
                    collectionName(std::max(one->collection, other->collection)),
                    touch ? asleep ? ", which sleeps: nothing is tested until something wakes it"
                                   : ", and no motion inside was found in this step"
                          : ", though they do not touch: others hold them together");
    out.condition.kind = touch ? Kind::BreakOrSlide : Kind::CutBetween;
  } else if (!touch) {
    out.outcome = "no-touch";
    out.text = fmt::format("{} do not touch.", who);
    out.condition.kind = Kind::Touch;
  } else if (one->asleep || other->asleep) {
    out.outcome = "asleep";
    out.text =
        fmt::format("{} touch and sleep; nothing is tested until something wakes them.", who);
  } else {
    out.text = fmt::format("Nothing was tested about {} in this step.", who);
  }
  return out;
}

}  // namespace

const char* name(Condition::Kind kind) {
  static constexpr const char* kNames[] = {"none",        "pass-all", "below",       "below-more",
                                           "calm-more",   "wait",     "hold",        "touch",
                                           "break-slide", "above",    "cut-between", "one-frame"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string sentence(const Condition& c) {
  const Measure* m = measureOf(c.measure);
  const std::string limit = m == nullptr ? "" : fmt::format("{} {}", shortNumber(c.limit), m->unit);
  const std::string_view what = m == nullptr ? "" : m->name;
  const auto count = static_cast<std::size_t>(c.steps);
  const std::string steps = counted(count, "step", "steps");
  const std::string more = counted(count, "more step", "more steps");
  switch (c.kind) {
    case Kind::None:
      return "";
    case Kind::PassAll:
      return fmt::format("They merge when they pass every test for {}.", steps);
    case Kind::Below:
      return fmt::format("They merge when the {} stays below {} for {}.", what, limit, steps);
    case Kind::BelowMore:
      return fmt::format("They merge when the {} stays below {} for {}.", what, limit, more);
    case Kind::CalmMore:
      return fmt::format("They merge when all stays calm for {}.", more);
    case Kind::Wait:
      return fmt::format("They may merge after {}.", more);
    case Kind::Hold:
      return "They merge when a second contact, or a rigid group of bodies, holds them.";
    case Kind::Touch:
      return "Only bodies that touch can merge.";
    case Kind::BreakOrSlide:
      return "They come apart when their contacts cannot hold them: they lift, slide or turn about "
             "a corner.";
    case Kind::Above:
      return fmt::format(
          "They come apart when the {} is above {}{}, when they slide, or when no "
          "contact presses.",
          what, limit, c.steps > 1 ? fmt::format(" for {}", steps) : "");
    case Kind::CutBetween:
      return "They come apart when a weld on the way between them is cut.";
    case Kind::OneFrame:
      return "They may merge once one of them comes free of its frame.";
  }
  return "";
}

Condition conditionOf(const Explanation& e) {
  if (e.tests.empty() || e.a == e.b) return {};
  switch (e.outcome) {
    case Outcome::Apart:
      return whenApart(e.tests);
    case Outcome::Waiting:
      return whenWaiting(e.tests);
    case Outcome::Held:
    case Outcome::Loose:
    case Outcome::Merged:
      return whenHeld(e.tests);
    case Outcome::CameApart:
    case Outcome::Cut:
    case Outcome::Hit:
    case Outcome::Woke:
    case Outcome::Slept:
    case Outcome::Awake:
    case Outcome::Opened:
    case Outcome::Sought:
    case Outcome::Carried:
      return {};
  }
  return {};
}

PairReason reasonFor(const Words& words, const Snapshot& after, BodyId a, BodyId b) {
  if (b < a) std::swap(a, b);
  for (const Explanation& e : explainStep(words, after)) {
    if (e.a != a || e.b != b) continue;
    if (e.outcome == Outcome::Hit) continue;  // of a pair that met its other tests tell more
    return {.outcome = name(e.outcome),
            .heading = heading(e.outcome),
            .text = e.text,
            .condition = conditionOf(e),
            .tests = e.tests,
            .groups = e.groups};
  }
  return untested(words, after, a, b);
}

void writeReason(JsonText& out, const Words& words, const PairReason& reason) {
  const Condition& c = reason.condition;
  out.open('{').field("outcome", reason.outcome).field("heading", reason.heading);
  out.field("text", reason.text).field("outlook", sentence(c));
  out.key("condition").open('{').field("kind", name(c.kind)).field("measure", c.measure);
  out.field("limit", c.limit).field("steps", c.steps).close('}');
  out.array("tests", reason.tests, [&](const Decision& d) {
    const Measure* m = measureOf(d.criterion);
    out.open('{').field("criterion", d.criterion).field("stage", d.stage);
    out.field("equation", equationName(d.equation)).field("verdict", d.verdict);
    out.field("value", d.value).field("threshold", d.threshold);
    out.field("count", d.count).field("needed", d.needed);
    out.field("unit", m == nullptr ? std::string_view() : m->unit);
    out.field("text", words.test(d, reason.groups)).close('}');
  });
  out.close('}');
}

}  // namespace merge2d
