#include "app/stage_pictures.h"

#include "app/output_file.h"
#include "lessons/tables.h"
#include "render/camera.h"
#include "render/frame.h"
#include "render/png.h"
#include "render/svg.h"

namespace merge2d {
namespace {

constexpr Mode kReference = Mode::Reference;

FrameStyle adapted(FrameStyle style, const World& start) {
  style.mode = start.mode();
  adaptToScene(style, start.scene(), start.capture(), start.bodies());
  return style;
}

bool isSvg(const std::string& file) { return file.ends_with(".svg"); }

}  // namespace

StageCaption captionOf(const StepRecord& record, Stage stage) {
  return {purpose(stage), summary(record, stage)};
}

StagePictures::StagePictures(const Scene& scene, Mode mode, FrameStyle style)
    : scene_(scene),
      mode_(mode),
      start_(scene, {.mode = mode, .timings = false}),
      style_(adapted(std::move(style), start_)) {}

const Snapshot* StagePictures::reference(std::int64_t step) {
  if (mode_ == kReference) return nullptr;
  if (!reference_ || reference_->steps() > step) {
    reference_.emplace(scene_, WorldOptions{.mode = kReference, .timings = false});
  }
  while (reference_->steps() < step) reference_->step();
  reference_->capture(reference_state_);
  return &reference_state_;
}

Camera StagePictures::cameraFor(const Snapshot& snapshot) const {
  const Layout layout = layoutOf(style_.width, style_.height, Overlays::standard());
  const Camera fit = fitCamera(snapshot, start_.bodies(),
                               double{layout.panel.width} / double{layout.panel.height});
  return fit.height < style_.camera.height ? fit : style_.camera;
}

void StagePictures::note(const Snapshot& snapshot) {
  if (!drawer_) drawer_.emplace(start_.bodies(), style_);
  drawer_->note(snapshot);
}

std::string StagePictures::save(const StepRecord* record, Stage stage, const std::string& file) {
  if (record == nullptr) return saveStart(file);
  if (!drawer_) drawer_.emplace(start_.bodies(), style_);
  drawer_->look(cameraFor(record->before));
  const bool compare = stage == Stage::AdvanceVelocities;
  const Snapshot* other = compare ? reference(record->step) : nullptr;
  const StageCaption caption = captionOf(*record, stage);
  const std::string text = describeStage(*record, stage, caption, style_);
  if (isSvg(file)) {
    writeFile(file, drawer_->drawSvg(*record, stage, caption, other), {.everything = true});
  } else {
    savePng(file, drawer_->draw(*record, stage, caption, other),
            {.alpha = style_.transparent, .description = text});
  }
  return text;
}

std::string StagePictures::saveStart(const std::string& file) const {
  const Snapshot initial = start_.capture();
  const std::string text = describe(initial, style_);
  if (isSvg(file)) {
    Text letters;
    const BodyLooks looks(start_.bodies());
    const Drawing drawing = composeFrame(letters, initial, start_.bodies(), looks, style_,
                                         CollectionColors().update(initial));
    const SvgOptions options{
        .width = style_.width, .height = style_.height, .title = style_.title, .description = text};
    writeFile(file, toSvg(drawing, options), {.everything = true});
    return text;
  }
  Canvas canvas(style_.width, style_.height);
  savePng(file, drawFrame(canvas, initial, start_.bodies(), style_),
          {.alpha = style_.transparent, .description = text});
  return text;
}

}  // namespace merge2d
