#include <algorithm>
#include <cmath>

#include "bench/families/family_list.h"
#include "bench/families/loads.h"

namespace merge2d::bench {
namespace {

/// A piece of a ring about the origin, as a body at its middle.
BodyDesc ringPiece(const std::string& name, double inner, double outer, double from, double to) {
  const auto at = [](double r, double angle) {
    return Vec2(r * std::cos(angle), r * std::sin(angle));
  };
  BodyDesc body;
  body.name = name;
  body.at = at(0.5 * (inner + outer), 0.5 * (from + to));
  Polygon polygon{{at(inner, from), at(outer, from), at(outer, to), at(inner, to)}};
  for (Vec2& v : polygon.vertices) v -= body.at;
  body.shapes = {polygon};
  return body;
}

/// Voussoirs between two abutments.
Structure roundArch(Random& random) {
  Structure s{.kind = "spread", .from = kBefore};
  const int n = count(random, 4, 11);
  const double radius = random.between(1.5, 3.0), half = 0.5 * radius * random.between(0.13, 0.3);
  const double start = oneOf(random, std::array{0.0, 15.0, 30.0}) * kDegree;
  const double step = (std::numbers::pi - 2.0 * start) / n;
  const double inner = radius - half, outer = radius + half, ends = std::numbers::pi - start;
  s.scene.bodies.push_back(ringPiece("right", inner - half, outer + half, start - 0.3, start));
  s.scene.bodies.push_back(ringPiece("left", inner - half, outer + half, ends, ends + 0.3));
  for (BodyDesc& body : s.scene.bodies) body.motion = Motion::Pinned;
  const double size = std::min(2.0 * half, radius * step);
  for (int i = 0; i < n; ++i) {
    const std::string name = fmt::format("stone[{}]", i);
    s.watched.push_back({.body = s.scene.bodies.size(), .way = 0.25 * size});
    s.scene.bodies.push_back(
        ringPiece(name, inner, outer, start + i * step, start + (i + 1) * step));
  }
  setFriction(s.scene, random.between(0.5, 1.0));
  if (random.below(2) == 0) {
    BodyDesc& right = s.scene.bodies.front();
    const double way = radius * random.between(0.05, 0.5), speed = random.between(0.02, 0.15);
    move(right, shifted(right.at, kSettled, way / speed, {way, random.between(-0.3, 0.3) * way}));
    for (Watch& w : s.watched) w.frame = 1;
    s.until = kSettled + way / speed + 3.0;
  } else {
    s.kind = "load";
    s.until = 15.0;
    const auto stone = static_cast<BodyIndex>(2 + count(random, n / 4, 3 * n / 4));
    const double lean = random.between(-0.4, 0.4);
    pullMoreAndMore(s.scene, std::min<BodyIndex>(stone, static_cast<BodyIndex>(n + 1)),
                    Vec2::Zero(), {std::sin(lean), -std::cos(lean)},
                    massOf(s.scene) * kGravity * random.between(0.05, 0.5), kSettled, s.until);
  }
  return s;
}

/// A lintel on two piers of boxes laid flat, of which each lies a little farther inward.
Structure corbels(Random& random) {
  Structure s{.kind = "corbels", .from = kBefore};
  const double gap = random.between(1.0, 2.5), width = random.between(0.6, 1.2);
  const double height = random.between(0.15, 0.4);
  const int rows = count(random, 2, 6);
  const double step = random.between(0.0, 0.8) * width / rows / 2.0;
  for (const double x : {-1.0, 1.0}) {
    s.scene.bodies.push_back(
        pinnedBox(x < 0 ? "left" : "right", 1.5 * width, 0.4, {x * (gap + width) / 2.0, -0.2}));
  }
  for (int row = 0; row < rows; ++row) {
    for (const double x : {-1.0, 1.0}) {
      s.watched.push_back(
          {.body = s.scene.bodies.size(), .frame = x < 0 ? 0U : 1U, .way = 0.25 * height});
      s.scene.bodies.push_back(box(fmt::format("{}[{}]", x < 0 ? "west" : "east", row), width,
                                   height,
                                   {x * ((gap + width) / 2.0 - step * row), (row + 0.5) * height}));
    }
  }
  const double length = gap + width * random.between(0.4, 1.8);
  s.watched.push_back({.body = s.scene.bodies.size(), .way = kNever});
  s.scene.bodies.push_back(box("lintel", length, height, {0.0, (rows + 0.5) * height}));
  setFriction(s.scene, random.between(0.3, 1.0));
  // The lintel slides on one seat, not now on one now on both.
  for (BodyDesc& body : s.scene.bodies) {
    if (body.at.x() < 0.0) body.friction *= 1.5;
  }
  BodyDesc& right = s.scene.bodies[1];
  if (random.below(2) == 0) {
    const double way = width * random.between(0.4, 2.0), speed = random.between(0.03, 0.2);
    move(right, shifted(right.at, kSettled, way / speed, {way, 0.0}));
    s.until = kSettled + way / speed + 3.0;
  } else {
    s.until = 15.0;
    const double lean = random.between(-1.3, 1.3);
    const BodyIndex lintel = s.scene.bodies.size() - 1;
    pullMoreAndMore(s.scene, lintel, {random.between(-0.4, 0.4) * length, 0.5 * height},
                    {std::sin(lean), -std::cos(lean)},
                    massOf(s.scene) * kGravity * random.between(0.03, 0.3), kSettled, s.until);
  }
  return s;
}

}  // namespace

Structure arch(Random& random) {
  return random.below(3) == 0 ? corbels(random) : roundArch(random);
}

}  // namespace merge2d::bench
