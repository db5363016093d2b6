#pragma once
/// The numbers that a setting accepts.

#include <string_view>

#include "src2d/scene/scene.h"

namespace merge2d {

/// A closed range and the words for it in "'mass' must be …".
struct Range {
  double lower = -SceneLimits::kNumber;
  double upper = SceneLimits::kNumber;
  std::string_view words = "a finite number below 1e12 in size";
};

inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{1e-12, SceneLimits::kNumber, "positive (1e-12 to 1e12)"};
inline constexpr Range kNotNegative{0, SceneLimits::kNumber, "0 or more"};
inline constexpr Range kFraction{0, 1, "between 0 and 1"};
inline constexpr Range kAtLeastOne{1, 1e6, "between 1 and 1000000"};
inline constexpr Range kCountedSteps{1, 3e4, "between 1 and 30000"};
inline constexpr Range kSeed{0, 9.2e18, "between 0 and 9.2e18"};
inline constexpr Range kStep{1e-6, 1.0, "between 1e-6 and 1 s"};
inline constexpr Range kDuration{1e-6, 1e6, "between 1e-6 and 1e6 s"};
inline constexpr Range kPosition{-SceneLimits::kCoordinate, SceneLimits::kCoordinate,
                                 "between -1e6 and 1e6 m"};
/// Of a shape's corner in its body, when the shape stands where it belongs.
inline constexpr Range kCorner{-4 * SceneLimits::kCoordinate, 4 * SceneLimits::kCoordinate,
                               "between -4e6 and 4e6 m"};
inline constexpr Range kLength{SceneLimits::kSmallest, SceneLimits::kCoordinate,
                               "a positive length (1e-4 to 1e6 m)"};

}  // namespace merge2d
