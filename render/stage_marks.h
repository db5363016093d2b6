#pragma once
/// The marks of each stage over the bodies. Internal to the renderer.

#include "render/frame_parts.h"
#include "src2d/recorder.h"

namespace merge2d {

/// Draws the marks of a stage, their labels and the legend; `scene` shows the state after the
/// stage, `reference` may be null.
void drawStage(Painter& painter, const FrameScene& scene, const StepRecord& record, Stage stage,
               const Snapshot* reference);

}  // namespace merge2d
