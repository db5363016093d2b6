#include "render/style.h"

#include <algorithm>
#include <cmath>

#include "render/camera.h"
#include "render/silhouette.h"

namespace merge2d {
namespace {

constexpr double kGravity = 9.81;  // [m/s²], for scales only

/// Forces grow towards the bottom of a stack, so the arrow of one body's weight is the shorter the
/// more bodies find room above each other.
double automaticForceScale(const std::vector<BodyInfo>& bodies, double typical, double height) {
  double mass = 0.0;
  int count = 0;
  for (const BodyInfo& body : bodies) {
    if (body.motion != Motion::Dynamic) continue;
    mass += body.mass;
    ++count;
  }
  if (count == 0 || mass <= 0.0) return 0.0;
  const double rows = std::clamp(0.6 * height / typical, 1.0, 40.0);
  return 2.0 * typical / (rows * kGravity * mass / count);
}

const BodyState* bodyIn(const Snapshot& snapshot, BodyId id) {
  const auto at = std::ranges::find(snapshot.bodies, id, &BodyState::id);
  return at == snapshot.bodies.end() ? nullptr : &*at;
}

void followFrom(FrameStyle& style, BodyId body, const Snapshot& initial) {
  style.followed = body;
  if (const BodyState* at = bodyIn(initial, body)) style.followed_from = at->x;
}

}  // namespace

Camera cameraAt(const FrameStyle& style, const Snapshot& now) {
  Camera camera = style.camera;
  const BodyState* followed = style.followed ? bodyIn(now, *style.followed) : nullptr;
  if (followed) camera.center += followed->x - style.followed_from;
  return camera;
}

void adaptToScene(FrameStyle& style, const Scene& scene, const Snapshot& initial,
                  const std::vector<BodyInfo>& bodies) {
  adaptToScene(style, scene, initial, Coverage(initial, bodies), bodies);
}

void adaptToScene(FrameStyle& style, const Scene& scene, const Snapshot& initial,
                  const Coverage& seen, const std::vector<BodyInfo>& bodies) {
  style.title = scene.title.empty() ? scene.name : scene.title;
  style.step = scene.step;
  const Layout layout = layoutOf(style.width, style.height, style.overlays);
  const double aspect = double{layout.panel.width} / double{layout.panel.height};
  style.camera = scene.camera.value_or(fitCamera(seen, bodies, aspect, scene.margin));
  if (scene.follow) followFrom(style, BodyId{static_cast<std::uint32_t>(*scene.follow)}, initial);
  if (scene.follow && !scene.camera) style.camera.center = style.followed_from;
  const double typical = BodyLooks(bodies).typical_width;
  style.force_scale = automaticForceScale(bodies, typical, style.camera.height);
  // What falls from the top of the picture to its bottom gets an arrow of a third of its height.
  style.velocity_scale =
      0.33 * style.camera.height / std::sqrt(2.0 * kGravity * style.camera.height);
}

Layout layoutOf(int width, int height, const Overlays& overlays) {
  Layout out;
  const float w = static_cast<float>(width), h = static_cast<float>(height);
  out.unit = std::clamp(h / 720.0F, 0.6F, 8.0F);
  const bool tall = h >= 240.0F;
  const float top = overlays.has(Overlay::Hud) ? (tall ? 62.0F : 36.0F) * out.unit : 0.0F;
  const float bottom =
      overlays.has(Overlay::Legend) || overlays.has(Overlay::Scale) ? 44.0F * out.unit : 0.0F;
  out.caption = {0.0F, 0.0F, w, std::round(std::min(top, 0.3F * h))};
  out.footer = {0.0F, 0.0F, w, std::round(std::min(bottom, 0.3F * h))};
  out.footer.y = h - out.footer.height;
  out.panel = {0.0F, out.caption.height, w, h - out.caption.height - out.footer.height};
  return out;
}

}  // namespace merge2d
