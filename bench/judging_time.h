#pragma once
/// How long the cycle criteria take inside a running world. The engine knows nothing of it: the
/// linker leads its calls of them (bench/CMakeLists.txt) through functions that look at the clock.

namespace merge2d {

struct JudgingTime {
  double seconds = 0.0;
  long calls = 0;  ///< of heldGroups
};

/// Since the start of the program. No call after a pile has merged means that the function has
/// another name than the linker was told.
JudgingTime judgingTime();

}  // namespace merge2d
