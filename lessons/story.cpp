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
  welded_ = now;
}

void WeldStory::remember(const Explanation& e, std::int64_t step) {
  last_ = e;
  const bool chapter = e.outcome == Outcome::CameApart || e.outcome == Outcome::Merged ||
                       e.outcome == Outcome::Hit || e.outcome == Outcome::Cut;
  // A weld that stays cut is found cut again in each step.
  const bool again = e.outcome == Outcome::Cut && !chapters_.empty() &&
                     chapters_.back().what.outcome == Outcome::Cut;
  if (chapter && !again) chapters_.push_back({step, e});
  if (e.outcome != Outcome::Apart && e.outcome != Outcome::Waiting) return;
  ++tested_;
  needed_ = e.tests.back().needed;
  const int count = std::ranges::max(e.tests, {}, &Decision::count).count;
  if (count > best_count_) {
    best_count_ = count;
    best_step_ = step;
  }
  for (const Decision& d : e.tests) {
    const bool refused = d.criterion == "cycle" || d.criterion == "freedoms";
    if (d.verdict != "apart" && !(d.verdict == "wait" && refused)) continue;
    Obstacle& obstacle = obstacles_[std::string(d.criterion)];
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
    return fmt::format(
        "After step {} {} are welded.{}", last_step_, who,
        last_.outcome == Outcome::Held || last_.outcome == Outcome::Loose ? " " + last_.text : "");
  }
  if (tested_ == 0) {
    return fmt::format(
        "Up to step {} {} did not touch, or were welded all the time, so nothing was tested.",
        last_step_, who);
  }
  std::string text = fmt::format("After step {} {} are not welded. Tested in {}", last_step_, who,
                                 counted(static_cast<std::size_t>(tested_), "step", "steps"));
  text += best_count_ > 0 ? fmt::format("; the count came up to {} of {}, at step {}.", best_count_,
                                        needed_, best_step_)
                          : fmt::format("; the count never left 0 of {}.", needed_);
  const auto worst = std::ranges::max_element(
      obstacles_, {}, [](const auto& obstacle) { return obstacle.second.steps; });
  if (worst != obstacles_.end()) {
    const Obstacle& o = worst->second;
    text += fmt::format(
        " What mostly kept them apart, in {}: {} ({} at its nearest, at step {}). "
        "They merge when every test is passed for {} steps.",
        counted(static_cast<std::size_t>(o.steps), "step", "steps"), worst->first,
        words_.test(o.nearest), o.nearest_step, needed_);
  }
  return text;
}

}  // namespace merge2d
