#pragma once
/// The sheet on which a stage draws its marks, and what each stage draws. Internal to the renderer.

#include <map>

#include "render/stage_legend.h"
#include "render/stage_pens.h"
#include "src2d/recorder.h"

namespace merge2d {

struct StageSheet {
  StageSheet(Painter& on, const FrameScene& shown, const StepRecord& of, Stage stage,
             const Snapshot* unmerged)
      : painter(on),
        scene(shown),
        record(of),
        before(of.before_stage(stage)),
        after(of[stage].after),
        reference(unmerged),
        pens(on, shown),
        legend(shown) {}

  Painter& painter;
  const FrameScene& scene;  ///< the state after the stage
  const StepRecord& record;
  const Snapshot& before;     ///< the stage
  const Snapshot& after;      ///< the stage
  const Snapshot* reference;  ///< the unmerged run after the same step; may be null
  StagePens pens;
  StageLegend legend;
};

/// Where two bodies meet: the mean of their contact points.
std::map<BodyPair, Vec2> meetings(const Snapshot& snapshot);

// stage_contacts.cpp
void drawContactsFound(StageSheet& s);  ///< ContactDetection
void drawSweepOrder(StageSheet& s);     ///< ContactOrdering

// stage_impulses.cpp
void drawWarmStart(StageSheet& s);
void drawSweep(StageSheet& s);     ///< SingleIterationPGS
void drawSolution(StageSheet& s);  ///< SolveLCP

// stage_motion.cpp
void drawVelocities(StageSheet& s);  ///< AdvanceVelocities
void drawWay(StageSheet& s);         ///< AdvancePositions

// stage_corners.cpp
void drawCorners(StageSheet& s);  ///< AccumulateRelativeMotion

// stage_collections.cpp
void drawSleep(StageSheet& s);  ///< SleepAndWake
void drawUnmerge(StageSheet& s);
void drawMerge(StageSheet& s);

}  // namespace merge2d
