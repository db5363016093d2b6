#include <algorithm>
#include <cmath>

#include "bench/families/family_list.h"
#include "bench/families/loads.h"
#include "bench/families/walls.h"

namespace merge2d::bench {
namespace {

constexpr double kTilted = 60.0;  // how far the ground is tilted at most [degrees]

}  // namespace

Structure heavyOnLight(Random& random) {
  Structure s{.kind = "tilted", .from = kBefore};
  s.scene.bodies.push_back(ground());
  Wall wall = randomWall(random, 2.5, 3.0);
  wall.rows = count(random, 1, 3);
  wall.columns = count(random, 2, 4);
  for (double* length : {&wall.width, &wall.height, &wall.shift}) *length *= 4.0;  // rows are soft
  add(s, wall, {0.0, 0.0});
  const double ratio = std::exp(random.between(std::log(20.0), std::log(1000.0)));
  const double breadth = wall.breadth() * random.between(0.5, 1.5);
  const double height = random.between(0.5, 4.0), top = wall.rows * wall.height;
  BodyDesc heavy = box("heavy", breadth, height,
                       {random.between(-0.1, 0.1) * wall.breadth(), top + 0.5 * height});
  heavy.mass = ratio * wall.width * wall.height;
  s.watched.push_back({.body = s.scene.bodies.size(), .way = 0.25 * wall.size()});
  s.scene.bodies.push_back(heavy);
  const double friction = random.between(0.3, 1.0);
  setFriction(s.scene, friction);
  const double most = kGravity * std::min(friction, 0.5 * wall.breadth() / (top + 0.5 * height));
  const double factor = random.between(0.9, 2.0);
  BodyDesc& base = s.scene.bodies.front();
  s.until = 15.0;
  const std::size_t kind = random.below(3);
  if (kind == 0) {
    const double angle = std::min(std::atan(factor * most / kGravity), kTilted * kDegree);
    move(base, turned(base.at, kSettled, random.between(4.0, 11.0), side(random) * angle));
  } else if (kind == 1) {
    s.kind = "pushed";
    pullMoreAndMore(s.scene, s.scene.bodies.size() - 1, {0.0, random.between(-0.5, 0.5) * height},
                    {side(random), 0.0}, *heavy.mass * most * factor / 10.0, kSettled, s.until);
  } else {
    s.kind = "shaken";
    move(base, shaken(base.at, 2.0 * factor * most, random.between(1.0, 3.0), 10.0));
  }
  return s;
}

}  // namespace merge2d::bench
