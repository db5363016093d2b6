#include "render/stage_marks.h"

#include "render/stage_sheet.h"

namespace merge2d {
namespace {

void drawMarksOf(Stage stage, StageSheet& sheet) {
  switch (stage) {
    case Stage::ContactDetection:
      return drawContactsFound(sheet);
    case Stage::ContactOrdering:
      return drawSweepOrder(sheet);
    case Stage::SleepAndWake:
      return drawSleep(sheet);
    case Stage::WarmStart:
      return drawWarmStart(sheet);
    case Stage::SingleIterationPGS:
      return drawSweep(sheet);
    case Stage::Unmerge:
      return drawUnmerge(sheet);
    case Stage::SolveLCP:
      return drawSolution(sheet);
    case Stage::AdvanceVelocities:
      return drawVelocities(sheet);
    case Stage::AccumulateRelativeMotion:
      return drawCorners(sheet);
    case Stage::AdvancePositions:
      return drawWay(sheet);
    case Stage::Merge:
      return drawMerge(sheet);
  }
}

}  // namespace

void drawStage(Painter& painter, const FrameScene& scene, const StepRecord& record, Stage stage,
               const Snapshot* reference) {
  StageSheet sheet(painter, scene, record, stage, reference);
  drawMarksOf(stage, sheet);
  painter.beginLayer(scene.layout.panel);
  sheet.pens.drawLabels();
  painter.beginLayer();
  sheet.legend.draw(painter);
}

}  // namespace merge2d
