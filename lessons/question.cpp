#include "lessons/question.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "lessons/body_named.h"
#include "lessons/words.h"
#include "src2d/core/suggest.h"
#include "src2d/trace/json_text.h"

namespace merge2d {
namespace {

constexpr std::array<std::string_view, 4> kCriteria = {"motion", "relative-motion", "sliding",
                                                       "breathing"};

std::set<std::pair<BodyId, BodyId>> touchingPairs(const Recording& r, std::int64_t step) {
  std::set<std::pair<BodyId, BodyId>> pairs;
  for (const ContactTrack& c : r.contacts) {
    if (r.sampleAt(c.spans, step)) pairs.insert({c.a, c.b});
  }
  return pairs;
}

/// " (its contact slides)", from the events of the step; empty where a neighbour came free of it.
std::string whyFreed(const Recording& r, BodyId body, std::int64_t step) {
  for (const TimedEvent& e : r.events) {
    if (e.step != step || e.event.type != EventType::Unmerge) continue;
    if (e.event.a != body && e.event.b != body) continue;
    switch (e.event.reason) {
      case EventReason::Broken:
        return " (a contact broke)";
      case EventReason::Sliding:
        return " (a contact slides)";
      case EventReason::RelativeMotion:
        return " (it moves against the others)";
      default:
        return "";
    }
  }
  return "";
}

}  // namespace

/// An option of an answer: its text, the bodies it means in the picture, and whether it is right.
struct Question::Answer {
  struct Option {
    std::string text;
    std::vector<BodyId> bodies;
    bool right = false;
  };
  std::vector<Option> options;
  bool several = false;
  std::string because;
  std::optional<double> number = std::nullopt;  ///< the answer, where it is one
};

Question::Question(TableReader table, const Scene& scene) {
  if (const auto value = table.require("ask")) ask_ = value->text();
  if (const auto value = table.require("reveal")) reveal_.emplace(*value, scene);
  table.read("because", because_);
  int kinds = 0;
  if (const auto value = table.get("choices")) {
    ++kinds;
    for (const Value& choice : value->elements("[\"one\", \"other\"]")) {
      choices_.push_back(choice.text());
    }
    if (choices_.size() < 2) value->fail("a question has at least two choices");
    const auto answer = table.require("answer");
    if (answer) {
      answer_ = static_cast<int>(
          answer->integer({1, static_cast<double>(choices_.size()), "the number of a choice"}));
    }
  }
  if (const auto value = table.get("threshold")) {
    ++kinds;
    kind_ = Kind::Threshold;
    place_ = *value;
    criterion_ = value->text();
    if (std::find(kCriteria.begin(), kCriteria.end(), criterion_) == kCriteria.end()) {
      value->fail(fmt::format("'{}' is no criterion with a threshold{}; there are {}", criterion_,
                              didYouMean(criterion_, kCriteria), fmt::join(kCriteria, ", ")));
    }
    if (const auto pair = table.require("pair")) {
      for (const Value& name : pair->elements("[\"a\", \"b\"]")) {
        pair_.push_back(bodyNamed(name, scene, name.text()));
      }
      if (pair_.size() != 2) pair->fail("a pair has two bodies");
      std::sort(pair_.begin(), pair_.end());
    }
  }
  if (const auto value = table.get("measure")) {
    ++kinds;
    readNumber(table, *value, scene);
  }
  const auto flag = [&](const char* key, Kind kind) {
    bool on = false;
    table.read(key, on);
    if (!on) return;
    ++kinds;
    kind_ = kind;
  };
  flag("freed", Kind::Freed);
  flag("contact", Kind::Contact);
  flag("collections", Kind::Collections);
  table.done();
  if (kinds != 1) {
    table.fail(
        "a question has exactly one of choices, threshold, freed, contact, collections, measure");
  }
}

/// A right answer lies within `tolerance` of the measured number.
void Question::readNumber(TableReader& table, const Value& measure, const Scene& scene) {
  kind_ = Kind::Number;
  quantity_.emplace(measure, scene);
  if (const auto value = table.require("tolerance")) {
    tolerance_ = value->number({1e-12, 1e12, "a positive number"});
  }
  table.read("unit", unit_);
}

Question::Answer Question::measured(const Recording& r, std::int64_t step) const {
  const double value = quantity_->at(r, step);
  return {.options = {},
          .several = false,
          .because = fmt::format("It is {:.3g}{}{}.", value, unit_.empty() ? "" : " ", unit_),
          .number = value};
}

Question::Answer Question::aboveOrBelow(const Recording& r, std::int64_t step) const {
  for (const DecisionTrack& t : r.decisions) {
    if (t.a != pair_[0] || t.b != pair_[1] || t.criterion != criterion_) continue;
    const auto sample = r.sampleAt(t.spans, step);
    if (!sample) continue;
    const double value = std::abs(static_cast<double>(t.value[*sample]));
    const bool above = value >= t.threshold;
    const Decision test{
        .criterion = t.criterion, .equation = t.equation, .value = value, .threshold = t.threshold};
    return {{{"above the limit", {}, above}, {"below the limit", {}, !above}},
            false,
            fmt::format("The answer: {}.", Words(r.bodies).test(test))};
  }
  place_->fail(fmt::format("'{}' is not tested for this pair at step {}", criterion_, step));
}

Question::Answer Question::ofChoices() const {
  Answer out;
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    out.options.push_back({choices_[i], {}, static_cast<int>(i) + 1 == answer_});
  }
  return out;
}

Question::Answer Question::freedBodies(const Recording& r, std::int64_t asked_at,
                                       std::int64_t step) {
  Answer out{.options = {}, .several = true, .because = "No body comes free."};
  std::vector<std::string> freed;
  for (std::size_t i = 0; i < r.bodies.size(); ++i) {
    const BodyId b{static_cast<std::uint32_t>(i)};
    if (r.collection(b, asked_at) == kNoCollection) continue;
    const bool right = r.collection(b, step) == kNoCollection;
    out.options.push_back({r.bodies[i].name, {b}, right});
    if (right) freed.push_back(r.bodies[i].name + whyFreed(r, b, step));
  }
  if (!freed.empty())
    out.because = fmt::format("Free at step {}: {}.", step, fmt::join(freed, ", "));
  return out;
}

/// The pairs that touch, and those of the event even where they do not yet.
Question::Answer Question::contactOfEvent(const Recording& r, std::int64_t asked_at,
                                          const Found& found) const {
  if (!found.event) reveal_->place().fail("'contact' needs an event, as in \"first unmerge\"");
  std::set<std::pair<BodyId, BodyId>> pairs = touchingPairs(r, asked_at), right;
  for (const TimedEvent& e : r.events) {
    if (e.step != found.step || e.event.type != found.event->type) continue;
    right.insert(std::minmax(e.event.a, e.event.b));
  }
  pairs.insert(right.begin(), right.end());
  Answer out;
  std::vector<std::string> names;
  for (const auto& [a, b] : pairs) {
    const bool is = right.contains({a, b});
    const std::string both =
        fmt::format("{} and {}", r.bodies[index(a)].name, r.bodies[index(b)].name);
    out.options.push_back({both, {a, b}, is});
    if (is) names.push_back(both);
  }
  out.because = fmt::format("At step {}: {}.", found.step, fmt::join(names, "; "));
  if (found.event->reason != EventReason::None) {
    out.because += fmt::format(" The reason is: {}.", name(found.event->reason));
  }
  return out;
}

Question::Answer Question::numberOfCollections(const Recording& r, std::int64_t step) {
  Answer out;
  const int right = r.stats[static_cast<std::size_t>(step)].collections;
  const int first = std::max(0, right - 2);
  for (int n = first; n < first + 5; ++n)
    out.options.push_back({std::to_string(n), {}, n == right});
  out.because = fmt::format("There {} {}.", right == 1 ? "is" : "are", right);
  return out;
}

Question::Answer Question::answered(const Recording& r, std::int64_t asked_at,
                                    const Found& found) const {
  switch (kind_) {
    case Kind::Words:
      return ofChoices();
    case Kind::Threshold:
      return aboveOrBelow(r, found.step);
    case Kind::Freed:
      return freedBodies(r, asked_at, found.step);
    case Kind::Contact:
      return contactOfEvent(r, asked_at, found);
    case Kind::Collections:
      return numberOfCollections(r, found.step);
    case Kind::Number:
      return measured(r, found.step);
  }
  return {};
}

void Question::write(JsonText& out, const Recording& r, std::int64_t asked_at) const {
  const Found found = reveal_->in(r);
  const Answer answer = answered(r, asked_at, found);
  std::string because = answer.because;
  if (!because_.empty()) because += (because.empty() ? "" : " ") + because_;
  out.open('{').field("ask", ask_).field("several", answer.several).field("reveal", found.step);
  out.array("options", answer.options, [&](const Answer::Option& o) {
    out.open('{').field("text", o.text).field("right", o.right);
    out.array("bodies", o.bodies, [&](BodyId b) { out.value(b); });
    out.close('}');
  });
  if (answer.number) {
    out.key("number").open('{').field("value", *answer.number).field("tolerance", tolerance_);
    out.field("unit", unit_).close('}');
  }
  out.field("because", because).close('}');
}

}  // namespace merge2d
