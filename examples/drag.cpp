// A hand drags a brick out of a merged wall, and other bricks come free with it.

#include <merge2d/merge2d.h>

#include <algorithm>
#include <cstdio>

int main() {
  merge2d::Scene scene;
  scene.add({.name = "ground",
             .motion = merge2d::Motion::Pinned,
             .position = {0.0, -0.5},
             .shapes = {merge2d::Shape::box(20.0, 1.0)}});
  for (int row = 0; row < 4; ++row) {
    for (int i = 0; i < 5; ++i) {
      scene.add({.position = {i + 0.5 * (row % 2), 0.25 + 0.5 * row},
                 .shapes = {merge2d::Shape::box(1.0, 0.5)}});
    }
  }

  merge2d::World world(scene);
  world.step(150);
  std::printf("at rest: %d of %d bodies are simulated\n", world.counts().active_bodies,
              world.counts().bodies);

  // The hand takes the end brick of the second row and pulls it to the right.
  const merge2d::Body brick = 10;
  merge2d::Vec2 hand{world.poses()[3 * brick], world.poses()[3 * brick + 1]};
  const merge2d::Spring spring = world.drag(brick, hand);
  int most = 0;
  for (int i = 0; i < 150; ++i) {
    hand.x += 0.02;
    world.moveSpring(spring, hand);
    world.step();
    most = std::max(most, world.counts().active_bodies);
  }
  world.removeSpring(spring);
  world.step(300);

  std::printf("while it is dragged: up to %d bodies\n", most);
  std::printf("afterwards: %d bodies; the brick is at x = %.2f m\n", world.counts().active_bodies,
              world.poses()[3 * brick]);
  return world.poses()[3 * brick] > 5.0 ? 0 : 1;
}
