/// Impulses: of the last step, before and after the sweep, and of the full solve.

#include <algorithm>
#include <array>
#include <cmath>

#include "render/stage_sheet.h"

namespace merge2d {
namespace {

Vec2 impulseOf(const ContactView& c) {
  return c.lambda_n * c.normal + c.lambda_t * perpendicular(c.normal);
}

/// The part of its cone that a contact's friction takes.
double coneUsed(const ContactView& c) {
  return c.lambda_n > 0.0 && c.mu > 0.0 ? std::abs(c.lambda_t) / (c.mu * c.lambda_n) : 0.0;
}

/// On the edge, but for rounding.
bool onEdge(const ContactView& c) { return coneUsed(c) >= 0.99; }

/// All but the strongest impulses are shorter than a body [m per N s].
double impulseScale(const StageSheet& s) {
  std::vector<double> sizes;
  for (const Snapshot* snapshot : {&s.before, &s.after}) {
    for (const ContactView& c : snapshot->contacts) {
      const double size = std::hypot(c.lambda_n, c.lambda_t);
      if (size > 0.0) sizes.push_back(size);
    }
  }
  if (sizes.empty()) return 0.0;
  const auto strong =
      sizes.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, strong);
  return 0.8 * s.scene.looks.typical_width / *strong;
}

void drawImpulses(StageSheet& s, const Snapshot& of, Color color, float thicker) {
  const double scale = impulseScale(s);
  for (const ContactView& c : of.contacts) {
    s.pens.vector(c.x, scale * impulseOf(c), color, thicker);
  }
}

/// The cone of the contact's friction, on the side of b.
void drawCone(StageSheet& s, const ContactView& c) {
  const float reach = std::clamp(0.45F * s.scene.bodySize(), s.scene.px(14.0F), s.scene.px(60.0F));
  const Pixel at = s.scene.view(c.x);
  const Vec2 t = perpendicular(c.normal);
  const Vec2 left = (c.normal + c.mu * t).normalized(), right = (c.normal - c.mu * t).normalized();
  const std::array<Pixel, 3> corners{at, at + View::direction(left) * reach,
                                     at + View::direction(right) * reach};
  const Color color = s.pens.bad();
  s.painter.polygon(corners, 0.0F, {.fill = withAlpha(color, 0.16)});
  for (const Vec2& side : {left, right}) {
    s.painter.line(at, at + View::direction(side) * reach, s.scene.px(1.2F), withAlpha(color, 0.7));
  }
}

}  // namespace

void drawWarmStart(StageSheet& s) {
  drawImpulses(s, s.after, s.pens.good(), 1.0F);
  s.legend.arrow("impulses of the last step", s.pens.good());
}

void drawSweep(StageSheet& s) {
  const Color old = mix(s.pens.soft(), s.pens.theme().background, 0.35);
  drawImpulses(s, s.before, old, 2.2F);
  drawImpulses(s, s.after, s.pens.good(), 1.0F);
  s.legend.arrow("impulse before the sweep", old);
  s.legend.arrow("after it", s.pens.good());
}

void drawSolution(StageSheet& s) {
  StagePens& pens = s.pens;
  for (const ContactView& c : s.after.contacts) {
    if (!c.internal && onEdge(c)) drawCone(s, c);
  }
  const double scale = impulseScale(s);
  for (const ContactView& c : s.after.contacts) {
    if (c.internal) continue;
    const Color color = onEdge(c) ? pens.bad() : pens.heat(std::min(coneUsed(c), 0.98));
    pens.vector(c.x, scale * impulseOf(c), color);
    if (c.lambda_n <= 0.0) {
      pens.cross(s.scene.view(c.x), 0.6F * pens.radius(), pens.soft());
    } else {
      pens.dot(s.scene.view(c.x), 0.6F * pens.radius(), color);
    }
  }
  for (const ContactView& c : s.after.contacts) {
    if (c.internal) drawMergedMark(s.painter, s.scene, s.scene.view(c.x), 0.6F * pens.radius());
  }
  s.legend.arrow("impulse, well inside its cone", pens.heat(0.0));
  s.legend.arrow("near the edge", pens.heat(0.98));
  s.legend.arrow("on the edge, with the cone", pens.bad());
  s.legend.cross("no force", pens.soft());
  s.legend.mergedMark("merged: not solved");
}

}  // namespace merge2d
