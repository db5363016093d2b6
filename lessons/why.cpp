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
    {"opening", "opening", "m/s"},
    {"footing", "motion of its parts on their foot", "m/s"},
    {"motion", "relative motion", "m/s"},
    {"carried-off", "motion against the whole", "m/s"},
    {"rest", "motion in the world", "m/s"},
};

const Measure* measureOf(const Decision& d) {
  const auto found = std::ranges::find(kMeasures, d.criterion, &Measure::criterion);
  return found == std::end(kMeasures) ? nullptr : &*found;
}

std::string limitOf(const Decision& d, const Measure& m) {
  return fmt::format("{} {}", shortNumber(d.threshold), m.unit);
}

/// The test that is farthest above its limit, of those that are.
const Decision* worst(const std::vector<Decision>& tests) {
  const Decision* found = nullptr;
  for (const Decision& d : tests) {
    if (measureOf(d) == nullptr || !(d.threshold > 0.0) || std::abs(d.value) < d.threshold)
      continue;
    if (found == nullptr || d.value / d.threshold > found->value / found->threshold) found = &d;
  }
  return found;
}

std::string afterSteps(int steps) {
  return counted(static_cast<std::size_t>(std::max(1, steps)), "more step", "more steps");
}

std::string whenApart(const std::vector<Decision>& tests) {
  const Decision& last = tests.back();
  const int needed = std::max(1, last.needed);
  const Decision* high = worst(tests);
  if (high == nullptr) {
    return fmt::format("They merge when they pass every test for {}.",
                       counted(static_cast<std::size_t>(needed), "step", "steps"));
  }
  const Measure& m = *measureOf(*high);
  return fmt::format("They merge when the {} stays below {} for {}.", m.name, limitOf(*high, m),
                     counted(static_cast<std::size_t>(needed), "step", "steps"));
}

std::string whenWaiting(const std::vector<Decision>& tests) {
  const Decision& last = tests.back();
  if (last.criterion == "cycle") {
    return "They merge when a second contact, or a rigid group of bodies, holds them.";
  }
  if (last.criterion == "patience") {
    return fmt::format("They may merge after {}.", afterSteps(static_cast<int>(last.value)));
  }
  const Decision* nearest = nearestTest(tests);
  const Measure* m = nearest == nullptr ? nullptr : measureOf(*nearest);
  const std::string steps = afterSteps(last.needed - last.count);
  if (m == nullptr) return fmt::format("They merge when all stays calm for {}.", steps);
  return fmt::format("They merge when the {} stays below {} for {}.", m->name,
                     limitOf(*nearest, *m), steps);
}

std::string whenHeld(const std::vector<Decision>& tests) {
  const Decision* nearest = nearestTest(tests);
  const Measure* m = nearest == nullptr ? nullptr : measureOf(*nearest);
  if (m == nullptr) return "They come apart when their contacts break, or slide.";
  const std::string steps =
      nearest->needed > 1 ? fmt::format(" for {} steps", nearest->needed) : std::string();
  return fmt::format("They come apart when the {} is above {}{}, or when no contact presses.",
                     m->name, limitOf(*nearest, *m), steps);
}

/// Where no test was made.
PairReason untested(const Words& words, const Snapshot& after, BodyId a, BodyId b) {
  const BodyState *one = bodyIn(after, a), *other = bodyIn(after, b);
  const std::string who = words.pair(a, b);
  PairReason out{.heading = "Not tested", .text = {}, .outlook = {}, .tests = {}, .groups = {}};
  const bool touch = std::ranges::any_of(
      after.contacts, [&](const ContactView& c) { return c.a == a && c.b == b; });
  if (one == nullptr || other == nullptr) {
    out.text = fmt::format("{} are not both in the world now.", who);
  } else if (one->collection != kNoCollection && one->collection == other->collection) {
    out.heading = touch ? "One collection" : "One, by way of others";
    out.text =
        fmt::format("{} are both in {}{}.", who, collectionName(one->collection),
                    touch ? one->asleep || other->asleep
                                ? ", which sleeps: nothing is tested until something wakes it"
                                : ", whose welds are not tested in this step"
                          : ", though they do not touch: others hold them together");
    if (!touch) out.outlook = "They come apart when a weld on the way between them is cut.";
  } else if (!touch) {
    out.text = fmt::format("{} do not touch.", who);
    out.outlook = "Only bodies that touch can merge.";
  } else if (one->asleep || other->asleep) {
    out.text =
        fmt::format("{} touch and sleep; nothing is tested until something wakes them.", who);
  } else {
    out.text = fmt::format("Nothing was tested about {} in this step.", who);
  }
  return out;
}

}  // namespace

std::string outlook(const Explanation& e) {
  if (e.tests.empty() || e.a == e.b) return "";
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
      return "";
  }
  return "";
}

PairReason reasonFor(const Words& words, const Snapshot& after, BodyId a, BodyId b) {
  if (b < a) std::swap(a, b);
  for (const Explanation& e : explainStep(words, after)) {
    if (e.a != a || e.b != b) continue;
    if (e.outcome == Outcome::Hit) continue;  // of a pair that met its other tests tell more
    return {.heading = heading(e.outcome),
            .text = e.text,
            .outlook = outlook(e),
            .tests = e.tests,
            .groups = e.groups};
  }
  return untested(words, after, a, b);
}

void writeReason(JsonText& out, const Words& words, const PairReason& reason) {
  out.open('{').field("heading", reason.heading).field("text", reason.text);
  out.field("outlook", reason.outlook);
  out.array("tests", reason.tests, [&](const Decision& d) {
    const Measure* m = measureOf(d);
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
