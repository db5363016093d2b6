#include "bench/families/walls.h"

#include <algorithm>

namespace merge2d::bench {
namespace {

/// How fast a point moves with a body [m/s].
Vec2 velocityAt(const BodyDesc& body, const Vec2& x) {
  return body.velocity + cross(body.spin, x - body.at);
}

}  // namespace

Wall randomWall(Random& random, double breadth, double height) {
  Wall wall{.columns = count(random, 1, 3),
            .rows = count(random, 2, 8),
            .width = oneOf(random, std::array{0.3, 0.5, 0.7}),
            .height = oneOf(random, std::array{0.2, 0.3, 0.5})};
  while (wall.breadth() + 0.5 * wall.width > breadth && wall.columns > 1) --wall.columns;
  while (wall.rows * wall.height > height && wall.rows > 2) --wall.rows;
  if (wall.columns > 1) wall.shift = oneOf(random, std::array{0.0, 0.2, 0.35}) * wall.width;
  return wall;
}

void add(Structure& s, const Wall& wall, const Vec2& foot) {
  const BodyDesc ground = s.scene.bodies.front();
  for (int row = 0; row < wall.rows; ++row) {
    const double left = -0.5 * (wall.breadth() - wall.width) + wall.shift * ((row % 2) - 0.5);
    for (int column = 0; column < wall.columns; ++column) {
      const Vec2 at = foot + Vec2(left + column * wall.width, (row + 0.5) * wall.height);
      BodyDesc body = box(fmt::format("box[{},{}]", column, row), wall.width, wall.height, at);
      body.velocity = velocityAt(ground, at);
      body.spin = ground.spin;
      s.watched.push_back({.body = s.scene.bodies.size(), .way = 0.25 * wall.size()});
      s.scene.bodies.push_back(body);
    }
  }
}

}  // namespace merge2d::bench
