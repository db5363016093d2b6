#include <cmath>

#include "bench/families/family_list.h"
#include "bench/families/loads.h"

namespace merge2d::bench {

Structure ladder(Random& random) {
  Structure s{.kind = "load", .from = kBefore};
  const double length = random.between(2.0, 4.0), half = random.between(0.04, 0.1);
  const double lean = random.between(8.0, 40.0) * kDegree;
  const double friction = std::tan(lean) * random.between(0.5, 0.85);
  s.scene.bodies.push_back(pinnedBox("floor", 30.0, 1.0, {0.0, -0.5}));
  s.scene.bodies.push_back(pinnedBox("wall", 1.0, 8.0, {-0.5, 4.0}));
  const double cosine = std::cos(lean), sine = std::sin(lean);
  // Each leans to the left, on the wall or on the one before.
  const int planks = count(random, 1, 3);
  for (int i = 0; i < planks; ++i) {
    const double past = 2.0 * half * i / cosine;
    BodyDesc plank =
        box(fmt::format("plank[{}]", i), 2.0 * half, length,
            {0.5 * length * sine + half * cosine + past, 0.5 * length * cosine + half * sine});
    plank.angle = lean;
    const Watch foot{.body = s.scene.bodies.size(),
                     .way = 0.06 * length,
                     .turn = kNever,
                     .at = {-half, -0.5 * length}};
    s.watched.push_back(foot);
    s.scene.bodies.push_back(plank);
  }
  setFriction(s.scene, friction);
  const std::size_t kind = random.below(3);
  if (kind == 0) {
    s.until = 15.0;
    const double place = random.between(0.0, 0.5) * length, towards = random.between(-0.3, 0.3);
    pullMoreAndMore(s.scene, s.scene.bodies.size() - 1, {0.0, place},
                    {std::sin(towards), -std::cos(towards)},
                    massOf(s.scene) * kGravity * random.between(0.05, 0.6), kSettled, s.until);
  } else if (kind == 1) {
    s.kind = "floor slides";
    const double way = length * random.between(0.2, 0.9), speed = random.between(0.02, 0.2);
    move(s.scene.bodies[0], shifted({0.0, -0.5}, kSettled, way / speed, {way, 0.0}));
    s.until = kSettled + way / speed + 2.0;
  } else {
    s.kind = "floor tilts";
    const double seconds = random.between(4.0, 12.0);
    move(s.scene.bodies[0],
         turned({0.0, -0.5}, kSettled, seconds, -random.between(4.0, 25.0) * kDegree));
    s.until = kSettled + seconds + 2.0;
  }
  return s;
}

}  // namespace merge2d::bench
