#include <algorithm>

#include "api/handles.h"

using merge2d::BodyId;
using merge2d::change;
using merge2d::given;
using merge2d::guarded;
using merge2d::toVec;

namespace merge2d {
namespace {

const BodyInfo& infoOf(const m2_world& world, m2_body body) {
  const auto& bodies = world.world.bodies();
  if (body < bodies.size()) return bodies[body];
  throw InputError(fmt::format("there is no body {}: the world has {}", body, bodies.size()));
}

m2_piece pieceOf(const ConvexShape& shape) {
  m2_piece piece{};
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    piece.center = fromVec(circle->center);
    piece.radius = circle->radius;
    return piece;
  }
  const auto& vertices = std::get<Polygon>(shape).vertices;
  piece.vertex_count = vertices.size();
  for (std::size_t i = 0; i < vertices.size(); ++i) piece.vertices[i] = fromVec(vertices[i]);
  piece.center = fromVec(areaProperties(shape).centroid);
  return piece;
}

/// A name stands for one body of the run, also after that was removed: as in scenes.
void requireNewName(const std::vector<BodyInfo>& bodies, const std::string& name) {
  if (name.empty()) return;
  const auto has_it = [&](const BodyInfo& body) { return body.name == name; };
  if (std::any_of(bodies.begin(), bodies.end(), has_it)) {
    throw InputError(fmt::format("two bodies are called '{}'", name));
  }
}

/// Of the hand's spring: how fast it would swing on its own [rad/s].
constexpr double kHandSwing = 12.0;

}  // namespace
}  // namespace merge2d

size_t m2_world_body_count(const m2_world* world) {
  return world == nullptr ? 0 : world->world.bodies().size();
}

m2_status m2_world_body_info(m2_world* world, m2_body body, m2_body_info* info) {
  return guarded([&] {
    m2_world& w = given(world, "world");
    m2_body_info& out = given(info, "info");
    const merge2d::BodyInfo& found = merge2d::infoOf(w, body);
    out = {.name = found.name.c_str(),
           .motion = static_cast<m2_motion>(found.motion),
           .mass = found.mass,
           .inertia = found.inertia,
           .present = w.places().pose(BodyId{body}).has_value()};
  });
}

m2_status m2_world_find_body(m2_world* world, const char* name, m2_body* body) {
  return guarded([&] {
    const auto& bodies = given(world, "world").world.bodies();
    given(body, "body") = merge2d::bodyCalled(bodies, &given(name, "name"));
  });
}

m2_status m2_world_body_pieces(m2_world* world, m2_body body, m2_piece* pieces, size_t capacity,
                               size_t* count) {
  return guarded([&] {
    const auto& shapes = merge2d::infoOf(given(world, "world"), body).shapes;
    given(count, "count") = shapes.size();
    for (std::size_t i = 0; i < std::min(capacity, shapes.size()); ++i) {
      (&given(pieces, "pieces"))[i] = merge2d::pieceOf(shapes[i]);
    }
  });
}

m2_status m2_world_add_body(m2_world* world, const m2_body_def* def, m2_body* body) {
  return change(world, [&](m2_world& w) {
    if (w.world.bodies().size() >= merge2d::SceneLimits::kBodies) {
      throw merge2d::InputError(
          fmt::format("a world has at most {} bodies", merge2d::SceneLimits::kBodies));
    }
    const merge2d::BodyDesc desc = merge2d::toDesc(given(def, "def"));
    merge2d::requireNewName(w.world.bodies(), desc.name);
    const BodyId id = w.world.addBody(desc);
    if (body != nullptr) *body = static_cast<m2_body>(id);
  });
}

m2_status m2_world_remove_body(m2_world* world, m2_body body) {
  return change(world, [&](m2_world& w) { w.world.removeBody(BodyId{body}); });
}

m2_status m2_world_add_spring(m2_world* world, const m2_spring_def* def, m2_spring* spring) {
  return change(world, [&](m2_world& w) {
    const m2_spring id = w.world.addSpring(merge2d::toDesc(given(def, "def")));
    if (spring != nullptr) *spring = id;
  });
}

m2_status m2_world_move_spring(m2_world* world, m2_spring spring, m2_vec to) {
  return change(world, [&](m2_world& w) { w.world.moveSpring(spring, toVec(to)); });
}

m2_status m2_world_remove_spring(m2_world* world, m2_spring spring) {
  return change(world, [&](m2_world& w) { w.world.removeSpring(spring); });
}

m2_status m2_world_add_joint(m2_world* world, const m2_joint_def* def, m2_joint* joint) {
  return change(world, [&](m2_world& w) {
    const m2_joint id = w.world.addJoint(merge2d::toDesc(given(def, "def")));
    if (joint != nullptr) *joint = id;
  });
}

m2_status m2_world_remove_joint(m2_world* world, m2_joint joint) {
  return change(world, [&](m2_world& w) { w.world.removeJoint(joint); });
}

m2_status m2_world_drag(m2_world* world, m2_body body, m2_vec grip, m2_spring* spring) {
  return change(world, [&](m2_world& w) {
    m2_spring& out = given(spring, "spring");
    const merge2d::Vec2 anchor = w.world.toBodyFrame(BodyId{body}, toVec(grip));
    const double mass = merge2d::infoOf(w, body).mass;
    out = w.world.addSpring({.body = body,
                             .anchor = anchor,
                             .to = toVec(grip),
                             .to_body = std::nullopt,
                             .stiffness = mass * merge2d::kHandSwing * merge2d::kHandSwing,
                             .damping = 2.0 * mass * merge2d::kHandSwing,
                             .rest_length = 0.0});
  });
}

m2_status m2_world_apply_impulse(m2_world* world, m2_body body, m2_vec at, m2_vec impulse) {
  return change(
      world, [&](m2_world& w) { w.world.applyImpulse(BodyId{body}, toVec(at), toVec(impulse)); });
}

m2_status m2_world_apply_force(m2_world* world, m2_body body, m2_vec at, m2_vec force) {
  return change(world,
                [&](m2_world& w) { w.world.applyForce(BodyId{body}, toVec(at), toVec(force)); });
}

m2_status m2_world_set_pose(m2_world* world, m2_body body, m2_vec center, double angle) {
  return change(world, [&](m2_world& w) { w.world.setPose(BodyId{body}, toVec(center), angle); });
}

m2_status m2_world_set_velocity(m2_world* world, m2_body body, m2_vec v, double omega) {
  return change(world, [&](m2_world& w) { w.world.setVelocity(BodyId{body}, toVec(v), omega); });
}

m2_status m2_world_set_friction(m2_world* world, m2_body body, double friction) {
  return change(world, [&](m2_world& w) { w.world.setFriction(BodyId{body}, friction); });
}

m2_status m2_world_pin(m2_world* world, m2_body body) {
  return change(world, [&](m2_world& w) { w.world.pin(BodyId{body}); });
}
m2_status m2_world_unpin(m2_world* world, m2_body body) {
  return change(world, [&](m2_world& w) { w.world.unpin(BodyId{body}); });
}
m2_status m2_world_release(m2_world* world, m2_body body) {
  return change(world, [&](m2_world& w) { w.world.release(BodyId{body}); });
}
m2_status m2_world_wake(m2_world* world, m2_body body) {
  return change(world, [&](m2_world& w) { w.world.wake(BodyId{body}); });
}
