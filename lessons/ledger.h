#pragma once
/// Momentum and energy before and after the stages that merge and unmerge.

#include <vector>

#include "lessons/recording.h"
#include "src2d/recorder.h"
#include "src2d/trace/json_text.h"

namespace merge2d {

/// The entries of one recorded step: none, or one for Unmerge and one for Merge.
std::vector<LedgerEntry> ledgerOf(const StepRecord& record, const std::vector<BodyInfo>& bodies);

/// As a row: step, stage, anchored, then each sum before and after.
void writeLedger(JsonText& out, const LedgerEntry& entry);

}  // namespace merge2d
