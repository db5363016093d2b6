#pragma once
/// The events of a film, in words and with times (WebVTT).

#include <map>
#include <string>
#include <utility>

#include "src2d/trace/snapshot.h"

namespace merge2d {

/// One caption for each second in which something happens.
class Captions {
 public:
  /// Takes note of what the step that just ended brought.
  void add(const Snapshot& snapshot);

  /// The whole file; `title` is the caption of the first second as well.
  std::string text(const std::string& title) const;

 private:
  struct Second {
    /// Whole collections fall asleep and wake up: those are counted apart.
    std::map<std::pair<EventType, bool>, int> events;
    std::map<EventReason, int> reasons;  ///< of the unmerges
    int bodies = 0, collections = 0, asleep = 0;
  };
  static std::string describe(const Second& second);

  std::map<std::int64_t, Second> seconds_;  ///< those with events, by number
};

}  // namespace merge2d
