#pragma once
/// The motion of a body in few samples: between two of them it moves on a straight line and turns
/// evenly, never farther than a tolerance from where it was.
///
/// Source: Bristol, "Swinging door trending" (1990): from the last keyframe each sample leaves a
/// range of slopes that pass close enough; when the newest sample lies outside of that range, the
/// one before it becomes a keyframe. A sample costs the same however far the last keyframe is.

#include <array>
#include <cstdint>
#include <vector>

#include "lessons/recording.h"

namespace merge2d {

class KeyframeFilter {
 public:
  /// Fills the tracks of `out`, which must outlive this; its bodies are there already.
  explicit KeyframeFilter(Recording& out);

  /// The state of a body after a step; steps ascend.
  void add(std::int64_t step, const BodyState& body);
  /// Keeps the last sample of each body.
  void finish();

 private:
  struct Range {
    double least = 0.0, most = 0.0;
  };
  struct Door {
    std::int64_t from = 0;           ///< step of the last keyframe
    std::array<double, 3> origin{};  ///< x [m], y [m], angle [rad] there
    std::array<Range, 3> slopes{};   ///< per step
    std::int64_t last = 0;           ///< step of the newest sample
    BodyState newest{};
    double reach = 0.0;  ///< from the centre to the farthest point of the body [m]
  };

  void keep(Door& door);
  bool passes(const Door& door, std::int64_t step, const BodyState& body) const;
  void narrow(Door& door, std::int64_t step, const BodyState& body) const;

  Recording& out_;
  double tolerance_ = 0.0;  ///< [m]
  std::vector<Door> doors_;
};

}  // namespace merge2d
