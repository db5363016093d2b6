/// Velocities before and after a stage, and the way of a step.

#include <fmt/format.h>

#include <algorithm>

#include "render/stage_sheet.h"

namespace merge2d {
namespace {

/// The body of a snapshot, or null when it is not alive.
const BodyState* find(const Snapshot& snapshot, BodyId id) {
  const auto found = std::ranges::lower_bound(snapshot.bodies, id, {}, &BodyState::id);
  return found != snapshot.bodies.end() && found->id == id ? &*found : nullptr;
}

/// The fastest body gets an arrow of a sixth of the picture's height at least, so that slow
/// scenes show something too.
double velocityScale(const StageSheet& s) {
  double fastest = 0.0;
  for (const BodyState& b : s.after.bodies) fastest = std::max(fastest, b.v.norm());
  const double wanted = double{s.scene.view.panel.height} / 6.0 / s.scene.view.scale;
  const double usual = s.scene.style.velocity_scale;
  if (fastest <= 0.0) return usual;
  return std::max(usual, std::min(wanted / fastest, 1e3 * usual));
}

}  // namespace

void drawVelocities(StageSheet& s) {
  StagePens& pens = s.pens;
  const Color now = pens.theme().velocity, reference = pens.theme().lines[2];
  const double scale = velocityScale(s);
  const float apart = 3.0F * pens.lineWidth();  // so that none hides another
  for (const BodyState& b : s.after.bodies) {
    if (isFixed(s.scene, b)) continue;
    const BodyState* unmerged = s.reference == nullptr ? nullptr : find(*s.reference, b.id);
    if (unmerged != nullptr) pens.vector(b.x, scale * unmerged->v, reference, 1.0F, -apart);
    const BodyState* old = find(s.before, b.id);
    if (old != nullptr) pens.vector(b.x, scale * old->v, pens.pale(now), 1.0F, apart);
    pens.vector(b.x, scale * b.v, now);
  }
  if (s.reference != nullptr) s.legend.arrow("reference, nothing merged", reference);
  s.legend.arrow("velocity before", pens.pale(now));
  s.legend.arrow("velocity now", now);
  s.legend.words(fmt::format("1 m/s is drawn {} long", lengthLabel(roundLength(scale))));
}

void drawWay(StageSheet& s) {
  StagePens& pens = s.pens;
  double farthest = 0.0;
  for (const BodyState& b : s.after.bodies) {
    if (const BodyState* old = find(s.before, b.id)) {
      farthest = std::max(farthest, (b.x - old->x).norm());
    }
  }
  const double longest = double{s.scene.px(70.0F)} / s.scene.view.scale;
  const double factor = farthest > 0.0 ? roundLength(std::max(1.0, longest / farthest)) : 1.0;
  for (const BodyState& b : s.after.bodies) {
    const BodyState* old = find(s.before, b.id);
    if (old == nullptr || isFixed(s.scene, b)) continue;
    pens.dot(s.scene.view(old->x), 0.5F * pens.radius(), pens.soft());
    pens.vector(old->x, factor * (b.x - old->x), pens.theme().velocity);
  }
  s.legend.dot("before", pens.soft());
  s.legend.arrow(fmt::format("the way of this step, drawn {:.6g} times as long", factor),
                 pens.theme().velocity);
}

}  // namespace merge2d
