#pragma once
/// A random structure that is to fall, and the bodies whose motion tells that it does.

#include <string>
#include <vector>

#include "bench/random_scene.h"

namespace merge2d::bench {

inline constexpr double kGravity = 9.81;  ///< [m/s²]
inline constexpr double kBefore = 1.9;    ///< when places are noted [s]

/// A body whose motion tells that its structure falls, seen from another.
struct Watch {
  BodyIndex body = 0, frame = 0;
  double way = 0.25;             ///< that is a fall [m]
  double turn = 15.0 * kDegree;  ///< that is one [rad]
  Vec2 at = Vec2::Zero();        ///< its point, from the centre of mass, in the body frame [m]
  Vec2 along = Vec2::Zero();     ///< direction of the way in the frame; zero: any
};

/// A random structure.
struct Structure {
  std::string kind;
  Scene scene = {};
  std::vector<Watch> watched = {};
  double from = 0.0;    ///< when it has settled and its load begins [s]
  double until = 12.0;  ///< [s]
};

inline int count(Random& random, int least, int most) {
  return least + static_cast<int>(random.below(static_cast<std::size_t>(most - least + 1)));
}

inline double side(Random& random) { return random.below(2) == 0 ? -1.0 : 1.0; }

inline BodyDesc pinnedBox(const std::string& name, double width, double height, const Vec2& at) {
  BodyDesc body = box(name, width, height, at);
  body.motion = Motion::Pinned;
  return body;
}

/// Its top is at the height zero.
inline BodyDesc ground() { return pinnedBox("ground", 60.0, 1.0, {0.0, -0.5}); }

inline void setFriction(Scene& scene, double friction) {
  for (BodyDesc& body : scene.bodies) body.friction = friction;
}

}  // namespace merge2d::bench
