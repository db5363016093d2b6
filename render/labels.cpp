/// Names of bodies and labels of collections, placed so that none covers another.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/label_painter.h"

namespace merge2d {
namespace {

/// The member nearest to the centre of mass: a place that surely lies on the collection.
Vec2 labelPlace(const FrameScene& scene, const CollectionView& collection) {
  Vec2 best = collection.x;
  double least = 1e300;
  for (const BodyId id : collection.bodies) {
    const BodyState* body = scene.body(id);
    if (body == nullptr) continue;
    const double distance = (body->x - collection.x).squaredNorm();
    if (distance < least) least = distance, best = body->x;
  }
  return best;
}

/// How many pixels the members fill, roughly.
float coveredArea(const FrameScene& scene, const CollectionView& collection) {
  double area = 0.0;
  for (const BodyId id : collection.bodies) area += scene.looks.silhouettes[index(id)].area;
  return static_cast<float>(area * scene.view.scale * scene.view.scale);
}

void labelCollections(LabelPainter& labels, const FrameScene& scene) {
  std::vector<const CollectionView*> bySize;
  for (const CollectionView& c : scene.snapshot.collections) bySize.push_back(&c);
  std::ranges::stable_sort(bySize, std::ranges::greater{},
                           [](const CollectionView* c) { return c->bodies.size(); });
  // Where there are few, each gets its label; where there are many, those that it does not hide,
  // the small ones in small print.
  const bool crowded = bySize.size() > 8;
  const Font large = scene.font(13.0F, Weight::Bold), small = scene.font(9.0F, Weight::Bold);
  for (const CollectionView* c : bySize) {
    const std::string label = fmt::format("C{}", value(c->id));
    const float covered = coveredArea(scene, *c);
    const auto fits = [&](const Font& font, float part) {
      return !crowded || part * labels.area(label, font) <= covered;
    };
    if (!fits(small, 1.2F)) continue;
    const Font& font = fits(large, 2.0F) ? large : small;
    labels.put(label, font, scene.view(labelPlace(scene, *c)), standingOut(scene, c->id));
  }
}

void nameBodies(LabelPainter& labels, const FrameScene& scene) {
  const Font font = scene.font(12.0F);
  for (const BodyState& body : scene.snapshot.bodies) {
    const std::string& name = scene.info(body.id).name;
    if (!name.empty()) labels.put(name, font, scene.view(body.x), finishOf(scene, body).outline);
  }
}

}  // namespace

void drawLabels(Painter& painter, const FrameScene& scene) {
  LabelPainter labels(painter, scene);
  if (scene.shows(Overlay::Labels)) labelCollections(labels, scene);
  if (scene.shows(Overlay::Names)) nameBodies(labels, scene);
}

}  // namespace merge2d
