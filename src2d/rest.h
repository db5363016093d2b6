#pragma once
/// A world in which everything sleeps: its steps are left out, as they would change nothing.
///
/// A step is a function of the state and of the loads that act in it. After a step in which
/// everything slept and nothing happened, the state is compared with the one before: when they
/// agree in all but the time, so will those of all steps to come, until something acts. The loads
/// are known at the start of a step, so a step of a world at rest costs a look at that, whatever
/// the number of bodies.

#include <cstdint>
#include <optional>
#include <vector>

#include "src2d/contact/parking.h"
#include "src2d/setup.h"

namespace merge2d {

class Rest {
 public:
  /// True when the step that has just begun changes nothing but the time.
  bool holdsFor(const Setup& setup, const Scratch& scratch) const;
  /// Looks at the world after a whole step.
  void lookAt(const Setup& setup, const Scratch& scratch);
  /// The world has been changed from outside.
  void forget() { *this = {}; }

 private:
  bool known_ = false;
  std::vector<Load> loads_;            ///< under which it rests
  std::optional<std::uint64_t> seen_;  ///< the state after the last step, but for the time
  int wait_ = kStepsUntilParked;       ///< steps until it is compared again; by then all is parked
  int next_wait_ = 1;
};

}  // namespace merge2d
