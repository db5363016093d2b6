#include "render/frame.h"

#include <fmt/format.h>

#include <utility>

#include "render/frame_parts.h"
#include "render/label_painter.h"

namespace merge2d {

Drawing composeFrame(Text& text, const Snapshot& snapshot, const std::vector<BodyInfo>& bodies,
                     const BodyLooks& looks, const FrameStyle& style,
                     const CollectionSlots& slots) {
  const Layout layout = layoutOf(style.width, style.height, style.overlays);
  const FrameScene scene{
      snapshot, bodies, looks, style, slots, layout, View(cameraAt(style, snapshot), layout.panel)};
  Drawing drawing;
  if (!style.transparent) drawing.background = style.theme.background;
  Painter painter(drawing, text);

  painter.beginLayer(layout.panel);
  drawBodies(painter, scene);
  const FrameLabels labels(text, scene);
  for (const CollectionView* c : labels.without) drawTogether(painter, scene, *c);
  drawMarks(painter, scene);
  painter.beginLayer(layout.panel);
  labels.plates.draw(painter);
  painter.beginLayer();
  drawCaption(painter, scene);
  drawFooter(painter, scene);
  return drawing;
}

std::string describe(const Snapshot& snapshot, const FrameStyle& style) {
  std::string out = fmt::format("{}. Step {}, t = {:.2f} s, {}:", style.title, snapshot.step,
                                snapshot.time, name(style.mode));
  const char* separator = " ";
  for (const Count& count : countsOf(snapshot, style.mode)) {
    out +=
        fmt::format("{}{} {}", separator, count.number, count.number == 1 ? count.one : count.many);
    separator = ", ";
  }
  return out + ".";
}

FrameDrawer::FrameDrawer(const std::vector<BodyInfo>& bodies, FrameStyle style)
    : bodies_(bodies),
      style_(std::move(style)),
      looks_(bodies),
      canvas_(style_.width, style_.height) {}

Picture FrameDrawer::draw(const Snapshot& snapshot) {
  const CollectionSlots slots = colors_.update(snapshot);
  return canvas_.draw(composeFrame(canvas_.text(), snapshot, bodies_, looks_, style_, slots));
}

Picture drawFrame(Canvas& canvas, const Snapshot& snapshot, const std::vector<BodyInfo>& bodies,
                  const FrameStyle& style) {
  const CollectionSlots slots = CollectionColors().update(snapshot);
  return canvas.draw(
      composeFrame(canvas.text(), snapshot, bodies, BodyLooks(bodies), style, slots));
}

}  // namespace merge2d
