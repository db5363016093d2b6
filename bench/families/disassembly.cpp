#include <algorithm>

#include "bench/families/family_list.h"
#include "bench/families/loads.h"
#include "bench/families/walls.h"

namespace merge2d::bench {

namespace {

/// The right half of the ground sinks.
Structure lowered(Structure s, Wall wall, double speed, Random& random) {
  s.kind = "lowered";
  wall.columns = std::max(wall.columns, 2);
  wall.shift = 0.35 * wall.width;
  BodyDesc sinks = pinnedBox("sinking", 30.0, 1.0, {15.0, -0.5});
  s.scene.bodies.front() = pinnedBox("ground", 30.0, 1.0, {-15.0, -0.5});
  add(s, wall, {random.between(-0.3, 0.3) * wall.breadth(), 0.0});
  const double way = wall.height * random.between(0.2, 3.0);
  move(sinks, shifted(sinks.at, kSettled, 3.0 * way / speed, {0.0, -way}));
  s.scene.bodies.push_back(sinks);
  for (Watch& w : s.watched) w.along = Vec2::UnitX();
  s.until = kSettled + 3.0 * way / speed + 3.0;
  setFriction(s.scene, random.between(0.3, 1.0));
  return s;
}

}  // namespace

Structure disassembly(Random& random) {
  Structure s{.kind = "pulled", .from = kBefore};
  s.scene.bodies.push_back(ground());
  Wall wall = randomWall(random, 3.0, 3.0);
  wall.rows = std::max(wall.rows, 3);
  const std::size_t kind = random.below(3);
  const double speed = random.between(0.02, 0.2), out = side(random);
  if (kind == 2) return lowered(s, wall, speed, random);
  add(s, wall, {0.0, 0.0});
  setFriction(s.scene, random.between(0.2, 0.8));
  const int row = count(random, 0, std::min(2, wall.rows - 2));
  const int column = out < 0.0 ? 0 : wall.columns - 1;
  const auto pulled = static_cast<BodyIndex>(1 + row * wall.columns + column);
  BodyDesc& brick = s.scene.bodies[pulled];
  const double way = 1.2 * wall.width;
  std::erase_if(s.watched, [&](const Watch& w) { return w.body == pulled; });
  s.until = kSettled + way / speed + 3.0;
  if (kind == 0) {
    move(brick, shifted(brick.at, kSettled, way / speed, {out * way, 0.0}));
    return s;
  }
  s.kind = "dragged";
  const double weight = kGravity * massOf(brick) * (wall.rows - row) * 2.0;
  s.until = 15.0;
  pullMoreAndMore(s.scene, pulled, Vec2::Zero(), {out, 0.0}, weight * random.between(0.05, 0.5),
                  kSettled, s.until);
  return s;
}

}  // namespace merge2d::bench
