#pragma once
/// One recorded time step as JSON, for a page that simulates itself: lessons/web/src/live.ts reads
/// it and shows it as it shows a step of a prepared run.

#include <string>
#include <vector>

#include "render/palette.h"
#include "src2d/recorder.h"

namespace merge2d {

/// The state alone, before anything has moved on from it.
std::string stateText(const Snapshot& seen, const std::vector<BodyInfo>& bodies,
                      const CollectionSlots& colors = {});

/// A step with its decisions, events, impulses before and after the single sweep, ledger, and the
/// result of each stage in a few words.
std::string stepText(const StepRecord& record, const std::vector<BodyInfo>& bodies,
                     const CollectionSlots& colors = {});

}  // namespace merge2d
