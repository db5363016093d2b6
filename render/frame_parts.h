#pragma once
/// The parts of a frame, from back to front. Internal to the renderer.

#include <utility>

#include "render/camera.h"
#include "render/painter.h"
#include "render/palette.h"
#include "render/silhouette.h"
#include "render/style.h"

namespace merge2d {

using BodyPair = std::pair<BodyId, BodyId>;
inline BodyPair ordered(BodyId a, BodyId b) { return a < b ? BodyPair{a, b} : BodyPair{b, a}; }

/// Everything the parts look at.
struct FrameScene {
  const Snapshot& snapshot;
  const std::vector<BodyInfo>& bodies;
  const BodyLooks& looks;
  const FrameStyle& style;
  const CollectionSlots& slots;
  Layout layout;
  View view;

  const Theme& theme() const { return style.theme; }
  float unit() const { return layout.unit; }
  bool shows(Overlay overlay) const { return style.overlays.has(overlay); }
  /// A design length of a picture of 720 rows [px].
  float px(float design) const { return design * layout.unit; }
  /// A font of a design size, but of no fewer than `least` pixels.
  Font font(float design, Weight weight = Weight::Regular, int least = 11) const;
  /// The state of a body, or null when it is not alive.
  const BodyState* body(BodyId id) const;
  const BodyInfo& info(BodyId id) const { return bodies[index(id)]; }
  /// The width of a typical body [px].
  float bodySize() const { return view(looks.typical_width); }
  /// Lines around bodies: thin enough for the smallest, the same for all [px].
  float outlineWidth() const;
  const Finish& collection(CollectionId id) const { return theme().collections[slotOf(slots, id)]; }
};

/// Pinned now, or scripted: drawn with hatching.
bool isFixed(const FrameScene& scene, const BodyState& body);
/// The colours of a body.
Finish finishOf(const FrameScene& scene, const BodyState& body);
/// The one of a collection's two colours that stands out from the background.
Color standingOut(const FrameScene& scene, CollectionId id);
/// The stripes of a fixed body at `origin`, turned with it.
Hatch hatchOf(const FrameScene& scene, Pixel origin, const Rotation& turn, bool scripted);

void drawBodies(Painter& painter, const FrameScene& scene);
/// Draws the members of a collection once more, with a common line around them.
void drawTogether(Painter& painter, const FrameScene& scene, const CollectionView& collection);

/// The signs of joints.
void drawJoints(Painter& painter, const FrameScene& scene);

/// Springs, joints, and the overlays that lie in the world: graph, welds, boxes, contacts, forces,
/// velocities.
void drawMarks(Painter& painter, const FrameScene& scene);

/// The marks of contacts, as the legend shows them too.
void drawMergedMark(Painter& painter, const FrameScene& scene, Pixel at, float radius);
void drawActiveMark(Painter& painter, const FrameScene& scene, Pixel at, float radius);
void drawBrokenMark(Painter& painter, const FrameScene& scene, Pixel at, float radius);

/// A number and what it counts.
struct Count {
  int number;
  const char* one;
  const char* many;
};
/// The entries of a frame's caption, the same in all frames of a mode.
std::vector<Count> countsOf(const Snapshot& snapshot, Mode mode);

/// Title and numbers above the world; legend and scale bar below it.
void drawCaption(Painter& painter, const FrameScene& scene);
void drawFooter(Painter& painter, const FrameScene& scene);
/// A round length in the footer, with its label to the left; returns where it starts [px].
float drawScale(Painter& painter, const FrameScene& scene);

}  // namespace merge2d
