#pragma once
/// From the world, metres and y up, to the picture, pixels and y down.

#include <string>
#include <vector>

#include "render/drawing.h"
#include "src2d/scene/scene.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

/// The area that the bodies cover in the course of a run.
class Coverage {
 public:
  Coverage() = default;
  Coverage(const Snapshot& snapshot, const std::vector<BodyInfo>& bodies) { add(snapshot, bodies); }

  /// A body that leaves by more than ten times the size of the beginning is not followed there.
  void add(const Snapshot& snapshot, const std::vector<BodyInfo>& bodies);

  const std::vector<Aabb>& ofBodies() const { return bodies_; }  ///< by id; empty: never there
  const Aabb& ofMarks() const { return marks_; }  ///< of springs, and of joints to the world

 private:
  std::vector<Aabb> bodies_;
  Aabb marks_;
  Aabb home_;  ///< empty until there are bodies
};

/// A camera that shows all dynamic bodies, and of the others as much as belongs with them: a huge
/// ground is seen where it is near. `aspect` is width over height of the picture, `margin` the free
/// strip on each side, as a part of the picture.
inline constexpr double kUsualMargin = 0.06;
Camera fitCamera(const Coverage& seen, const std::vector<BodyInfo>& bodies, double aspect,
                 double margin = kUsualMargin);
Camera fitCamera(const Snapshot& snapshot, const std::vector<BodyInfo>& bodies, double aspect,
                 double margin = kUsualMargin);

/// The world box a body covers.
Aabb bodyBounds(const BodyInfo& info, const Pose& pose);

/// The view of a camera in a part of the picture.
struct View {
  PixelBox panel;
  Vec2 center = Vec2::Zero();  ///< in the middle of the panel [m]
  double scale = 1.0;          ///< [px/m]

  View(const Camera& camera, const PixelBox& panel);

  Pixel operator()(const Vec2& world) const {
    const Vec2 d = scale * (world - center);
    return {static_cast<float>(d.x()) + panel.x + 0.5F * panel.width,
            panel.y + 0.5F * panel.height - static_cast<float>(d.y())};
  }
  /// A length [m] in pixels.
  float operator()(double length) const { return static_cast<float>(scale * length); }
  /// A direction in the picture.
  static Pixel direction(const Vec2& d) {
    return {static_cast<float>(d.x()), -static_cast<float>(d.y())};
  }
  /// The part of the world that can be seen, and `margin` pixels around it.
  Aabb visible(double margin = 0.0) const;
};

/// The longest round length (1, 2 or 5 times a power of ten) that fits into `longest` [m].
double roundLength(double longest);

/// "5 m", "20 cm", "1 km".
std::string lengthLabel(double metres);

}  // namespace merge2d
