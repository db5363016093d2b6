#pragma once
/// Random numbers that RapidCheck draws and shrinks.

#include <rapidcheck.h>

#include "src2d/core/vec.h"

namespace merge2d {

inline double uniform(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) * 1e-6;
}

/// Of a square around the origin, twice as wide as `size`.
inline Vec2 anyVec(double size) { return {uniform(-size, size), uniform(-size, size)}; }

}  // namespace merge2d
