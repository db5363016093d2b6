#include "lessons/story.h"

#include <fmt/format.h>

#include <algorithm>

namespace merge2d {

WeldStory::WeldStory(const Words& words, BodyId a, BodyId b)
    : words_(words), a_(std::min(a, b)), b_(std::max(a, b)) {
  last_.a = a_;
  last_.b = b_;
}

bool WeldStory::concerns(BodyId a, BodyId b) const {
  return std::minmax(a, b) == std::minmax(a_, b_);
}

void WeldStory::add(const Snapshot& after) {
  last_step_ = after.step;
  Snapshot own;  // what concerns the pair alone
  own.step = after.step;
  own.bodies = after.bodies;
  own.collections = after.collections;
  own.groups = after.groups;
  for (const Decision& d : after.decisions) {
    if (concerns(d.a, d.b)) own.decisions.push_back(d);
  }
  for (const Event& e : after.events) {
    if (concerns(e.a, e.b)) own.events.push_back(e);
  }
  bool told = false;
  for (const Explanation& e : explainStep(words_, own)) {
    remember(e, after.step);
    told |= e.outcome == Outcome::CameApart || e.outcome == Outcome::Merged;
  }
  tests_.touched |= std::ranges::any_of(after.contacts, [&](const ContactView& contact) {
    return (contact.lambda_n > 0.0 || contact.gap <= 0.0) && concerns(contact.a, contact.b);
  });
  const bool now = std::ranges::any_of(
      after.welds, [&](const WeldView& weld) { return concerns(weld.a, weld.b); });
  if (now != welded_ && !told) {
    const char* text =
        now ? "{} became parts of one collection at step {}, by way of others."
            : "{} no longer hold on to each other since step {}: what they were part "
              "of was taken apart.";
    const Outcome outcome = now ? Outcome::Merged : Outcome::CameApart;
    chapters_.push_back({after.step,
                         {.a = a_,
                          .b = b_,
                          .outcome = outcome,
                          .text = fmt::format(fmt::runtime(text), words_.pair(a_, b_), after.step),
                          .tests = {}}});
  }
  if (now != welded_) {
    tests_ = {};
    apart_since_ = after.step;
  }
  welded_ = now;
}

void WeldStory::remember(const Explanation& e, std::int64_t step) {
  last_ = e;
  last_decided_ = step;
  const bool chapter = e.outcome == Outcome::CameApart || e.outcome == Outcome::Merged ||
                       e.outcome == Outcome::Hit || e.outcome == Outcome::Cut;
  // A weld that stays cut is found cut again in each step.
  const bool again = e.outcome == Outcome::Cut && !chapters_.empty() &&
                     chapters_.back().what.outcome == Outcome::Cut;
  if (chapter && !again) chapters_.push_back({step, e});
  if (e.outcome != Outcome::Apart && e.outcome != Outcome::Waiting) return;
  ++tests_.steps;
  tests_.needed = e.tests.back().needed;
  const int count = std::ranges::max(e.tests, {}, &Decision::count).count;
  if (count > tests_.best_count) {
    tests_.best_count = count;
    tests_.best_step = step;
  }
  for (const Decision& d : e.tests) {
    const bool refused = d.criterion == "cycle" || d.criterion == "freedoms";
    if (d.verdict != "apart" && !(d.verdict == "wait" && refused)) continue;
    Obstacle& obstacle = tests_.obstacles[std::string(d.criterion)];
    if (obstacle.steps == 0 || d.value < obstacle.nearest.value) {
      obstacle.nearest = d;
      obstacle.nearest_step = step;
    }
    ++obstacle.steps;
  }
}

std::string WeldStory::ending() const {
  const std::string who = words_.pair(a_, b_);
  if (welded_) {
    const bool told = last_decided_ == last_step_ &&
                      (last_.outcome == Outcome::Held || last_.outcome == Outcome::Loose);
    return fmt::format("After step {} {} are welded.{}", last_step_, who,
                       told ? " " + last_.text : "");
  }
  std::string text = fmt::format("After step {} {} are not welded. ", last_step_, who);
  if (tests_.steps == 0) return text + whyUntested();
  text += fmt::format("Tested in {}{}",
                      counted(static_cast<std::size_t>(tests_.steps), "step", "steps"),
                      apart_since_ > 0 ? fmt::format(" since step {}", apart_since_) : "");
  text += tests_.best_count > 0 ? fmt::format("; the count came up to {} of {}, at step {}.",
                                              std::min(tests_.best_count, tests_.needed),
                                              tests_.needed, tests_.best_step)
                                : fmt::format("; the count never left 0 of {}.", tests_.needed);
  return text + mainObstacle();
}

std::string WeldStory::whyUntested() const {
  return fmt::format(
      "{} was tested: they {}.",
      apart_since_ > 0 ? fmt::format("Since step {} nothing", apart_since_) : "Nothing",
      tests_.touched ? "touched only while pinned, asleep or parts of one collection"
                     : "did not touch");
}

std::string WeldStory::mainObstacle() const {
  const auto worst = std::ranges::max_element(
      tests_.obstacles, {}, [](const auto& obstacle) { return obstacle.second.steps; });
  if (worst == tests_.obstacles.end()) return "";
  const Obstacle& o = worst->second;
  static constexpr std::string_view kMeasured[] = {"sliding", "breathing", "relative-motion",
                                                   "load"};
  const bool measured = std::ranges::count(kMeasured, worst->first) > 0;
  return fmt::format(
      " What mostly kept them apart, in {}: {} ({}, {} step {}). They merge when every test is "
      "passed for {} steps.",
      counted(static_cast<std::size_t>(o.steps), "step", "steps"), worst->first,
      words_.test(o.nearest), measured ? "nearest to it at" : "as at", o.nearest_step,
      tests_.needed);
}

}  // namespace merge2d
