#pragma once
/// A snapshot as a picture.

#include <string>
#include <vector>

#include "render/canvas.h"
#include "render/palette.h"
#include "render/silhouette.h"
#include "render/style.h"

namespace merge2d {

/// The content of a frame; `text` sets the letters and must belong to the canvas that draws them.
Drawing composeFrame(Text& text, const Snapshot& snapshot, const std::vector<BodyInfo>& bodies,
                     const BodyLooks& looks, const FrameStyle& style, const CollectionSlots& slots);

/// A description of the picture, for those who cannot see it: "A tower. Step 123, t = 1.23 s,
/// merge+sleep: 320 bodies, 5 active |B|, …".
std::string describe(const Snapshot& snapshot, const FrameStyle& style);

/// Draws the pictures of one run, one after the other, with colours that stay.
class FrameDrawer {
 public:
  /// `bodies` must outlive the drawer.
  FrameDrawer(const std::vector<BodyInfo>& bodies, FrameStyle style);

  const FrameStyle& style() const { return style_; }
  Picture draw(const Snapshot& snapshot);

 private:
  const std::vector<BodyInfo>& bodies_;
  FrameStyle style_;
  BodyLooks looks_;
  CollectionColors colors_;
  Canvas canvas_;
};

/// A single picture.
Picture drawFrame(Canvas& canvas, const Snapshot& snapshot, const std::vector<BodyInfo>& bodies,
                  const FrameStyle& style);

}  // namespace merge2d
