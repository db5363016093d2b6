#include <algorithm>
#include <cmath>

#include "api/handles.h"
#include "src2d/scene/check.h"
#include "src2d/scene/names.h"

namespace merge2d {
namespace {

std::optional<BodyIndex> toBody(m2_body body) {
  if (body == M2_NO_BODY) return std::nullopt;
  return body;
}

template <class E>
E enumerator(int value, int count, const char* what) {
  if (value >= 0 && value < count) return static_cast<E>(value);
  throw InputError(fmt::format("there is no {} {}", what, value));
}

std::vector<Vec2> outlineOf(const m2_shape& shape) {
  if (shape.vertex_count > SceneLimits::kVertices) {
    throw InputError(fmt::format("a polygon has at most {} vertices, not {}",
                                 SceneLimits::kVertices, shape.vertex_count));
  }
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < shape.vertex_count; ++i) {
    outline.push_back(toVec((&given(shape.vertices, "vertices"))[i]));
    if (!outline.back().allFinite()) throw InputError("the vertices of a polygon must be finite");
  }
  return outline;
}

void requireLength(double length, const char* what) {
  if (length >= SceneLimits::kSmallest && length <= SceneLimits::kCoordinate) return;
  throw InputError(fmt::format(
      "the {} of a shape must be a positive length (1e-4 to 1e6 m), but is {}", what, length));
}

Script toScript(const m2_script& script) {
  switch (enumerator<m2_script_kind>(script.kind, 3, "kind of script")) {
    case M2_SINUSOID:
      if (script.amplitude == 0.0 && script.period == 0.0) {  // as in m2_body_def_default
        throw InputError("a scripted body needs a script: a sinusoid, key frames or a velocity");
      }
      return Sinusoid{toVec(script.axis), script.amplitude, script.period};
    case M2_STEADY:
      return SteadyMotion{toVec(script.velocity), script.spin};
    case M2_KEYFRAMES:
      break;
  }
  Keyframes frames;
  for (std::size_t i = 0; i < script.key_count; ++i) {
    const m2_key& key = (&given(script.keys, "keys"))[i];
    frames.keys.push_back({key.time, toVec(key.position), key.angle});
  }
  return frames;
}

}  // namespace

std::vector<ConvexShape> toShapes(const m2_shape& shape) {
  const Vec2 center = toVec(shape.center);
  if (!center.allFinite() || !std::isfinite(shape.angle)) {
    throw InputError("the place of a shape must be finite");
  }
  switch (enumerator<m2_shape_kind>(shape.kind, 3, "kind of shape")) {
    case M2_CIRCLE:
      requireLength(shape.radius, "radius");
      return {Circle{center, shape.radius}};
    case M2_BOX:
      requireLength(shape.size.x, "width");
      requireLength(shape.size.y, "height");
      return {makeBox(shape.size.x, shape.size.y, Pose::at(center, shape.angle))};
    case M2_POLYGON:
      break;
  }
  std::vector<ConvexShape> pieces;
  const Pose pose = Pose::at(center, shape.angle);
  for (const Polygon& piece : convexPieces(outlineOf(shape))) {
    pieces.push_back(transformed(piece, pose));
  }
  return pieces;
}

BodyDesc toDesc(const m2_body_def& def) {
  BodyDesc body;
  if (def.name != nullptr) body.name = def.name;
  body.motion = enumerator<Motion>(def.motion, 3, "motion");
  body.at = toVec(def.position);
  body.angle = def.angle;
  body.velocity = toVec(def.velocity);
  body.spin = def.spin;
  for (std::size_t i = 0; i < def.shape_count; ++i) {
    const auto pieces = toShapes((&given(def.shapes, "shapes"))[i]);
    body.shapes.insert(body.shapes.end(), pieces.begin(), pieces.end());
  }
  if (def.mass != 0.0) body.mass = def.mass;
  body.density = def.density;
  body.friction = def.friction;
  body.restitution = def.restitution;
  body.rolling = def.rolling;
  body.surface_velocity = def.surface_velocity;
  body.pinned_until = def.pinned_until;
  if (body.motion == Motion::Scripted) body.script = toScript(def.script);
  checkBody(body);
  return body;
}

SpringDesc toDesc(const m2_spring_def& def) {
  return {.body = def.body,
          .anchor = toVec(def.anchor),
          .to = toVec(def.to),
          .to_body = toBody(def.to_body),
          .stiffness = def.stiffness,
          .damping = def.damping,
          .rest_length = def.rest_length};
}

JointDesc toDesc(const m2_joint_def& def) {
  JointDesc joint;
  joint.kind = enumerator<JointKind>(def.kind, 4, "kind of joint");
  joint.a = def.a;
  joint.b = toBody(def.b);
  joint.at = toVec(def.at);
  joint.to = toVec(def.to);
  joint.axis = toVec(def.axis);
  if (def.length != 0.0) joint.length = def.length;
  joint.stiffness = def.stiffness;
  joint.damping = def.damping;
  if (def.limited) joint.limits = {def.lower, def.upper};
  if (def.motor) joint.motor = {def.motor_speed, def.motor_strength};
  joint.compliance = def.compliance;
  joint.break_force = def.break_force;
  joint.break_torque = def.break_torque;
  joint.collide = def.collide;
  return joint;
}

Mode toMode(m2_mode mode) { return enumerator<Mode>(mode, 4, "mode"); }

}  // namespace merge2d

using merge2d::guarded;

m2_shape m2_circle(double radius) {
  m2_shape shape{};
  shape.kind = M2_CIRCLE;
  shape.radius = radius;
  return shape;
}

m2_shape m2_box(double width, double height) {
  m2_shape shape{};
  shape.kind = M2_BOX;
  shape.size = {width, height};
  return shape;
}

m2_shape m2_polygon(const m2_vec* vertices, size_t count) {
  m2_shape shape{};
  shape.kind = M2_POLYGON;
  shape.vertices = vertices;
  shape.vertex_count = count;
  return shape;
}

m2_body_def m2_body_def_default() {
  m2_body_def def{};
  def.density = 1.0;
  def.friction = 0.6;
  def.script.axis = {1.0, 0.0};
  return def;
}

m2_spring_def m2_spring_def_default() {
  m2_spring_def def{};
  def.to_body = M2_NO_BODY;
  return def;
}

m2_joint_def m2_joint_def_default() {
  m2_joint_def def{};
  def.b = M2_NO_BODY;
  def.axis = {1.0, 0.0};
  def.break_force = def.break_torque = merge2d::kForever;
  return def;
}

const char* m2_mode_name(m2_mode mode) {
  const auto& names = merge2d::kNames<merge2d::Mode>;
  const auto i = static_cast<std::size_t>(mode);
  return i < names.size() ? names[i].first.data() : "unknown";
}

m2_status m2_mode_from_name(const char* name, m2_mode* mode) {
  return guarded([&] {
    const std::string word = &merge2d::given(name, "name");
    const auto found = merge2d::valueOf<merge2d::Mode>(word);
    if (!found) {
      throw merge2d::InputError(fmt::format(
          "there is no mode '{}': the modes are reference, sleep, merge, merge+sleep", word));
    }
    merge2d::given(mode, "mode") = static_cast<m2_mode>(*found);
  });
}
