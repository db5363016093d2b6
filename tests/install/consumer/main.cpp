// A box falls freely for a second, in a program that knows merge2d by its package alone.

#include <cmath>
#include <cstdio>

#include "src2d/world.h"

int main() {
  merge2d::BodyDesc box;
  box.name = "box";
  box.shapes = {merge2d::makeBox(1.0, 1.0)};

  merge2d::Scene scene;
  scene.bodies = {box};

  merge2d::World world(scene);
  for (int i = 0; i < 100; ++i) world.step();

  // A first order integrator is off by at most g h t.
  const double t = world.time();
  const double y = world.capture().bodies.at(0).x.y();
  const double exact = 0.5 * scene.gravity.y() * t * t;
  std::printf("after %g s at y = %g m, exactly %g m\n", t, y, exact);
  return std::abs(y - exact) < std::abs(scene.gravity.y()) * scene.step * t ? 0 : 1;
}
