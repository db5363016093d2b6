#include "lessons/explain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace merge2d {
namespace {

/// The subject of a decision: a pair on its way to a weld, a weld, an impact, something that may
/// sleep, or the load of a collection.
enum class Matter { Impact, Sleep, Weld, Pair, Load };

Matter matterOf(const Decision& d) {
  if (d.stage == "ContactOrdering") return Matter::Impact;
  if (d.stage == "Unmerge") return Matter::Weld;
  if (d.stage == "WarmStart" || d.stage == "SingleIterationPGS") return Matter::Load;
  return d.a == d.b ? Matter::Sleep : Matter::Pair;
}

bool has(const std::vector<Decision>& tests, std::string_view verdict) {
  return std::ranges::any_of(tests, [&](const Decision& d) { return d.verdict == verdict; });
}

/// The state of the contacts of a weld that ended by its motion.
std::string_view contactsAtTheEnd(EventReason reason) {
  switch (reason) {
    case EventReason::Broken:
      return "; none of its contacts pressed (broken)";
    case EventReason::Sliding:
      return "; a contact was on the edge of its friction cone (sliding)";
    case EventReason::RelativeMotion:
      return "; its contacts pressed and did not slide (relative motion)";
    default:
      return "";
  }
}

/// The order of several decisions of one outcome: of welds that ended the fastest first; of others
/// those that lost their count, and those near their thresholds, on either side.
double interest(const Explanation& e) {
  const Decision* nearest = nearestTest(e.tests);
  if (nearest == nullptr) return 0.0;
  const double ratio = closeness(*nearest);
  if (e.outcome == Outcome::CameApart) return ratio;
  const double near = ratio > 1.0 ? 1.0 / ratio : ratio;
  return e.outcome == Outcome::Apart ? e.tests.back().before + near : near;
}

class Explainer {
 public:
  Explainer(const Words& words, const Snapshot& after) : words_(words), after_(after) {}

  Explanation explain(Matter matter, std::vector<Decision> tests) const {
    Explanation out;
    out.a = tests.front().a;
    out.b = tests.front().b;
    out.tests = std::move(tests);
    switch (matter) {
      case Matter::Impact:
        explainImpact(out);
        break;
      case Matter::Sleep:
        explainSleep(out);
        break;
      case Matter::Weld:
        explainWeld(out);
        break;
      case Matter::Pair:
        explainPair(out);
        break;
      case Matter::Load:
        explainLoad(out);
        break;
    }
    takeGroups(out);
    return out;
  }

  /// A weld that was ended from outside: there was no test.
  Explanation letGo(const Event& e) const {
    return {.a = e.a,
            .b = e.b,
            .outcome = Outcome::CameApart,
            .reason = e.reason,
            .text = fmt::format("{} came apart {}: the scene let go of one of them.",
                                words_.pair(e.a, e.b), atStep()),
            .tests = {},
            .groups = {}};
  }

 private:
  std::string test(const Decision& d) const { return words_.test(d, after_.groups); }
  /// An explanation outlives the snapshot.
  void takeGroups(Explanation& out) const {
    for (Decision& d : out.tests) {
      const auto members = static_cast<std::size_t>(d.members);
      if (d.members < 0 || members >= after_.groups.size()) continue;
      d.members = static_cast<std::int32_t>(out.groups.size());
      out.groups.push_back(after_.groups[members]);
    }
  }

  std::string atStep() const { return fmt::format("at step {}", after_.step); }

  /// The tests with one of these verdicts, in words; the nearest one of each criterion.
  std::string because(const std::vector<Decision>& tests,
                      std::initializer_list<std::string_view> verdicts) const {
    std::vector<const Decision*> chosen;
    for (const Decision& d : tests) {
      if (std::ranges::find(verdicts, d.verdict) == verdicts.end()) continue;
      const auto same = std::ranges::find(chosen, d.criterion, &Decision::criterion);
      if (same == chosen.end()) {
        chosen.push_back(&d);
      } else if (closeness(d) > closeness(**same)) {
        *same = &d;
      }
    }
    std::vector<std::string> parts;
    for (const Decision* d : chosen) parts.push_back(test(*d));
    return fmt::format("{}", fmt::join(parts, "; "));
  }

  void explainImpact(Explanation& out) const {
    const Decision& d = out.tests.front();
    const bool hit = d.verdict == "impact";
    out.outcome = Outcome::Hit;
    out.text = fmt::format("{} {} {}: {}.", words_.pair(out.a, out.b),
                           hit ? "hit each other" : "touched each other gently", atStep(), test(d));
  }

  /// "brick[0,0]", or "C3 (brick[0,0] and 11 others)".
  std::string sleeper(BodyId body) const {
    const auto state = std::ranges::find(after_.bodies, body, &BodyState::id);
    if (state == after_.bodies.end() || state->collection == kNoCollection)
      return words_.name(body);
    const auto c = std::ranges::find(after_.collections, state->collection, &CollectionView::id);
    if (c == after_.collections.end() || c->bodies.size() < 2) return words_.name(body);
    return fmt::format("{} ({} and {})", collectionName(c->id), words_.name(body),
                       counted(c->bodies.size() - 1, "other", "others"));
  }

  void explainSleep(Explanation& out) const {
    const std::string who = sleeper(out.a);
    const std::string why = test(out.tests.front());
    if (has(out.tests, "sleep")) {
      out.outcome = Outcome::Slept;
      out.text = fmt::format("{} fell asleep {}: {}.", who, atStep(), why);
    } else if (has(out.tests, "wake")) {
      out.outcome = Outcome::Woke;
      out.text = fmt::format("{} woke up {}: {}.", who, atStep(), why);
    } else {
      out.outcome = Outcome::Awake;
      std::vector<std::string> reasons;
      for (const Decision& d : out.tests) reasons.push_back(test(d));
      out.text = fmt::format("{} stayed awake {}: {}.", who, atStep(), fmt::join(reasons, "; "));
    }
  }

  void explainLoad(Explanation& out) const {
    std::vector<std::string> reasons;
    for (const Decision& d : out.tests) reasons.push_back(test(d));
    const std::string why = fmt::format("{}", fmt::join(reasons, "; "));
    const std::string who = sleeper(out.a);
    const std::string_view verdict = out.tests.back().verdict;
    if (verdict == "open") {
      out.outcome = Outcome::Opened;
      out.text = fmt::format(
          "{} is open {}: the members that this reaches take part in the full solve: {}.", who,
          atStep(), why);
    } else if (verdict == "search") {
      out.outcome = Outcome::Sought;
      out.text = fmt::format("{} stays whole {} while impulses that carry its load are sought: {}.",
                             who, atStep(), why);
    } else {
      out.outcome = Outcome::Carried;
      const bool passed = verdict == "passed";
      out.text = fmt::format(
          "{} {} {}: {}.", who,
          passed ? "passes a load that is new on to its frame" : "carries its load", atStep(), why);
    }
  }

  void explainWeld(Explanation& out) const {
    const std::string who = words_.pair(out.a, out.b);
    if (has(out.tests, "unmerge")) {
      out.outcome = Outcome::CameApart;
      out.reason = reasonOf(out.a, out.b);
      const bool moved = std::ranges::count(out.tests, "motion", &Decision::criterion) > 0;
      out.text =
          fmt::format("{} came apart {}: {}{}.", who, atStep(), because(out.tests, {"unmerge"}),
                      moved ? contactsAtTheEnd(out.reason) : "");
    } else if (has(out.tests, "cut")) {
      out.outcome = Outcome::Cut;
      out.text =
          fmt::format("The weld of {} was cut {}, but by way of others they stay together: {}.",
                      who, atStep(), because(out.tests, {"cut"}));
    } else if (has(out.tests, "wait")) {
      out.outcome = Outcome::Loose;
      out.text = fmt::format("The weld of {} held {}, but is under watch: {}{}.", who, atStep(),
                             because(out.tests, {"wait"}), countOf(out.tests));
    } else {
      out.outcome = Outcome::Held;
      const Decision* nearest = nearestTest(out.tests);
      out.text = fmt::format("The weld of {} held {}. Nearest to its limit: {}.", who, atStep(),
                             nearest ? test(*nearest) : "nothing");
    }
  }

  /// Of the event in which a weld ended.
  EventReason reasonOf(BodyId a, BodyId b) const {
    for (const Event& e : after_.events) {
      const bool same = std::minmax(e.a, e.b) == std::minmax(a, b);
      if (e.type == EventType::Unmerge && same) return e.reason;
    }
    return EventReason::None;
  }

  /// "; this is step 2 of 3"
  static std::string countOf(const std::vector<Decision>& tests) {
    for (const Decision& d : tests) {
      if (d.needed > 0 && d.count > 0) {
        return fmt::format("; that is {} of the {} steps it takes", d.count, d.needed);
      }
    }
    return "";
  }

  void explainPair(Explanation& out) const {
    const std::string who = words_.pair(out.a, out.b);
    const Decision& last = out.tests.back();
    if (endInMerge(out.tests)) {
      out.outcome = Outcome::Merged;
      out.text = fmt::format("{} merged {}{}: they passed every test for {} of {} steps. {}.", who,
                             atStep(), into(out.a, out.b), last.count, last.needed,
                             sentence(because(out.tests, {"below", "merge"})));
    } else if (last.criterion == "frames") {
      out.outcome = Outcome::Apart;
      out.text = fmt::format(
          "{} stayed apart {}: they are on two frames, those of {} and {}, which may move against "
          "each other.",
          who, atStep(), words_.name(frameOf(out.a)), words_.name(frameOf(out.b)));
    } else if (has(out.tests, "apart")) {
      out.outcome = Outcome::Apart;
      const std::string count =
          last.needed == 0 ? ""
          : last.before > 0
              ? fmt::format("; the count went back from {} of {} to 0", last.before, last.needed)
              : fmt::format("; the count stays at 0 of {}", last.needed);
      out.text = fmt::format("{} stayed apart {}: {}{}.", who, atStep(),
                             because(out.tests, {"apart", "wait"}), count);
    } else if (has(out.tests, "wait") && last.count <= 0) {  // nothing counts until they may merge
      out.outcome = Outcome::Waiting;
      out.text = fmt::format("{} wait {}: {}.", who, atStep(), because(out.tests, {"wait"}));
    } else if (last.criterion == "cycle" || last.criterion == "freedoms") {
      out.outcome = Outcome::Waiting;
      out.text = fmt::format("{} did not merge {}, though they passed every test for {} steps: {}.",
                             who, atStep(), last.count, test(last));
    } else {
      out.outcome = Outcome::Waiting;
      const std::string tests = sentence(because(out.tests, {"below"}));
      out.text = fmt::format("{} wait {}: they passed every test, but only for {} of {} steps.{}",
                             who, atStep(), last.count, last.needed,
                             tests.empty() ? "" : fmt::format(" {}.", tests));
    }
  }

  /// The body to whose frame another one is fixed: its own, or what its collection is welded to.
  BodyId frameOf(BodyId id) const {
    const auto body = std::ranges::find(after_.bodies, id, &BodyState::id);
    if (body == after_.bodies.end() || body->collection == kNoCollection) return id;
    const auto c = std::ranges::find(after_.collections, body->collection, &CollectionView::id);
    return c != after_.collections.end() && c->anchored ? c->anchor : id;
  }

  /// " into C3"
  std::string into(BodyId a, BodyId b) const {
    for (const BodyId id : {a, b}) {
      const auto body = std::ranges::find(after_.bodies, id, &BodyState::id);
      if (body != after_.bodies.end() && body->collection != kNoCollection) {
        return " into " + collectionName(body->collection);
      }
    }
    return "";
  }

  static std::string sentence(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') {
      text[0] = static_cast<char>(text[0] - 'a' + 'A');
    }
    return text;
  }

  const Words& words_;
  const Snapshot& after_;
};

}  // namespace

const char* name(Outcome outcome) {
  static constexpr const char* kNames[kOutcomes] = {
      "came-apart", "merged", "hit",   "woke", "slept",  "cut",    "loose",
      "waiting",    "apart",  "awake", "held", "opened", "sought", "carried"};
  return kNames[static_cast<std::size_t>(outcome)];
}

const char* heading(Outcome outcome) {
  static constexpr const char* kHeadings[kOutcomes] = {"Came apart",
                                                       "Merged",
                                                       "Met",
                                                       "Woke up",
                                                       "Fell asleep",
                                                       "Cut, but held together by others",
                                                       "Welds under watch",
                                                       "Ready, but waiting",
                                                       "Stayed apart",
                                                       "Stayed awake",
                                                       "Welds that hold",
                                                       "Opened",
                                                       "Loads that are sought",
                                                       "Loads that are carried"};
  return kHeadings[static_cast<std::size_t>(outcome)];
}

std::vector<Explanation> explainStep(const Words& words, const Snapshot& after) {
  std::map<std::tuple<Matter, BodyId, BodyId>, std::vector<Decision>> matters;
  for (const Decision& d : after.decisions) matters[{matterOf(d), d.a, d.b}].push_back(d);
  const Explainer explainer(words, after);
  std::vector<Explanation> all;
  for (auto& [key, tests] : matters) all.push_back(explainer.explain(std::get<0>(key), tests));
  for (const Event& e : after.events) {
    if (e.type == EventType::Unmerge && e.reason == EventReason::User) {
      all.push_back(explainer.letGo(e));
    }
  }
  std::ranges::stable_sort(all, [](const Explanation& x, const Explanation& y) {
    return x.outcome != y.outcome ? x.outcome < y.outcome : interest(x) > interest(y);
  });
  return all;
}

double closeness(const Decision& d) {
  const bool is_time = d.criterion == "patience" || d.criterion == "steady";
  return is_time || d.threshold <= 0.0 ? 0.0 : d.value / d.threshold;
}

const Decision* nearestTest(const std::vector<Decision>& tests) {
  const Decision* nearest = nullptr;
  for (const Decision& d : tests) {
    if (!nearest || closeness(d) > closeness(*nearest)) nearest = &d;
  }
  return nearest;
}

}  // namespace merge2d
