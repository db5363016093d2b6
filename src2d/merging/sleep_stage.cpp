#include "src2d/merging/sleep_stage.h"

#include <algorithm>

#include "src2d/merging/merge.h"
#include "src2d/merging/rule.h"

namespace merge2d {

void sleepAndWake(State& state, Scratch& scratch) {
  if (!sleeps(state.mode)) return;
  const std::size_t before = scratch.events.size();
  unmergingMethod(state).sleepAndWake(state, scratch);
  const bool any =
      std::any_of(scratch.events.begin() + static_cast<std::ptrdiff_t>(before),
                  scratch.events.end(), [](const Event& e) { return e.type == EventType::Sleep; });
  if (!any) return;
  releaseRows(state, scratch);
  releaseOpenRows(state, scratch, 1);
}

}  // namespace merge2d
