#pragma once
/// One stage of Algorithm 1 in one step, as a picture.

#include <optional>
#include <string>
#include <vector>

#include "render/canvas.h"
#include "render/palette.h"
#include "render/silhouette.h"
#include "render/style.h"
#include "src2d/recorder.h"

namespace merge2d {

/// The text above the picture of a stage, beside its number and name.
struct StageCaption {
  std::string purpose;  ///< what the stage does
  std::string summary;  ///< what it did in this step
};

/// Draws stages of a run's steps; feed it with steps in order, so that colours stay.
class StageDrawer {
 public:
  /// `bodies` must outlive the drawer.
  StageDrawer(const std::vector<BodyInfo>& bodies, FrameStyle style);

  /// The part of the world in the pictures that follow.
  void look(const Camera& camera) { style_.camera = camera; }
  /// A state that is not drawn: the colours of its collections are kept.
  void note(const Snapshot& snapshot) { colors_.update(snapshot); }

  /// `reference`: the state of the unmerged run after the same step, for AdvanceVelocities; may be
  /// null.
  Picture draw(const StepRecord& record, Stage stage, const StageCaption& caption,
               const Snapshot* reference = nullptr);
  /// The same as an SVG document, for which no OpenGL is needed.
  std::string drawSvg(const StepRecord& record, Stage stage, const StageCaption& caption,
                      const Snapshot* reference = nullptr);

 private:
  Drawing compose(Text& text, const StepRecord& record, Stage stage, const StageCaption& caption,
                  const Snapshot* reference);

  const std::vector<BodyInfo>& bodies_;
  FrameStyle style_;
  BodyLooks looks_;
  CollectionColors colors_;
  std::optional<Canvas> canvas_;  ///< made for the first picture of pixels
  Text text_;                     ///< of the others
};

/// A description of the picture, for those who cannot see it.
std::string describeStage(const StepRecord& record, Stage stage, const StageCaption& caption,
                          const FrameStyle& style);

}  // namespace merge2d
