#include "lessons/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "src2d/core/suggest.h"

namespace merge2d {
namespace {

/// Criteria that compare a quantity with a threshold; `unit` is what follows "m".
struct ComparedCriterion {
  std::string_view criterion, quantity, unit = "/s";
};
constexpr ComparedCriterion kCompared[] = {
    {"relative-motion", "relative motion"},
    {"motion", "relative motion"},
    {"breathing", "the change of overlap", " per step"},
    {"rest", "its motion in the world"},
    {"balance", "what it gained in this step"},
    {"impact", "the speed of approach"},
    {"proof-motion", "the motion that known impulses leave"},
    {"search-motion", "the fastest motion that was found"},
    {"residual", "the residual of the rows inside"},
    {"stopped", "the motion of the waiting pair"},
    {"noise", "the motion at one of the boxes"},
    {"bounce", "the bounce that arrives"},
};

/// Criteria that are met or not, without a number of their own.
struct StatedCriterion {
  std::string_view criterion, statement;
};
constexpr StatedCriterion kStated[] = {
    {"in-doubt", "its proofs are in doubt, as contacts or forces are new"},
    {"joints", "a joint inside bears more than its strength"},
    {"neighbour-hit", "something that it touches was hit"},
    {"dragged", "a frame that moves drags at it"},
    {"search-mover", "its bodies did not move in the search that opened their collection"},
    {"pressed", "no contact between them carries a force"},
};

std::string withDigits(double value, int digits) {
  const double size = std::abs(value);
  if (size == 0.0) return "0";
  if (size < 1e-6 || size >= 1e7) return fmt::format("{:.{}e}", value, digits - 1);
  const int power = static_cast<int>(std::floor(std::log10(size)));
  return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - power));
}

int usualDigits(double value) { return std::abs(value) < 1.0 ? 2 : 3; }

/// How far a value is on the wrong side of its threshold, or on the right one.
std::string distance(double value, double threshold) {
  if (value == 0.0 || threshold <= 0.0) return "";
  const double ratio = value / threshold;
  if (ratio >= 1000.0) return "more than 1000 times; ";
  if (ratio > 1.0)
    return fmt::format("{:.{}f} times; ", ratio, ratio < 1.05 ? 3 : ratio < 10.0 ? 1 : 0);
  if (ratio < 0.001) return "less than a thousandth; ";
  return fmt::format("{:.{}f} %; ", 100.0 * ratio, ratio < 0.1 ? 1 : 0);
}

/// "relative motion 0.023 m/s is above 0.010 m/s (2.3 times; Eq. 17)". Thresholds below a
/// millimetre are told in millimetres; `unit` is what follows "m".
std::string compared(std::string_view what, const Decision& d, std::string_view unit) {
  const bool small = d.threshold < 1e-3;
  const double scale = small ? 1e3 : 1.0;
  const auto [value, threshold] = shortNumbers(scale * d.value, scale * d.threshold);
  const char* metre = small ? "mm" : "m";
  const char* relation = d.value < d.threshold   ? "is below"
                         : d.value > d.threshold ? "is above"
                                                 : "reaches";
  return fmt::format("{} {} {}{} {} {} {}{} ({}{})", what, value, metre, unit, relation, threshold,
                     metre, unit, distance(d.value, d.threshold), equationName(d.equation));
}

std::string contacts(double number) {
  return counted(static_cast<std::size_t>(number), "contact", "contacts");
}

/// "all 2 contacts that press are on the edge of their friction cones".
std::string allOnEdge(double contacts_pressed) {
  if (contacts_pressed == 1.0)
    return "the one contact that presses is on the edge of its friction cone";
  return fmt::format("all {} that press are on the edge of their friction cones",
                     contacts(contacts_pressed));
}

/// The sentence with the source of its criterion, where that has one.
std::string cited(const std::string& sentence, const Decision& d) {
  return d.equation.empty() ? sentence : fmt::format("{} ({})", sentence, equationName(d.equation));
}

std::string edge(const Decision& d) {
  if (d.verdict == "apart") {
    return fmt::format("{}, about to slide ({})", allOnEdge(d.threshold), equationName(d.equation));
  }
  if (d.value == 0.0) {
    return d.threshold == 1.0 ? cited("the one contact that presses is not about to slide", d)
                              : cited(fmt::format("none of {} that press is about to slide",
                                                  contacts(d.threshold)),
                                      d);
  }
  return fmt::format("{:.0f} of {} that press {} on the edge of the friction cone ({})", d.value,
                     contacts(d.threshold), d.value > 1.0 ? "are" : "is", equationName(d.equation));
}

/// `group` names its bodies. A joint counts as one contact or as two.
std::string cycle(const Decision& d, const std::string& group) {
  if (d.verdict != "merge") {
    return cited("a single contact is a pivot, and no rigid group holds it", d);
  }
  if (d.value < d.threshold) {
    return cited(fmt::format("its single contact is part of the rigid group of {}", group), d);
  }
  return cited(
      fmt::format("{}, or joints that count as so many, hold the pair rigidly", contacts(d.value)),
      d);
}

/// The load of a collection beside those that its contacts are known to carry.
std::string proof(const Decision& d) {
  if (d.needed == 0) return cited("no load is known that its contacts carry", d);
  const std::string what = d.needed == 1
                               ? "the part that the one known load leaves over"
                               : fmt::format("the part that {} of the {} known loads {} over",
                                             d.count, d.needed, d.count == 1 ? "leaves" : "leave");
  return compared(what, d, "/s");
}

std::string hit(const Decision& d) {
  return fmt::format("something hit it {} ago, and a hit opens it for {} ({})",
                     counted(static_cast<std::size_t>(d.value), "step", "steps"),
                     counted(static_cast<std::size_t>(d.threshold), "step", "steps"),
                     equationName(d.equation));
}

std::string hits(const Decision& d) {
  return fmt::format(
      "hits have gone on for {:.3g} s (bodies are simulated one by one after {} s; {})", d.value,
      d.threshold, equationName(d.equation));
}

std::string patience(const Decision& d) {
  return cited(fmt::format("their last weld turned slowly, or was hit for long: {} to wait",
                           counted(static_cast<std::size_t>(d.value), "step", "steps")),
               d);
}

std::string steady(const Decision& d) {
  const char* form = d.value < d.threshold
                         ? "it has been slow under steady loads for {} of {} s"
                         : "it has been slow under steady loads for {} s, at least {} s";
  return cited(fmt::format(fmt::runtime(form), shortNumber(d.value), shortNumber(d.threshold)), d);
}

std::string belt(const Decision& d) {
  return fmt::format("one of them drives what lies on it, at {} m/s ({})", shortNumber(d.value),
                     equationName(d.equation));
}

std::string freedoms(const Decision& d) {
  return cited(fmt::format("their joints take away {:.0f} of {:.0f} freedoms{}", d.value,
                           d.threshold, d.verdict == "wait" ? ", too few to hold them" : ""),
               d);
}

/// One that is new changes by 1/h of itself.
std::string load(const Decision& d) {
  return fmt::format("the impulse between them changes by {} times itself in a second, {} {} ({})",
                     shortNumber(d.value), d.value < d.threshold ? "below" : "above",
                     shortNumber(d.threshold), equationName(d.equation));
}

std::string sleeping(const Decision& d) {
  if (d.criterion == "disturbed") {
    return fmt::format("a kick, another load or a moving neighbour disturbs it ({})",
                       equationName(d.equation));
  }
  if (d.criterion == "neighbours") {
    return fmt::format("something in its island is awake, or about to merge ({})",
                       equationName(d.equation));
  }
  if (d.criterion == "inner-forces") {
    return fmt::format("the forces inside it still change ({})", equationName(d.equation));
  }
  return fmt::format("it has been at rest for {} of {} steps (Section 7)", d.count, d.needed);
}

}  // namespace

std::string shortNumber(double value) { return withDigits(value, usualDigits(value)); }

NumberPair shortNumbers(double value, double threshold) {
  constexpr int kMostDigits = 12;
  int more = 0;
  const auto text = [&](double v) { return withDigits(v, usualDigits(v) + more); };
  while (value != threshold && text(value) == text(threshold) && more < kMostDigits) ++more;
  return {text(value), text(threshold)};
}

std::string equationName(std::string_view equation) {
  if (!equation.starts_with('(')) return std::string(equation);
  return fmt::format("Eq. {}", equation.substr(1, equation.find(')') - 1));
}

std::string counted(std::size_t number, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", number, number == 1 ? one : many);
}

std::string listed(const std::vector<std::string>& parts) {
  if (parts.size() < 2) return parts.empty() ? "" : parts.front();
  return fmt::format("{} and {}", fmt::join(parts.begin(), parts.end() - 1, ", "), parts.back());
}

std::string collectionName(CollectionId id) { return fmt::format("C{}", static_cast<int>(id)); }

std::string Words::name(BodyId body) const {
  const std::string& name = bodies_[index(body)].name;
  return name.empty() ? fmt::format("body {}", index(body)) : name;
}

std::string Words::pair(BodyId a, BodyId b) const {
  return fmt::format("{} and {}", name(a), name(b));
}

std::optional<BodyId> Words::find(std::string_view name) const {
  const auto found = std::ranges::find(bodies_, name, &BodyInfo::name);
  if (found == bodies_.end()) return std::nullopt;
  return BodyId{static_cast<std::uint32_t>(found - bodies_.begin())};
}

std::string Words::suggestion(std::string_view name) const {
  std::vector<std::string_view> names;
  for (const BodyInfo& body : bodies_) names.emplace_back(body.name);
  return didYouMean(name, names);
}

std::string Words::group(const Group& group) const {
  constexpr std::size_t kAll = 6, kSome = 4;  // so many are all named; of more, some
  std::vector<std::string> names;
  const bool all = group.size() <= kAll;
  for (const BodyId body : group) {
    if (!all && names.size() == kSome) break;
    names.push_back(name(body));
  }
  if (!all) names.push_back(counted(group.size() - kSome, "other", "others"));
  return listed(names);
}

std::string Words::test(const Decision& d, const std::vector<Group>& groups) const {
  const std::string_view c = d.criterion;
  if (d.stage == "SleepAndWake") return sleeping(d);
  if (const auto* of = std::ranges::find(kCompared, c, &ComparedCriterion::criterion);
      of != std::end(kCompared)) {
    return compared(of->quantity, d, of->unit);
  }
  if (const auto* of = std::ranges::find(kStated, c, &StatedCriterion::criterion);
      of != std::end(kStated)) {
    return cited(std::string(of->statement), d);
  }
  if (c == "sliding") {
    return compared(d.stage == "Unmerge" ? "the slip of a contact" : "slip", d, "/s");
  }
  if (c == "proof") return proof(d);
  if (c == "hit") return hit(d);
  if (c == "hits") return hits(d);
  if (c == "edge") return edge(d);
  if (c == "cycle") {
    const auto members = static_cast<std::size_t>(d.members);
    if (d.members >= 0 && members < groups.size()) return cycle(d, group(groups[members]));
    return cycle(d, d.group < 0 ? "its own" : name(BodyId{static_cast<std::uint32_t>(d.group)}));
  }
  if (c == "patience") return patience(d);
  if (c == "steady") return steady(d);
  if (c == "belt") return belt(d);
  if (c == "frames") {
    return cited("they are on two frames, which may move against each other", d);
  }
  if (c == "freedoms") return freedoms(d);
  if (c == "load") return load(d);
  if (c == "broken") return "a contact of the weld carries no force any more (Section 6.3)";
  // "count": it goes on where a group is waited for
  return fmt::format("{} of {} steps passed (Section 5.1)", std::min(d.count, d.needed), d.needed);
}

std::string Words::event(const Event& e) const {
  const std::string collection = e.collection == kNoCollection ? "" : collectionName(e.collection);
  // Of what sleeps the first body is told.
  const std::string sleeper = collection.empty() ? name(e.a) : collection;
  switch (e.type) {
    case EventType::Merge:
      return fmt::format("{} merge into {}", pair(e.a, e.b), collection);
    case EventType::Unmerge:
      return fmt::format("{} come apart ({})", pair(e.a, e.b), merge2d::name(e.reason));
    case EventType::Sleep:
      return fmt::format("{} falls asleep", sleeper);
    case EventType::Wake:
      return fmt::format("{} wakes up", sleeper);
    case EventType::Impact:
      return fmt::format("{} hit each other", pair(e.a, e.b));
    case EventType::Emit:
      return fmt::format("{} appears", name(e.a));
    case EventType::Break:
      return e.a == e.b ? fmt::format("the joint of {} breaks", name(e.a))
                        : fmt::format("the joint of {} breaks", pair(e.a, e.b));
  }
  return {};
}

}  // namespace merge2d
