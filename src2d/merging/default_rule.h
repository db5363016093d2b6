#pragma once
/// `rule = "default"`: the paper's rule with the cures that 2D needs (docs/decisions/cures.md).
///
/// The single sweep goes on where something is new (refined_sweep.h). Evidence against a weld is
/// summed over steps (weld_checks.h) and confirmed by more sweeps before a collection splits, into
/// parts that must be rigid groups (default_unmerge.h). Parts that would not move stay (trial.h),
/// and a collection whose model of a few rigid parts is not in equilibrium splits (footing.h).
/// Islands sleep and wake as a whole (sleep.h).

#include "src2d/merging/rule.h"

namespace merge2d {

extern const MergingMethod kDefaultMerging;
extern const UnmergingMethod kDefaultUnmerging;

}  // namespace merge2d
