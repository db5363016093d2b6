#pragma once
/// Pictures of stages as files.

#include <memory>
#include <optional>
#include <string>

#include "render/stage_frame.h"
#include "src2d/world.h"

namespace merge2d {

/// The text above a stage's picture.
StageCaption captionOf(const StepRecord& record, Stage stage);

/// Draws stages of one scene, in a picture of a fixed camera.
class StagePictures {
 public:
  StagePictures(const Scene& scene, Mode mode, FrameStyle style = {});

  /// A state before the step that is drawn, in which collections may have got their colours.
  void note(const Snapshot& snapshot);
  /// Draws a stage, or without a record the state before the first step, into a file: vector
  /// graphics where its name ends in .svg. Returns the line that the stage tells about
  /// its result. Throws IoError.
  std::string save(const StepRecord* record, Stage stage, const std::string& file);

  const FrameStyle& style() const { return style_; }

 private:
  std::string saveStart(const std::string& file) const;
  /// The scene's, or one that is nearer and shows all bodies.
  Camera cameraFor(const Snapshot& snapshot) const;
  /// The state of the unmerged run after a step; null when the run is that itself.
  const Snapshot* reference(std::int64_t step);

  Scene scene_;
  Mode mode_;
  World start_;  ///< before the first step
  FrameStyle style_;
  std::optional<StageDrawer> drawer_;  ///< made for the first picture of a stage
  std::optional<World> reference_;
  Snapshot reference_state_;
};

}  // namespace merge2d
