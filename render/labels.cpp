/// Names of bodies and labels of collections, placed so that none covers another.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "render/label_painter.h"

namespace merge2d {
namespace {

/// Whether a point in the body's frame lies on the piece, or at most `slack` beside it [m].
bool covers(const Piece& piece, const Vec2& point, double slack) {
  if (piece.kind == Piece::Kind::Disc) {
    return (point - piece.frame.position).norm() <= piece.radius + slack;
  }
  for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
    const Vec2& from = piece.vertices[i];
    const Vec2 along = piece.vertices[(i + 1) % piece.vertices.size()] - from;
    if (cross(along, Vec2(point - from)) < -slack * along.norm()) return false;
  }
  return true;
}

bool covers(const FrameScene& scene, const BodyState& body, const Vec2& point) {
  const Vec2 local = body.pose().toLocal(point);
  const double slack = 1.0 / scene.view.scale;  // a pixel bridges the seams between members
  return std::ranges::any_of(scene.looks.silhouettes[index(body.id)].pieces,
                             [&](const Piece& piece) { return covers(piece, local, slack); });
}

/// The centres of the members from the inside out: places that surely lie on the collection [m].
std::vector<Vec2> memberPlaces(const FrameScene& scene, const CollectionView& collection) {
  std::vector<Vec2> places;
  for (const BodyId id : collection.bodies) {
    if (const BodyState* body = scene.body(id)) places.push_back(body->x);
  }
  std::ranges::stable_sort(places, {},
                           [&](const Vec2& place) { return (place - collection.x).squaredNorm(); });
  return places;
}

/// For small print, which would hide a member at its centre: first the centre of mass, if that lies
/// on a member or between two, and if there are no marks of contacts to hide there [m].
std::vector<Vec2> smallPlaces(const FrameScene& scene, const CollectionView& collection) {
  std::vector<Vec2> places = memberPlaces(scene, collection);
  if (scene.shows(Overlay::Contacts) || scene.shows(Overlay::Forces)) return places;
  const bool inside = std::ranges::any_of(collection.bodies, [&](BodyId id) {
    const BodyState* body = scene.body(id);
    return body != nullptr && covers(scene, *body, collection.x);
  });
  if (inside) places.insert(places.begin(), collection.x);
  return places;
}

/// How many pixels the members fill, roughly.
float coveredArea(const FrameScene& scene, const CollectionView& collection) {
  double area = 0.0;
  for (const BodyId id : collection.bodies) area += scene.looks.silhouettes[index(id)].area;
  return static_cast<float>(area * scene.view.scale * scene.view.scale);
}

/// Puts labels on collections. Where there are few, each gets a large one; where there are many,
/// the largest of three sizes that does not hide it.
class CollectionLabels {
 public:
  CollectionLabels(LabelPainter& plates, const FrameScene& scene)
      : plates_(plates), scene_(scene), crowded_(scene.snapshot.collections.size() > kFew) {}

  /// False when there is no room.
  bool put(const CollectionView& collection) {
    const std::string text = fmt::format("C{}", value(collection.id));
    const float covered = coveredArea(scene_, collection);
    const Color outline = standingOut(scene_, collection.id);
    for (const Size& size : sizes_) {
      if (crowded_ && size.part * plates_.area(text, size.print) > covered) continue;
      const auto places =
          size.small ? smallPlaces(scene_, collection) : memberPlaces(scene_, collection);
      if (putAtOneOf(places, text, size.print, outline)) return true;
    }
    return false;
  }

 private:
  bool putAtOneOf(const std::vector<Vec2>& places, const std::string& text, const Print& print,
                  Color outline) {
    for (const Pixel nudge : kNudges) {
      for (const Vec2& place : places) {
        const Pixel at = scene_.view(place) + nudge * scene_.unit();
        if (plates_.put(text, print, at, outline)) return true;
      }
    }
    return false;
  }

  /// A size, and how many times as large as its plate a collection has to be.
  struct Size {
    Print print;
    float part;
    bool small = false;
  };
  static constexpr std::size_t kFew = 8;
  static constexpr int kLeast = 9;  // smaller print is not legible [px]
  /// How far a label goes out of the way of another one, still on its member [design px].
  static constexpr std::array<Pixel, 5> kNudges = {
      {{0.0F, 0.0F}, {0.0F, -4.0F}, {0.0F, 4.0F}, {-6.0F, 0.0F}, {6.0F, 0.0F}}};

  LabelPainter& plates_;
  const FrameScene& scene_;
  bool crowded_;
  std::array<Size, 3> sizes_ = {{
      {{scene_.font(13.0F, Weight::Bold)}, 2.0F},
      {{scene_.font(11.0F, Weight::Bold), 4.0F, 3.0F}, 2.0F},
      {{scene_.font(9.0F, Weight::Bold, kLeast), 2.0F, 2.0F, 1.2F, 3.0F}, 1.2F, true},
  }};
};

/// Larger collections choose first: they have the right to larger print.
std::vector<const CollectionView*> bySize(const Snapshot& snapshot) {
  std::vector<const CollectionView*> sorted;
  for (const CollectionView& c : snapshot.collections) sorted.push_back(&c);
  std::ranges::stable_sort(sorted, std::ranges::greater{},
                           [](const CollectionView* c) { return c->bodies.size(); });
  return sorted;
}

void nameBodies(LabelPainter& plates, const FrameScene& scene) {
  const Print print{scene.font(12.0F)};
  for (const BodyState& body : scene.snapshot.bodies) {
    const std::string& name = scene.info(body.id).name;
    if (!name.empty()) plates.put(name, print, scene.view(body.x), finishOf(scene, body).outline);
  }
}

}  // namespace

FrameLabels::FrameLabels(Text& text, const FrameScene& scene) : plates(text, scene) {
  if (scene.shows(Overlay::Labels)) {
    CollectionLabels labels(plates, scene);
    for (const CollectionView* c : bySize(scene.snapshot)) {
      if (!labels.put(*c)) without.push_back(c);
    }
  }
  if (scene.shows(Overlay::Names)) nameBodies(plates, scene);
}

}  // namespace merge2d
