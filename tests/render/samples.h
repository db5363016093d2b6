#pragma once
/// Hand-built runs to draw: no engine is needed for them.

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "render/camera.h"
#include "render/style.h"
#include "src2d/trace/snapshot.h"

namespace merge2d::samples {

/// Bodies and one snapshot of them.
struct Sample {
  std::vector<BodyInfo> bodies;
  Snapshot snapshot;

  BodyState& add(std::vector<ConvexShape> shapes, const Vec2& at, double angle = 0.0,
                 Motion motion = Motion::Dynamic) {
    const BodyId id{static_cast<std::uint32_t>(bodies.size())};
    bodies.push_back({.name = "body " + std::to_string(index(id)),
                      .motion = motion,
                      .mass = areaProperties(shapes).area,
                      .shapes = std::move(shapes)});
    return snapshot.bodies.emplace_back(
        BodyState{.id = id, .x = at, .angle = angle, .pinned = motion == Motion::Pinned});
  }

  BodyState& box(const Vec2& at, double width, double height, double angle = 0.0,
                 Motion motion = Motion::Dynamic) {
    return add({makeBox(width, height)}, at, angle, motion);
  }

  BodyState& disc(const Vec2& at, double radius, double angle = 0.0) {
    return add({Circle{Vec2::Zero(), radius}}, at, angle);
  }

  /// Makes `members` the collection `id`.
  void collect(int id, const std::vector<BodyId>& members, bool asleep = false) {
    CollectionView view;
    view.id = CollectionId{id};
    view.bodies = members;
    view.asleep = asleep;
    std::vector<Vec2> points;
    for (const BodyId member : members) {
      BodyState& body = snapshot.bodies[index(member)];
      body.collection = view.id;
      body.asleep = asleep;
      view.x += body.x / static_cast<double>(members.size());
      for (const ConvexShape& shape : bodies[index(member)].shapes) {
        for (const Vec2& p : outlinePoints(shape)) points.push_back(body.pose() * p);
      }
    }
    view.box = tightBox(points);
    snapshot.collections.push_back(view);
  }

  void contact(BodyId a, BodyId b, const Vec2& at, const Vec2& normal, double lambda_n,
               double lambda_t = 0.0, ContactState state = ContactState::Sticking) {
    const BodyState &p = snapshot.bodies[index(a)], &q = snapshot.bodies[index(b)];
    const bool internal = p.collection != kNoCollection && p.collection == q.collection;
    snapshot.contacts.push_back({.a = a,
                                 .b = b,
                                 .x = at,
                                 .normal = normal,
                                 .lambda_n = lambda_n,
                                 .lambda_t = lambda_t,
                                 .state = state,
                                 .internal = internal});
  }

  /// Counts what the snapshot holds.
  void count() {
    Stats& s = snapshot.stats;
    s = {};
    for (const BodyState& body : snapshot.bodies) {
      if (bodies[index(body.id)].motion != Motion::Dynamic) continue;
      ++s.bodies;
      if (body.asleep) ++s.asleep;
      if (body.collection == kNoCollection && !body.asleep) ++s.active_bodies;
    }
    s.collections = static_cast<int>(snapshot.collections.size());
    for (const CollectionView& c : snapshot.collections) s.active_bodies += c.asleep ? 0 : 1;
    for (const ContactView& c : snapshot.contacts)
      ++(c.internal ? s.internal_contacts : s.contacts);
  }
};

inline BodyId id(std::size_t i) { return BodyId{static_cast<std::uint32_t>(i)}; }

/// A running-bond wall of `columns` × `rows` boxes of 1 m × 0.5 m on a platform, with two contacts
/// between each pair that touches, in `collections` vertical slices.
inline Sample tower(int columns, int rows, int collections) {
  Sample s;
  s.box({0.0, -0.25}, columns + 4.0, 0.5, 0.0, Motion::Scripted);
  std::vector<std::vector<BodyId>> slices(static_cast<std::size_t>(collections));
  const auto brick = [&](int row, int column) {
    return id(static_cast<std::size_t>(1 + row * columns + column));
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = column - 0.5 * (columns - 1) + (row % 2 == 0 ? -0.25 : 0.25);
      s.box({x, 0.25 + 0.5 * row}, 1.0, 0.5);
      const int slice = std::min(collections - 1, (row * collections) / rows);
      slices[static_cast<std::size_t>(slice)].push_back(brick(row, column));
    }
  }
  int next = 1;
  for (const auto& slice : slices) s.collect(next++, slice);
  for (int row = 1; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec2 at = s.snapshot.bodies[index(brick(row, column))].x;
      const int side = row % 2 == 0 ? -1 : 1;
      const double load = 0.5 * 9.81 * 0.01 * (rows - row) * 0.25;
      for (const double dx : {-0.48, -0.02}) {
        const int below = side < 0 ? column - 1 : column;
        if (below >= 0) {
          s.contact(brick(row - 1, below), brick(row, column), at + Vec2(dx, -0.25), {0.0, 1.0},
                    load);
        }
        const int next_below = below + 1;
        if (next_below < columns) {
          s.contact(brick(row - 1, next_below), brick(row, column), at + Vec2(-dx, -0.25),
                    {0.0, 1.0}, load, 0.2 * load);
        }
      }
    }
  }
  s.count();
  return s;
}

/// One of each: discs, boxes, polygons, compounds; free, merged, asleep, pinned, scripted.
inline Sample mixture() {
  Sample s;
  s.box({0.0, -500.0}, 4000.0, 1000.0, 0.0, Motion::Pinned);
  s.box({-5.0, 0.5}, 2.0, 1.0);
  s.box({-5.2, 1.5}, 1.0, 1.0);
  s.disc({-2.6, 0.8}, 0.8, 0.7);
  std::vector<Vec2> hexagon, octagon;
  for (int i = 0; i < 6; ++i) {
    hexagon.push_back(Rotation::of(std::numbers::pi * i / 3) * Vec2(0.9, 0.0));
  }
  for (int i = 0; i < 8; ++i) {
    octagon.push_back(Rotation::of(std::numbers::pi * (i + 0.5) / 4) * Vec2(0.8, 0.0));
  }
  s.add({Polygon{hexagon}}, {-0.6, 0.78}, 0.0);
  s.add({Polygon{octagon}}, {1.5, 0.74}, 0.0);
  s.add({Polygon{{{-0.8, -0.5}, {0.8, -0.5}, {0.0, 0.9}}}}, {3.4, 0.5});
  // An L, a Z whose pieces share parts of their edges, and a dumb-bell of a bar and two discs.
  s.add({makeBox(2.0, 0.8, Pose::at({0.0, -0.6}, 0.0)),
         makeBox(0.8, 1.2, Pose::at({-0.6, 0.4}, 0.0))},
        {5.8, 1.0});
  s.add({makeBox(1.2, 0.6, Pose::at({-0.4, -0.3}, 0.0)),
         makeBox(1.2, 0.6, Pose::at({0.4, 0.3}, 0.0))},
        {0.5, 3.0}, 0.3);
  s.add({makeBox(1.6, 0.2), Circle{{-0.8, 0.0}, 0.4}, Circle{{0.8, 0.0}, 0.4}}, {-2.5, 3.4}, -0.4);
  s.box({3.2, 3.6}, 2.5, 0.3, 0.2, Motion::Scripted);
  s.disc({-5.2, 2.4}, 0.4);
  s.collect(1, {id(1), id(2), id(11)});
  s.collect(2, {id(4), id(5)});
  s.collect(3, {id(6), id(7)}, true);
  s.snapshot.bodies[3].asleep = true;
  s.contact(id(1), id(2), {-5.7, 1.0}, {0.0, 1.0}, 0.08, 0.01);
  s.contact(id(1), id(2), {-4.7, 1.0}, {0.0, 1.0}, 0.06, 0.01);
  s.contact(id(2), id(11), {-5.2, 2.0}, {0.0, 1.0}, 0.03);
  s.contact(id(0), id(1), {-6.0, 0.0}, {0.0, 1.0}, 0.12, -0.02);
  s.contact(id(0), id(1), {-4.0, 0.0}, {0.0, 1.0}, 0.12, 0.03);
  s.contact(id(0), id(3), {-2.6, 0.0}, {0.0, 1.0}, 0.1);
  s.contact(id(4), id(5), {0.55, 0.74}, {1.0, 0.0}, 0.05, 0.02);
  s.contact(id(0), id(6), {2.7, 0.0}, {0.0, 1.0}, 0.08);
  s.contact(id(5), id(6), {2.45, 0.4}, {1.0, 0.0}, 0.0, 0.0, ContactState::Broken);
  s.snapshot.events = {
      {.type = EventType::Unmerge, .a = id(6), .b = id(5), .reason = EventReason::Broken}};
  s.snapshot.welds = {{id(1), id(2), 2}, {id(2), id(11), 1}, {id(4), id(5), 1}, {id(6), id(7), 1}};
  s.snapshot.springs = {{.from = {-2.5, 3.4}, .to = {-2.5, 5.6}, .force = 3.0}};
  s.snapshot.bodies[8].v = {3.0, -1.5};
  s.snapshot.bodies[9].v = {-1.0, 2.0};
  s.snapshot.step = 123;
  s.snapshot.time = 1.23;
  s.count();
  return s;
}

/// A style fitted to a sample.
inline FrameStyle styleOf(const Sample& sample, const std::string& title, int width, int height,
                          const Overlays& overlays = Overlays::standard(),
                          const Theme& theme = lightTheme()) {
  FrameStyle style;
  style.width = width;
  style.height = height;
  style.overlays = overlays;
  style.theme = theme;
  Scene scene;
  scene.title = title;
  adaptToScene(style, scene, sample.snapshot, sample.bodies);
  return style;
}

}  // namespace merge2d::samples
