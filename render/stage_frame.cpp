#include "render/stage_frame.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "render/stage_marks.h"
#include "render/svg.h"

namespace merge2d {
namespace {

/// Bodies step back behind the marks.
Theme paled(Theme theme) {
  const auto pale = [&](Finish& finish, double fill, double outline) {
    finish.fill = mix(finish.fill, theme.background, fill);
    finish.outline = mix(finish.outline, theme.background, outline);
  };
  for (Finish& finish : theme.collections) pale(finish, 0.62, 0.35);
  pale(theme.free, 0.78, 0.35);
  pale(theme.asleep, 0.5, 0.35);
  return theme;
}

/// With a capital and a full stop.
std::string sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') {
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  }
  return text + ".";
}

/// The eleven stages as a row of cells that ends at `right`; returns where it starts.
float drawRibbon(Painter& painter, const FrameScene& scene, Stage stage, float right,
                 float middle) {
  const float side = scene.px(12.0F), gap = scene.px(3.0F);
  const auto width = static_cast<float>(kStages) * (side + gap) - gap;
  for (std::size_t i = 0; i < kStages; ++i) {
    const float x = std::round(right - width + static_cast<float>(i) * (side + gap));
    const bool now = i == static_cast<std::size_t>(stage);
    const Color ink = scene.theme().ink, soft = mix(ink, scene.theme().background, 0.7);
    painter.box({x, std::round(middle - 0.5F * side), side, side}, scene.px(2.0F),
                {.fill = now ? scene.theme().internal_force : scene.theme().background,
                 .outline = now ? scene.theme().internal_force : soft,
                 .line = scene.px(1.3F)});
  }
  return right - width;
}

/// Step and stage, the time, what the stage does and did.
void drawStageCaption(Painter& painter, const FrameScene& scene, const StepRecord& record,
                      Stage stage, const StageCaption& caption) {
  const Theme& theme = scene.theme();
  const float margin = scene.px(20.0F), gap = scene.px(24.0F);
  const float right = scene.layout.caption.right() - margin;
  const Font title = scene.font(19.0F, Weight::Bold), small = scene.font(13.0F);
  const float first = std::round(scene.px(30.0F)), second = std::round(scene.px(51.0F));
  const float ribbon = drawRibbon(painter, scene, stage, right, first - scene.px(6.0F));
  const std::string head = fmt::format("Step {}, stage {}: {}", record.step,
                                       static_cast<std::size_t>(stage) + 1, name(stage));
  painter.write(painter.text().elided(head, title, ribbon - gap - margin), title, {margin, first},
                theme.ink);
  // What the stage did comes first: where it is long, the scene's title goes.
  const std::string said = caption.purpose + "  " + sentence(caption.summary);
  const std::string time = fmt::format("t = {:.2f} s", record.after.time);
  std::string shown = painter.text().elided(fmt::format("{}  ·  {}", scene.style.title, time),
                                            small, 0.35F * scene.layout.caption.width);
  const float room = right - gap - margin - painter.text().width(said, small);
  if (painter.text().width(shown, small) > room) shown = time;
  const float clock_left = right - painter.text().width(shown, small);
  painter.write(shown, small, {clock_left, second}, theme.ink_soft);
  painter.write(painter.text().elided(said, small, clock_left - gap - margin), small,
                {margin, second}, theme.ink);
}

}  // namespace

StageDrawer::StageDrawer(const std::vector<BodyInfo>& bodies, FrameStyle style)
    : bodies_(bodies), style_(std::move(style)), looks_(bodies) {
  style_.theme = paled(style_.theme);
  style_.overlays = Overlays::standard();
}

Picture StageDrawer::draw(const StepRecord& record, Stage stage, const StageCaption& caption,
                          const Snapshot* reference) {
  if (!canvas_) canvas_.emplace(style_.width, style_.height);
  return canvas_->draw(compose(canvas_->text(), record, stage, caption, reference));
}

std::string StageDrawer::drawSvg(const StepRecord& record, Stage stage, const StageCaption& caption,
                                 const Snapshot* reference) {
  return toSvg(compose(text_, record, stage, caption, reference),
               {.width = style_.width,
                .height = style_.height,
                .title = style_.title,
                .description = describeStage(record, stage, caption, style_)});
}

Drawing StageDrawer::compose(Text& text, const StepRecord& record, Stage stage,
                             const StageCaption& caption, const Snapshot* reference) {
  const Snapshot& shown = record[stage].after;
  colors_.update(record.before);
  const CollectionSlots slots = colors_.update(shown);
  const Layout layout = layoutOf(style_.width, style_.height, style_.overlays);
  const FrameScene scene{
      shown, bodies_, looks_, style_, slots, layout, View(style_.camera, layout.panel)};
  FrameStyle bare = style_;  // of the marks only the springs
  bare.overlays = Overlays().add(Overlay::Scale);
  const FrameScene springs{
      shown, bodies_, looks_, bare, slots, layout, View(style_.camera, layout.panel)};
  Drawing drawing;
  if (!style_.transparent) drawing.background = style_.theme.background;
  Painter painter(drawing, text);
  painter.beginLayer(layout.panel);
  drawBodies(painter, scene);
  drawMarks(painter, springs);
  painter.beginLayer(layout.panel);
  drawStage(painter, scene, record, stage, reference);
  painter.beginLayer();
  drawStageCaption(painter, scene, record, stage, caption);
  return drawing;
}

std::string describeStage(const StepRecord& record, Stage stage, const StageCaption& caption,
                          const FrameStyle& style) {
  return fmt::format("{}. Step {}, stage {} of {}, {}: {} {}", style.title, record.step,
                     static_cast<std::size_t>(stage) + 1, kStages, name(stage), caption.purpose,
                     sentence(caption.summary));
}

}  // namespace merge2d
