#pragma once
/// The grid on which positions in the world lie.
///
/// Floating-point numbers are coarser far from the origin, so a scene moved by a kilometre would be
/// rounded differently and, if it is chaotic, soon go another way. Here every position is a
/// multiple of 2⁻⁴² m (0.2 pm), which a double holds exactly up to 2 km from the origin: what is
/// added to a position is rounded to the grid first, and the difference of two positions is exact.
/// The motion then depends on differences only, bit for bit. Guarded by
/// Determinism.ASceneMovedByAKilometreHasTheSameEventsAtTheSameSteps.

#include "src2d/core/vec.h"

namespace merge2d {

/// The case of onGrid far from the origin. On its own, so that onGrid is small enough to be
/// inlined.
[[gnu::cold, gnu::noinline]] inline double onGridFarOut(double a) {
  constexpr double kSteps = 0x1p42;
  return std::nearbyint(a * kSteps) / kSteps;
}

/// The nearest multiple of 2⁻⁴² m.
inline double onGrid(double a) {
  constexpr double kShift = 0x1.8p10;  // its last place is the grid's spacing
  constexpr double kReach = 0x1p9;     // up to which adding it does not change its last place
  if (std::abs(a) < kReach) [[likely]]
    return (a + kShift) - kShift;
  return onGridFarOut(a);
}
inline Vec2 onGrid(const Vec2& a) { return {onGrid(a.x()), onGrid(a.y())}; }

/// Where a scene wants something: metres and a decimal part of ten digits, so that the same decimal
/// means the same part of a metre also far from the origin, where it is read less exactly.
inline double placedOnGrid(double a) {
  constexpr double kDigits = 1e10;
  const double metres = std::floor(a);
  return metres + onGrid(std::nearbyint((a - metres) * kDigits) / kDigits);
}
inline Vec2 placedOnGrid(const Vec2& a) { return {placedOnGrid(a.x()), placedOnGrid(a.y())}; }

}  // namespace merge2d
