/// Overlays that lie in the world: springs, graph, welds, boxes, contacts, forces, velocities.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "render/frame_parts.h"

namespace merge2d {
namespace {

/// The mean contact point of each pair in contact.
std::map<BodyPair, Vec2> meetingPoints(const Snapshot& snapshot) {
  std::map<BodyPair, std::pair<Vec2, int>> sums;
  for (const ContactView& contact : snapshot.contacts) {
    auto& [sum, count] =
        sums.try_emplace(ordered(contact.a, contact.b), Vec2::Zero(), 0).first->second;
    sum += contact.x;
    ++count;
  }
  std::map<BodyPair, Vec2> means;
  for (const auto& [pair, entry] : sums) means[pair] = entry.first / entry.second;
  return means;
}

void drawSprings(Painter& painter, const FrameScene& scene) {
  constexpr int kTeeth = 12;
  const float width = scene.px(1.5F), reach = scene.px(5.0F);
  for (const SpringView& spring : scene.snapshot.springs) {
    const Pixel a = scene.view(spring.from), b = scene.view(spring.to);
    const Pixel along = b - a;
    const float length = std::max(std::hypot(along.x, along.y), 1e-3F);
    const Pixel across = Pixel{-along.y, along.x} * (reach / length);
    Pixel last = a;
    for (int i = 0; i <= kTeeth; ++i) {
      const float t = 0.1F + 0.8F * static_cast<float>(i) / kTeeth;
      const float side = i == 0 || i == kTeeth ? 0.0F : i % 2 == 0 ? 1.0F : -1.0F;
      const Pixel next = a + along * t + across * side;
      painter.line(last, next, width, scene.theme().spring);
      last = next;
    }
    painter.line(last, b, width, scene.theme().spring);
    for (const Pixel end : {a, b}) painter.disc(end, 2.0F * width, {.fill = scene.theme().spring});
  }
}

/// Where the link of a body ends: at its centre, or, for a fixed one, where the two meet.
Vec2 linkEnd(const FrameScene& scene, BodyId id, const Vec2& meeting) {
  const BodyState* body = scene.body(id);
  return body == nullptr || isFixed(scene, *body) ? meeting : body->x;
}

void drawLink(Painter& painter, const FrameScene& scene, const BodyPair& pair, const Vec2& meeting,
              float width, Color color) {
  const Pixel a = scene.view(linkEnd(scene, pair.first, meeting));
  const Pixel b = scene.view(linkEnd(scene, pair.second, meeting));
  painter.line(a, b, width + 2.0F * scene.px(1.0F), withAlpha(scene.theme().rim, 0.85));
  painter.line(a, b, width, color);
}

void drawNodes(Painter& painter, const FrameScene& scene, float radius) {
  for (const BodyState& body : scene.snapshot.bodies) {
    if (isFixed(scene, body)) continue;
    painter.disc(scene.view(body.x), radius,
                 {.fill = scene.theme().graph, .outline = scene.theme().rim, .line = scene.px(1)});
  }
}

void drawGraph(Painter& painter, const FrameScene& scene) {
  for (const auto& [pair, meeting] : meetingPoints(scene.snapshot)) {
    drawLink(painter, scene, pair, meeting, scene.px(1.3F), scene.theme().graph);
  }
  drawNodes(painter, scene, std::clamp(0.1F * scene.bodySize(), 1.5F, scene.px(4.5F)));
}

void drawWelds(Painter& painter, const FrameScene& scene) {
  const std::map<BodyPair, Vec2> meetings = meetingPoints(scene.snapshot);
  const float width = std::clamp(0.09F * scene.bodySize(), 1.0F, scene.px(4.0F));
  for (const WeldView& weld : scene.snapshot.welds) {
    const BodyState *a = scene.body(weld.a), *b = scene.body(weld.b);
    if (a == nullptr || b == nullptr) continue;
    const auto found = meetings.find(ordered(weld.a, weld.b));
    const Vec2 meeting = found != meetings.end() ? found->second : isFixed(scene, *a) ? b->x : a->x;
    drawLink(painter, scene, ordered(weld.a, weld.b), meeting, width, scene.theme().graph);
  }
}

void drawBoxes(Painter& painter, const FrameScene& scene) {
  for (const CollectionView& collection : scene.snapshot.collections) {
    const OrientedBox& box = collection.box;
    const float line = scene.px(2.0F), pad = scene.px(3.0F);
    const Pixel half{scene.view(box.half.x()), scene.view(box.half.y())};
    const Pixel axis = View::direction({box.frame.rotation.c, box.frame.rotation.s});
    const Pixel center = scene.view(box.frame.position);
    painter.box(center, axis, half, pad + line,
                {.outline = withAlpha(scene.theme().rim, 0.8), .line = 2.0F * line});
    painter.box(center, axis, half, pad, {.outline = scene.theme().box, .line = line});
  }
}

float markRadius(const FrameScene& scene) {
  return std::clamp(0.12F * scene.bodySize(), 1.8F, scene.px(5.0F));
}

/// The pairs that came apart in this step.
std::set<BodyPair> partedPairs(const Snapshot& snapshot) {
  std::set<BodyPair> pairs;
  for (const Event& event : snapshot.events) {
    if (event.type == EventType::Unmerge) pairs.insert(ordered(event.a, event.b));
  }
  return pairs;
}

/// Contacts that carry no force are shown when they have just broken.
void drawContacts(Painter& painter, const FrameScene& scene) {
  const float radius = markRadius(scene);
  const std::set<BodyPair> parted = partedPairs(scene.snapshot);
  for (const ContactView& contact : scene.snapshot.contacts) {
    const Pixel at = scene.view(contact.x);
    if (contact.state == ContactState::Broken) {
      if (parted.contains(ordered(contact.a, contact.b))) {
        drawBrokenMark(painter, scene, at, radius);
      }
    } else if (contact.internal) {
      drawMergedMark(painter, scene, at, radius);
    } else {
      drawActiveMark(painter, scene, at, radius);
    }
  }
}

ArrowPaint arrowPaint(const FrameScene& scene, Color color) {
  const float width = std::clamp(0.07F * scene.bodySize(), scene.px(1.1F), scene.px(2.6F));
  return {.color = color, .rim = scene.theme().rim, .width = width, .rim_width = scene.px(1.0F)};
}

/// An arrow of the vector `v` [m] from `from`; too short ones are left out, too long ones cut.
/// It starts `gap` pixels further on.
void drawVector(Painter& painter, const FrameScene& scene, const Vec2& from, const Vec2& v,
                Color color, float gap = 0.0F) {
  const double length = v.norm() * scene.view.scale;
  if (length < double{scene.px(3.0F)}) return;
  const double longest = 0.4 * double{scene.view.panel.height};
  const Vec2 shown = length > longest ? Vec2(v * (longest / length)) : v;
  const Pixel aside = View::direction(v.normalized()) * gap;
  painter.arrow(scene.view(from) + aside, scene.view(from + shown) + aside,
                arrowPaint(scene, color));
}

/// The forces on b; a gets the opposite ones.
void drawForces(Painter& painter, const FrameScene& scene) {
  const double scale = scene.style.force_scale / scene.style.step;
  const Theme& theme = scene.theme();
  const float gap = scene.shows(Overlay::Contacts) ? markRadius(scene) : 0.0F;
  for (const ContactView& c : scene.snapshot.contacts) {
    const Vec2 normal = scale * c.lambda_n * c.normal;
    const Vec2 friction = scale * c.lambda_t * perpendicular(c.normal);
    const Color color = c.internal ? theme.internal_force : theme.normal_force;
    drawVector(painter, scene, c.x, normal, color, gap);
    drawVector(painter, scene, c.x, friction,
               c.internal ? theme.internal_force : theme.friction_force, gap);
  }
}

void drawVelocities(Painter& painter, const FrameScene& scene) {
  for (const BodyState& body : scene.snapshot.bodies) {
    if (scene.info(body.id).motion == Motion::Pinned) continue;
    drawVector(painter, scene, body.x, scene.style.velocity_scale * body.v, scene.theme().velocity);
  }
}

}  // namespace

void drawMergedMark(Painter& painter, const FrameScene& scene, Pixel at, float radius) {
  const float rim = std::min(scene.px(1.0F), 0.5F * radius);
  painter.box(at, {1.0F, 0.0F}, {0.8F * radius, 0.8F * radius}, rim,
              {.fill = scene.theme().merged_contact, .outline = scene.theme().rim, .line = rim});
}

void drawActiveMark(Painter& painter, const FrameScene& scene, Pixel at, float radius) {
  const float line = std::max(1.0F, 0.36F * radius), rim = std::min(scene.px(1.0F), 0.5F * radius);
  painter.disc(at, radius + rim, {.fill = scene.theme().rim});
  painter.disc(at, radius,
               {.fill = scene.theme().rim, .outline = scene.theme().active_contact, .line = line});
}

void drawBrokenMark(Painter& painter, const FrameScene& scene, Pixel at, float radius) {
  const float width = std::max(1.0F, 0.45F * radius), rim = std::min(scene.px(1.0F), 0.5F * radius);
  const Theme& theme = scene.theme();
  for (const auto& [w, color] :
       {std::pair{width + 2.0F * rim, theme.rim}, std::pair{width, theme.broken_contact}}) {
    painter.line(at - Pixel{radius, radius}, at + Pixel{radius, radius}, w, color);
    painter.line(at - Pixel{radius, -radius}, at + Pixel{radius, -radius}, w, color);
  }
}

void drawMarks(Painter& painter, const FrameScene& scene) {
  drawSprings(painter, scene);
  drawJoints(painter, scene);
  if (scene.shows(Overlay::Graph)) drawGraph(painter, scene);
  if (scene.shows(Overlay::Welds)) drawWelds(painter, scene);
  if (scene.shows(Overlay::Boxes)) drawBoxes(painter, scene);
  if (scene.shows(Overlay::Contacts)) drawContacts(painter, scene);
  if (scene.shows(Overlay::Forces)) drawForces(painter, scene);
  if (scene.shows(Overlay::Velocities)) drawVelocities(painter, scene);
}

}  // namespace merge2d
