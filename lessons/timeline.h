#pragma once
/// A run that one can walk through in both directions, into each of its steps, and change by hand.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lessons/live.h"

namespace merge2d {

/// A change by a person between two steps.
struct HandChange {
  std::int64_t step = 0;           ///< after which
  std::vector<std::string> words;  ///< lessons/hand.h
  std::string told;                ///< "pinned brick[0,1]"
};

/// Records while it goes on, and remembers the steps that were looked at last; for what lies
/// further back it simulates once more from a state that was kept, which gives the same numbers bit
/// for bit, with all changes.
class Timeline {
 public:
  /// `last`: the last step there is.
  Timeline(const Scene& scene, Mode mode, std::int64_t last);

  const Scene& scene() const { return live_.world().scene(); }
  Mode mode() const { return live_.world().mode(); }
  /// The same also after going back; a change may add some.
  const std::vector<BodyInfo>& bodies() const { return bodies_; }
  std::int64_t last() const { return last_; }

  /// The state before the first step.
  const Snapshot& initial() const { return initial_; }
  /// Step `k` = 1 … last() from the inside; valid until the next call. Throws SimulationError.
  const StepRecord& step(std::int64_t k);
  /// The state after step `k` = 0 … last(); valid until the next call.
  const Snapshot& state(std::int64_t k);
  /// The run after step `k` and the changes made there.
  const Live& at(std::int64_t k);
  /// The colours of the collections after step `k`, of the last 48 that were looked at.
  const CollectionSlots& colors(std::int64_t k) const { return colors_.at(k); }

  /// Changes the run after step `k`; later changes are forgotten. Returns a sentence about the
  /// change. Throws Refusal; then nothing has changed.
  std::string change(std::int64_t k, const std::vector<std::string>& words);
  /// Takes the last changes back, as far as there are so many. Returns the step of the first one.
  std::optional<std::int64_t> undo(std::size_t count = 1);
  const std::vector<HandChange>& changes() const { return changes_; }

  using EventFilter = std::function<bool(const Event&)>;
  /// The next step after `k` with an event of interest, or none up to the end.
  std::optional<std::int64_t> nextEvent(std::int64_t k, const EventFilter& wanted);
  /// The same backwards.
  std::optional<std::int64_t> previousEvent(std::int64_t k, const EventFilter& wanted) const;

 private:
  void goBackTo(std::int64_t k);
  void applyChanges();
  void noteStep();
  void forgetAfter(std::int64_t k);
  void keep(StepRecord record);
  bool happens(std::int64_t k, const EventFilter& wanted) const;

  std::int64_t last_;
  Live live_;
  std::vector<BodyInfo> bodies_;  ///< a copy: going back begins with another world
  Snapshot initial_;
  std::map<std::int64_t, StepRecord> kept_;
  std::map<std::int64_t, CollectionSlots> colors_;  ///< of the kept steps
  std::map<std::int64_t, Live::Saved> saved_;       ///< after steps, before the changes made there
  std::vector<std::vector<Event>> events_;  ///< of each step simulated so far, from step 1 on
  std::vector<HandChange> changes_;         ///< in order
  std::size_t applied_ = 0;                 ///< so many of them are in `live_`
};

}  // namespace merge2d
