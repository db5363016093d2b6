#include "lessons/timeline.h"

#include <algorithm>

namespace merge2d {
namespace {

/// How many steps are remembered …
constexpr std::size_t kKept = 48;
/// … and how many of them before the one that one went back to.
constexpr std::int64_t kBefore = 24;

}  // namespace

Timeline::Timeline(const Scene& scene, Mode mode, std::int64_t last)
    : scene_(scene),
      last_(last),
      recorder_(scene, mode),
      bodies_(recorder_.world().bodies()),
      initial_(recorder_.world().capture()) {}

void Timeline::restart() { recorder_ = Recorder(scene_, mode()); }

void Timeline::noteEvents() {
  const World& world = recorder_.world();
  if (static_cast<std::int64_t>(events_.size()) < world.steps()) events_.push_back(world.events());
}

void Timeline::keep(StepRecord record) {
  const std::int64_t k = record.step;
  kept_.insert_or_assign(k, std::move(record));
  // The one farthest from here goes.
  while (kept_.size() > kKept) {
    const bool first = k - kept_.begin()->first >= kept_.rbegin()->first - k;
    kept_.erase(first ? kept_.begin() : std::prev(kept_.end()));
  }
}

const StepRecord& Timeline::step(std::int64_t k) {
  if (const auto found = kept_.find(k); found != kept_.end()) return found->second;
  std::int64_t record_from = k;
  if (recorder_.world().steps() >= k) {
    restart();
    record_from = std::max<std::int64_t>(1, k - kBefore);
  }
  while (recorder_.world().steps() < k) {
    if (recorder_.world().steps() + 1 >= record_from) {
      keep(recorder_.record());
    } else {
      recorder_.skip();
    }
    noteEvents();
  }
  return kept_.at(k);
}

const Snapshot& Timeline::state(std::int64_t k) { return k == 0 ? initial_ : step(k).after; }

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
