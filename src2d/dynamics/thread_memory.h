#pragma once
/// Memory of each thread that takes tasks.

#include <vector>

#include "src2d/dynamics/scratch.h"
#include "src2d/dynamics/task_pool.h"

namespace merge2d {

/// How many of them there are.
inline int threadsOf(const Scratch& scratch) {
  return scratch.tasks ? scratch.tasks->threads() : 1;
}

/// Makes one for each thread that may take a task.
inline void provideMemory(Scratch& scratch) {
  if (scratch.tasks) scratch.sweeps.resize(static_cast<std::size_t>(threadsOf(scratch)));
}

/// Of the caller, whom the other threads help.
inline SweepTools ownTools(Scratch& scratch) {
  return {scratch.sweeps.front(), scratch.sweep_path, scratch.tasks};
}

/// Of a thread that has a task.
inline SweepTools toolsOf(Scratch& scratch, int thread) {
  return {scratch.sweeps[static_cast<std::size_t>(thread)], scratch.sweep_path};
}

}  // namespace merge2d
