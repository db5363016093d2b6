#pragma once
/// When a placement of pins is degenerate.

namespace merge2d {

/// A set of pins is degenerate when a displacement by this part of its size makes it so: three pins
/// on a line, three parallel links.
inline constexpr double kRankTolerance = 1e-6;

/// Contact points are the same when they are nearer than this part of the largest coordinate: below
/// it, numbers in single precision are.
inline constexpr double kPointTolerance = 1e-8;

}  // namespace merge2d
