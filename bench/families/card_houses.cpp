#include <algorithm>
#include <cmath>

#include "bench/families/family_list.h"
#include "bench/families/loads.h"

namespace merge2d::bench {
namespace {

/// The right card of a pair that leans against its mirror image: with a flat foot, and cut off
/// where it meets the other and at the height.
BodyDesc card(const std::string& name, const Vec2& foot, double mirror, double height, double lean,
              double thick) {
  const double across = thick / std::cos(lean), reach = height * std::tan(lean) - 0.5 * across;
  const double slope = std::tan(lean);
  Polygon polygon{{{reach, 0.0},
                   {reach + across, 0.0},
                   {reach + across - height * slope, height},
                   {0.0, height},
                   {0.0, reach / slope}}};
  if (mirror < 0.0) {
    for (Vec2& v : polygon.vertices) v.x() = -v.x();
    std::ranges::reverse(polygon.vertices);
  }
  const Vec2 centre = areaProperties(ConvexShape(polygon)).centroid;
  for (Vec2& v : polygon.vertices) v -= centre;
  BodyDesc body;
  body.name = name;
  body.at = foot + centre;
  body.shapes = {polygon};
  return body;
}

}  // namespace

Structure cardHouse(Random& random) {
  Structure s{.kind = "leaning", .from = kBefore};
  s.scene.bodies.push_back(ground());
  const bool leaning = random.below(3) != 0;
  const double height = random.between(0.8, 1.5), thick = height * random.between(0.05, 0.12);
  const double lean = random.between(14.0, 32.0) * kDegree;
  const double pitch = leaning ? 2.0 * (height * std::tan(lean) + 0.6 * thick / std::cos(lean))
                               : height * random.between(0.6, 1.2);
  const int storeys = count(random, 1, 4);
  const auto put = [&](const BodyDesc& body) {
    s.watched.push_back({.body = s.scene.bodies.size(), .way = 0.1 * height});
    s.scene.bodies.push_back(body);
  };
  double floor = 0.0;
  for (int row = 0; row < storeys; ++row) {
    const int n = storeys - row + (leaning ? 0 : 1);
    for (int i = 0; i < n; ++i) {
      const Vec2 foot(pitch * (i - 0.5 * (n - 1)), floor);
      if (!leaning) {
        put(box(fmt::format("card[{},{}]", row, i), thick, height, foot + Vec2(0.0, 0.5 * height)));
        continue;
      }
      put(card(fmt::format("right[{},{}]", row, i), foot, 1.0, height, lean, thick));
      put(card(fmt::format("left[{},{}]", row, i), foot, -1.0, height, lean, thick));
    }
    floor += height;
    if (leaning && n == 1) break;
    const double length = pitch * (n - 1) + 0.3 * height;
    put(box(fmt::format("ceiling[{}]", row), length, thick, {0.0, floor + 0.5 * thick}));
    floor += thick;
  }
  if (!leaning) s.kind = "upright";
  const double needed = leaning ? std::tan(lean) : 0.5;
  setFriction(s.scene, needed * random.between(0.6, 1.3));
  s.until = 15.0;
  const BodyIndex loaded = 1 + random.below(s.scene.bodies.size() - 1);
  const double towards =
      leaning ? random.between(-0.5, 0.5) : side(random) * random.between(0.05, 1.5);
  pullMoreAndMore(s.scene, random.below(2) == 0 ? loaded : s.scene.bodies.size() - 1, Vec2::Zero(),
                  {std::sin(towards), -std::cos(towards)},
                  massOf(s.scene) * kGravity * random.between(0.02, 0.3), kSettled, s.until);
  return s;
}

}  // namespace merge2d::bench
