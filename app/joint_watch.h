#pragma once
/// Watches whether joints hold their two points together (docs/limits.md): not the length of rods,
/// nor angles.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "src2d/world.h"

namespace merge2d {

class JointWatch {
 public:
  /// The world must outlive the watch, and must be as its scene begins.
  explicit JointWatch(const World& world);

  /// To be called after each step.
  void update();

  /// A sentence on the joint that opened farthest, if that is by more than 1 % of the length of the
  /// shorter body, or 1 cm. Joints that give way by their own compliance are not meant.
  std::optional<std::string> warning() const;

 private:
  const World& world_;
  std::vector<double>
      thresholds_;  ///< per joint of the scene: a warning tells of wider openings [m]
  std::size_t worst_ = 0;
  double opening_ = 0.0;  ///< of that joint [m]
};

}  // namespace merge2d
