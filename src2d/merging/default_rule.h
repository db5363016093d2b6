#pragma once
/// `rule = "default"`: the cures that 2D needs (docs/decisions/cures.md).

#include "src2d/merging/rule.h"

namespace merge2d {

extern const MergingMethod kDefaultMerging;
extern const UnmergingMethod kDefaultUnmerging;

}  // namespace merge2d
