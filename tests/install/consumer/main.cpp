// A box falls freely for a second, in a program that knows merge2d by its package alone.

#include <merge2d/merge2d.h>

#include <cmath>
#include <cstdio>

int main() {
  merge2d::Scene scene;
  scene.add({.name = "box", .shapes = {merge2d::Shape::box(1.0, 1.0)}});

  merge2d::World world(scene);
  world.step(100);

  // A first order integrator is off by at most g h t.
  const double t = world.time(), g = world.gravity().y;
  const double y = world.poses()[1];
  const double exact = 0.5 * g * t * t;
  std::printf("after %g s at y = %g m, exactly %g m\n", t, y, exact);
  return std::abs(y - exact) < std::abs(g) * world.timeStep() * t ? 0 : 1;
}
