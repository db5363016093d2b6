#pragma once
/// How a run is to be drawn: what stays the same from frame to frame.

#include <optional>
#include <string>

#include "render/drawing.h"
#include "render/overlays.h"
#include "render/theme.h"
#include "src2d/scene/scene.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

class Coverage;

/// The files that frames become.
enum class FrameFormat {
  Png,  ///< pixels, drawn by OpenGL
  Svg,  ///< the same shapes as vector graphics
};

struct FrameStyle {
  int width = 1280, height = 720;  ///< [px]
  Theme theme = lightTheme();
  FrameFormat format = FrameFormat::Png;
  bool transparent = false;  ///< no background
  Overlays overlays = Overlays::standard();
  std::string title;
  Mode mode = Mode::MergeSleep;
  Camera camera;
  std::optional<BodyId> followed;     ///< the camera moves with it
  Vec2 followed_from = Vec2::Zero();  ///< where it is when it is seen by `camera` [m]
  double step = 0.01;                 ///< h, turns impulses into forces [s]
  double force_scale = 0.0;           ///< length of force arrows [m/N]
  double velocity_scale = 0.0;        ///< length of velocity arrows [m per m/s]
};

/// Fills in the values that follow from the scene: title, step, camera (the scene's, or one that
/// fits `seen`) and the arrows' scales. Set size and overlays first: the camera depends on them. A
/// camera that moves with a body fits the beginning.
void adaptToScene(FrameStyle& style, const Scene& scene, const Snapshot& initial,
                  const Coverage& seen, const std::vector<BodyInfo>& bodies);
void adaptToScene(FrameStyle& style, const Scene& scene, const Snapshot& initial,
                  const std::vector<BodyInfo>& bodies);

/// True when the camera depends on the area that bodies cover over the run.
inline bool fitsTheRun(const Scene& scene) { return !scene.camera && !scene.follow; }

/// The camera of a frame.
Camera cameraAt(const FrameStyle& style, const Snapshot& now);

/// Where things go in the picture.
struct Layout {
  float unit = 1.0F;  ///< design pixels of a picture of 720 rows to pixels
  PixelBox caption;   ///< title and numbers, empty without the hud
  PixelBox panel;     ///< the world
  PixelBox footer;    ///< legend and scale bar, empty without both
};
Layout layoutOf(int width, int height, const Overlays& overlays);

}  // namespace merge2d
