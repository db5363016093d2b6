#include <algorithm>

#include "bench/families/family_list.h"
#include "bench/families/loads.h"
#include "bench/families/walls.h"

namespace merge2d::bench {
namespace {

/// Accelerates to a speed, keeps it, and brakes: accelerations that are constant, an eighth of the
/// time between two keys.
Keyframes startAndStop(const Vec2& at, double speed, double start, double run, double stop) {
  Keyframes path{{{0.0, at, 0.0}}};
  const double whole = start + run + stop;
  const double slice = std::min(start, stop) / 8.0;
  const auto placeAt = [&](double t) {
    const double a = std::clamp(t, 0.0, start), c = std::clamp(t - start - run, 0.0, stop);
    return speed * (0.5 * a * a / start + std::clamp(t - start, 0.0, run) + c - 0.5 * c * c / stop);
  };
  for (double t = 0.0; t <= whole; t += slice) {
    path.keys.push_back({kSettled + t, at + Vec2(placeAt(t), 0.0), 0.0});
  }
  path.keys.push_back({kSettled + whole + slice, at + Vec2(placeAt(whole), 0.0), 0.0});
  return path;
}

/// Stands on a belt that starts, runs, and stops.
void ride(Structure& s, const Wall& wall, double friction, double speed, Random& random) {
  BodyDesc& belt = s.scene.bodies.front();
  const double start = speed / (wall.carries(friction) * random.between(0.4, 1.6));
  const double stop = speed / (wall.carries(friction) * random.between(0.5, 2.0));
  const double run = random.between(1.0, 4.0);
  move(belt, startAndStop(belt.at, speed, start, run, stop));
  s.until = kSettled + start + run + stop + 2.0;
  add(s, wall, {0.0, 0.0});
}

/// Carried by the surface of a belt to another belt, or against a sill.
void crossOver(Structure& s, const Wall& wall, bool to_sill, double speed, Random& random) {
  BodyDesc& belt = s.scene.bodies.front();
  belt.at.x() = -30.0;
  belt.surface_velocity = speed;
  const double way = speed * random.between(1.5, 3.0) + 0.5 * wall.breadth() + wall.shift;
  BodyDesc next = ground();
  next.at.x() = 30.0;
  add(s, wall, {-way, 0.0});
  for (std::size_t i = 1; i < s.scene.bodies.size(); ++i) s.scene.bodies[i].velocity = {speed, 0.0};
  if (to_sill) {
    s.kind = "sill";
    next.name = "sill";
    next.at.y() += std::min(wall.height, wall.rows * wall.height * random.between(0.1, 0.6));
  } else {
    s.kind = "two belts";
    next.name = "next";
    next.surface_velocity = speed * random.between(-1.0, 3.0);
  }
  s.scene.bodies.push_back(next);
  // Seen from the first box, which itself may tip.
  for (Watch& w : s.watched) w.frame = 1;
  s.watched.front() = {.body = 1, .frame = 0, .way = kNever};
  s.from = 1.0;
  s.until = 10.0;
}

}  // namespace

Structure conveyor(Random& random) {
  Structure s{.kind = "start and stop", .from = kBefore};
  const std::size_t kind = random.below(3);
  Wall wall = randomWall(random, 1.5, 2.5);
  if (kind > 0) wall.rows = std::max(wall.rows, 4);
  const double friction = random.between(0.2, 1.0), speed = random.between(0.5, 3.0);
  s.scene.bodies.push_back(ground());
  if (kind == 0) {
    ride(s, wall, friction, speed, random);
  } else {
    crossOver(s, wall, kind == 2, speed, random);
  }
  setFriction(s.scene, friction);
  return s;
}

}  // namespace merge2d::bench
