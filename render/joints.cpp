/// Joints: small signs at the places where they hold; those that broke are gone.

#include "render/frame_parts.h"

namespace merge2d {
namespace {

/// A ring: the bodies turn about it. One that is fixed to the world is filled.
void drawPivot(Painter& painter, const FrameScene& scene, Pixel at, bool fixed) {
  const Theme& theme = scene.theme();
  const float radius = scene.px(4.0F);
  painter.disc(at, radius + scene.px(1.0F), {.fill = theme.rim});
  painter.disc(
      at, radius,
      {.fill = fixed ? theme.spring : theme.rim, .outline = theme.spring, .line = scene.px(1.5F)});
}

/// A small square plate.
void drawPlate(Painter& painter, const FrameScene& scene, Pixel at, Pixel axis, float half) {
  const Theme& theme = scene.theme();
  painter.box(at, axis, {half, half}, scene.px(1.0F), {.fill = theme.rim});
  painter.box(at, axis, {half, half}, 0.0F, {.fill = theme.spring});
}

void drawRod(Painter& painter, const FrameScene& scene, Pixel a, Pixel b) {
  const Theme& theme = scene.theme();
  painter.line(a, b, scene.px(4.0F), theme.rim);
  painter.line(a, b, scene.px(2.0F), theme.spring);
  for (const Pixel end : {a, b}) painter.disc(end, scene.px(2.5F), {.fill = theme.spring});
}

/// A rail along the axis and the slide on it.
void drawSlide(Painter& painter, const FrameScene& scene, const JointView& joint) {
  const Pixel from = scene.view(joint.from), at = scene.view(joint.to);
  const auto x = static_cast<float>(joint.axis.x()), y = static_cast<float>(joint.axis.y());
  const Pixel axis{x, -y};  // the picture's y points down
  const Pixel reach = axis * scene.px(14.0F);
  painter.line(from - reach, at + reach, scene.px(3.5F), scene.theme().rim);
  painter.line(from - reach, at + reach, scene.px(1.5F), scene.theme().spring);
  drawPlate(painter, scene, at, axis, scene.px(3.5F));
}

}  // namespace

void drawJoints(Painter& painter, const FrameScene& scene) {
  for (const JointView& joint : scene.snapshot.joints) {
    const bool there = scene.body(joint.a) && (joint.to_world || scene.body(joint.b));
    if (joint.broken || !there) continue;
    switch (joint.kind) {
      case JointKind::Revolute:
        drawPivot(painter, scene, scene.view(joint.to), joint.to_world);
        break;
      case JointKind::Weld:
        drawPlate(painter, scene, scene.view(joint.to), {1.0F, 0.0F}, scene.px(3.0F));
        break;
      case JointKind::Distance:
        drawRod(painter, scene, scene.view(joint.from), scene.view(joint.to));
        break;
      case JointKind::Prismatic:
        drawSlide(painter, scene, joint);
        break;
    }
  }
}

}  // namespace merge2d
