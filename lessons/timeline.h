#pragma once
/// A run that one can walk through in both directions, and into each of its steps.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "src2d/trace/recorder.h"

namespace merge2d {

/// Records while it goes on, and remembers the steps that were looked at last; for what lies
/// further back it simulates once more from the start, which gives the same numbers bit for bit.
class Timeline {
 public:
  /// `last`: the last step there is.
  Timeline(const Scene& scene, Mode mode, std::int64_t last);

  const Scene& scene() const { return recorder_.world().scene(); }
  Mode mode() const { return recorder_.world().mode(); }
  /// The same also after going back.
  const std::vector<BodyInfo>& bodies() const { return bodies_; }
  std::int64_t last() const { return last_; }

  /// The state before the first step.
  const Snapshot& initial() const { return initial_; }
  /// Step `k` = 1 … last() from the inside; valid until the next call. Throws SimulationError.
  const StepRecord& step(std::int64_t k);
  /// The state after step `k` = 0 … last(); valid until the next call.
  const Snapshot& state(std::int64_t k);

  using EventFilter = std::function<bool(const Event&)>;
  /// The next step after `k` with an event of interest, or none up to the end.
  std::optional<std::int64_t> nextEvent(std::int64_t k, const EventFilter& wanted);
  /// The same backwards.
  std::optional<std::int64_t> previousEvent(std::int64_t k, const EventFilter& wanted) const;

 private:
  void restart();
  void noteEvents();
  void keep(StepRecord record);
  bool happens(std::int64_t k, const EventFilter& wanted) const;

  Scene scene_;
  std::int64_t last_;
  Recorder recorder_;
  std::vector<BodyInfo> bodies_;  ///< a copy: going back begins with another world
  Snapshot initial_;
  std::map<std::int64_t, StepRecord> kept_;
  std::vector<std::vector<Event>> events_;  ///< of each step simulated so far, from step 1 on
};

}  // namespace merge2d
