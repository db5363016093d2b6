#include <cmath>

#include "bench/families/family_list.h"
#include "bench/families/loads.h"
#include "bench/families/walls.h"
#include "bench/random_mounts.h"

namespace merge2d::bench {
namespace {

/// Accelerates ever more, up to `acceleration` after some seconds.
Script rushing(const Vec2& at, double acceleration, double seconds) {
  Keyframes path{{{0.0, at, 0.0}}};
  for (int i = 0; 0.25 * i <= seconds; ++i) {
    const double t = 0.25 * i;
    path.keys.push_back(
        {kSettled + t, at + Vec2(acceleration / seconds * t * t * t / 6.0, 0.0), 0.0});
  }
  return path;
}

}  // namespace

Structure movingFrame(Random& random) {
  Structure s{.kind = "mount"};
  const std::size_t kind = random.below(8);
  BodyDesc seat = box("seat", 3.0, 0.2, {0.0, 0.0});
  seat.mass = oneOf(random, std::array{5.0, 30.0, 300.0});
  s.scene.bodies.push_back(seat);
  const Wall wall = randomWall(random, 2.5, 3.0);
  const double friction = random.between(0.3, 1.2), most = wall.carries(friction);
  BodyDesc& moves = s.scene.bodies.front();
  const double factor = random.between(0.9, 2.0);
  if (kind == 0) {
    s.kind = "shaken";
    move(moves, shaken(seat.at, factor * most, random.between(0.7, 2.5), 8.0));
  } else if (kind == 1) {
    s.kind = "lift";
    const Vec2 way(side(random) * random.between(0.5, 3.0), random.between(-1.0, 3.0));
    move(moves, shifted(seat.at, kSettled, std::sqrt(6.0 * way.norm() / (factor * most)), way));
  } else if (kind == 2) {
    s.kind = "tilt";
    const double angle = std::atan(factor * most / kGravity);
    const double seconds = random.between(2.0, 10.0);
    move(moves, turned(seat.at, kSettled, seconds, side(random) * angle));
    s.until = kSettled + seconds + 2.0;
  } else if (kind == 3) {
    s.kind = "rush";
    move(moves, rushing(seat.at, factor * most, 8.0));
  } else {
    kMounts[kind - 4](s.scene, random);
  }
  s.from = kind < 4 ? kBefore : 0.0;
  add(s, wall, {random.between(-0.2, 0.2), 0.1});
  setFriction(s.scene, friction);
  return s;
}

}  // namespace merge2d::bench
