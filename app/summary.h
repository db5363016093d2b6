#pragma once
/// The summary of a run.

#include <array>
#include <optional>
#include <string>

#include "app/reference_end.h"
#include "app/simulation.h"

namespace merge2d {

/// Counts what happens while a run goes on.
class Summary {
 public:
  /// Begins with what there is before the first step.
  explicit Summary(const World& world);

  /// Takes note of the step that just ended.
  void add(const World& world);

  /// Takes note of how far the run ended from the reference.
  void setError(const ReferenceError& error) { error_ = error; }

  /// The numbers with their units, for people.
  std::string table(const Simulation& simulation, bool timings) const;
  /// One object; without timings what was measured in seconds is null.
  std::string json(const Simulation& simulation, bool timings) const;

 private:
  /// Of unmerges: one per EventReason.
  using Reasons = std::array<std::int64_t, kEventReasons.size()>;

  std::int64_t merges_ = 0, unmerges_ = 0, broken_joints_ = 0;
  Reasons reasons_{};
  double max_penetration_ = 0.0;  ///< of all steps [m]
  std::optional<ReferenceError> error_;
};

}  // namespace merge2d
