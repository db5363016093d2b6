#pragma once
/// What there is to say about a run when it is over.

#include <string>

#include "app/simulation.h"

namespace merge2d {

/// Counts what happens while a run goes on.
class Summary {
 public:
  /// Takes note of the step that just ended.
  void add(const Snapshot& snapshot);

  /// The numbers with their units, for people.
  std::string table(const Simulation& simulation, bool timings) const;
  /// One object; without timings what was measured in seconds is null.
  std::string json(const Simulation& simulation, bool timings) const;

 private:
  std::int64_t merges_ = 0, unmerges_ = 0, broken_joints_ = 0;
  double max_penetration_ = 0.0;  ///< of all steps [m]
};

}  // namespace merge2d
