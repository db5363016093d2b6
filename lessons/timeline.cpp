#include "lessons/timeline.h"

#include <algorithm>
#include <iterator>

#include "lessons/hand.h"

namespace merge2d {
namespace {

/// How many steps are remembered …
constexpr std::size_t kKept = 48;
/// … and how many of them before the one that one went back to.
constexpr std::int64_t kBefore = 24;
/// A state is kept every so many steps, to go back to.
constexpr std::int64_t kSavedEvery = 40;

}  // namespace

Timeline::Timeline(const Scene& scene, Mode mode, std::int64_t last)
    : last_(last),
      live_(scene, mode),
      bodies_(live_.world().bodies()),
      initial_(live_.world().capture()) {
  saved_.emplace(0, live_.save());
}

/// To the last state that was kept, at `k` or before.
void Timeline::goBackTo(std::int64_t k) {
  const auto& [step, saved] = *std::prev(saved_.upper_bound(k));
  live_.restore(saved);
  const auto later = std::ranges::find_if(
      changes_, [at = step](const HandChange& change) { return change.step >= at; });
  applied_ = static_cast<std::size_t>(later - changes_.begin());
}

void Timeline::applyChanges() {
  while (applied_ < changes_.size() && changes_[applied_].step == live_.world().steps()) {
    doByHand(live_, changes_[applied_++].words);
  }
}

void Timeline::noteStep() {
  const World& world = live_.world();
  const std::int64_t k = world.steps();
  if (static_cast<std::int64_t>(events_.size()) < k) events_.push_back(world.events());
  if (k % kSavedEvery == 0) saved_.try_emplace(k, live_.save());
}

void Timeline::keep(StepRecord record) {
  const std::int64_t k = record.step;
  colors_.insert_or_assign(k, live_.colors());
  kept_.insert_or_assign(k, std::move(record));
  // The one farthest from here goes.
  while (kept_.size() > kKept) {
    const bool first = k - kept_.begin()->first >= kept_.rbegin()->first - k;
    const auto far = first ? kept_.begin() : std::prev(kept_.end());
    colors_.erase(far->first);
    kept_.erase(far);
  }
}

const StepRecord& Timeline::step(std::int64_t k) {
  if (const auto found = kept_.find(k); found != kept_.end()) return found->second;
  std::int64_t record_from = k;
  if (live_.world().steps() >= k) {
    record_from = std::max<std::int64_t>(1, k - kBefore);
    goBackTo(record_from - 1);
  }
  while (live_.world().steps() < k) {
    applyChanges();
    if (live_.world().steps() + 1 >= record_from) {
      keep(live_.step());
    } else {
      live_.skip();
    }
    noteStep();
  }
  return kept_.at(k);
}

const Snapshot& Timeline::state(std::int64_t k) { return k == 0 ? initial_ : step(k).after; }

const Live& Timeline::at(std::int64_t k) {
  if (live_.world().steps() > k) goBackTo(k);
  while (live_.world().steps() < k) {
    applyChanges();
    live_.skip();
    noteStep();
  }
  applyChanges();
  return live_;
}

void Timeline::forgetAfter(std::int64_t k) {
  kept_.erase(kept_.upper_bound(k), kept_.end());
  colors_.erase(colors_.upper_bound(k), colors_.end());
  saved_.erase(saved_.upper_bound(k), saved_.end());
  events_.resize(std::min(events_.size(), static_cast<std::size_t>(k)));
  bodies_ = live_.world().bodies();
}

std::string Timeline::change(std::int64_t k, const std::vector<std::string>& words) {
  at(k);
  std::string told = doByHand(live_, words);
  changes_.resize(applied_);  // those of later are forgotten
  changes_.push_back({.step = k, .words = words, .told = told});
  applied_ = changes_.size();
  forgetAfter(k);
  return told;
}

std::optional<std::int64_t> Timeline::undo(std::size_t count) {
  count = std::min(count, changes_.size());
  if (count == 0) return std::nullopt;
  const std::int64_t k = changes_[changes_.size() - count].step;
  changes_.resize(changes_.size() - count);
  goBackTo(k);
  at(k);
  forgetAfter(k);
  return k;
}

bool Timeline::happens(std::int64_t k, const EventFilter& wanted) const {
  return std::ranges::any_of(events_[static_cast<std::size_t>(k - 1)], wanted);
}

std::optional<std::int64_t> Timeline::nextEvent(std::int64_t k, const EventFilter& wanted) {
  for (std::int64_t i = k + 1; i <= last_; ++i) {
    if (i > static_cast<std::int64_t>(events_.size())) step(i);
    if (happens(i, wanted)) return i;
  }
  return std::nullopt;
}

std::optional<std::int64_t> Timeline::previousEvent(std::int64_t k,
                                                    const EventFilter& wanted) const {
  for (std::int64_t i = k - 1; i >= 1; --i) {
    if (happens(i, wanted)) return i;
  }
  return std::nullopt;
}

}  // namespace merge2d
