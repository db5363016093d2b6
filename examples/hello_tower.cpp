// A tower of ten boxes comes to rest and becomes one collection.
//
//   c++ -std=c++20 hello_tower.cpp $(pkg-config --cflags --libs merge2d) -o hello_tower

#include <merge2d/merge2d.h>

#include <cstdio>

int main() {
  merge2d::Scene scene;
  scene.add({.name = "ground",
             .motion = merge2d::Motion::Pinned,
             .position = {0.0, -0.5},
             .shapes = {merge2d::Shape::box(20.0, 1.0)}});
  for (int i = 0; i < 10; ++i) {
    scene.add({.position = {0.0, 0.5 + i}, .shapes = {merge2d::Shape::box(1.0, 1.0)}});
  }

  merge2d::World world(scene);
  for (int second = 0; second <= 2; ++second) {
    const merge2d::Counts now = world.counts();
    std::printf("t = %.1f s: %d bodies, %d simulated, %d collections\n", world.time(), now.bodies,
                now.active_bodies, now.collections);
    world.step(100);
  }

  const std::span<const double> poses = world.poses();
  const std::size_t top = 10;
  std::printf("the top box is at y = %.2f m\n", poses[3 * top + 1]);
  const bool merged = world.collectionOf(1) != M2_NO_COLLECTION;
  return merged && world.collectionOf(1) == world.collectionOf(10) ? 0 : 1;
}
