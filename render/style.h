#pragma once
/// How a run is to be drawn: what stays the same from frame to frame.

#include <string>

#include "render/drawing.h"
#include "render/overlays.h"
#include "render/theme.h"
#include "src2d/scene/scene.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

struct FrameStyle {
  int width = 1280, height = 720;  ///< [px]
  Theme theme = lightTheme();
  bool transparent = false;  ///< no background
  Overlays overlays = Overlays::standard();
  std::string title;
  Mode mode = Mode::MergeSleep;
  Camera camera;
  double step = 0.01;           ///< h, turns impulses into forces [s]
  double force_scale = 0.0;     ///< length of force arrows [m/N]
  double velocity_scale = 0.0;  ///< length of velocity arrows [m per m/s]
};

/// Fills in what follows from the scene: title, step, camera (the scene's, or one that fits the
/// initial snapshot) and the arrows' scales. Set size and overlays first: the camera depends on
/// them.
void adaptToScene(FrameStyle& style, const Scene& scene, const Snapshot& initial,
                  const std::vector<BodyInfo>& bodies);

/// Where things go in the picture.
struct Layout {
  float unit = 1.0F;  ///< design pixels of a picture of 720 rows to pixels
  PixelBox caption;   ///< title and numbers, empty without the hud
  PixelBox panel;     ///< the world
  PixelBox footer;    ///< legend and scale bar, empty without both
};
Layout layoutOf(int width, int height, const Overlays& overlays);

}  // namespace merge2d
