/// Scenes as text, without values that are the default.

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "src2d/scene/load.h"
#include "src2d/scene/settings_list.h"
#include "src2d/scene/toml_reader.h"

namespace merge2d {
namespace {

/// Without its point a TOML parser would take the sign of -0 away.
std::string written(double number) {
  return number == 0.0 && std::signbit(number) ? "-0.0" : fmt::format("{}", number);
}
std::string written(int number) { return fmt::format("{}", number); }
std::string written(std::uint64_t number) { return fmt::format("{}", number); }
std::string written(bool truth) { return truth ? "true" : "false"; }
std::string written(const Vec2& v) {
  return fmt::format("[{}, {}]", written(v.x()), written(v.y()));
}
template <HasNames E>
std::string written(E value) {
  return fmt::format("\"{}\"", nameOf(value));
}

std::string written(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte < 0x20u || byte == 0x7Fu) {
      result += fmt::format("\\u{:04X}", byte);
    } else {
      result += c;
    }
  }
  return result + '"';
}

/// Writes keys and values, one in each line.
class TomlText {
 public:
  void heading(std::string_view line) { text_ += fmt::format("\n{}\n", line); }
  template <class T>
  void put(std::string_view key, const T& value) {
    raw(key, written(value));
  }
  /// Leaves out default values.
  template <class T>
  void put(std::string_view key, const T& value, const T& usual) {
    if (!(value == usual) || written(value) != written(usual)) put(key, value);
  }
  void raw(std::string_view key, std::string_view value) {
    text_ += fmt::format("{} = {}\n", key, value);
  }
  /// Whole lines.
  void lines(std::string_view text) { text_ += text; }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

// Shapes

/// "box = [1, 2]", when that is exactly the polygon; `center` is where it then is.
std::optional<std::string> boxKey(const Polygon& polygon, Vec2& center) {
  if (polygon.vertices.size() != 4) return std::nullopt;
  const Vec2 size = polygon.vertices[2] - polygon.vertices[0];
  const bool fits = size.minCoeff() >= kLength.lower && size.maxCoeff() <= kLength.upper;
  if (!fits) return std::nullopt;
  center = 0.5 * (polygon.vertices[0] + polygon.vertices[2]);
  if (makeBox(size.x(), size.y(), Pose::at(center, 0)).vertices != polygon.vertices) {
    return std::nullopt;
  }
  return fmt::format("box = {}", written(size));
}

std::string polygonKey(const Polygon& polygon) {
  std::string corners;
  for (const Vec2& corner : polygon.vertices) {
    corners += (corners.empty() ? "" : ", ") + written(corner);
  }
  return fmt::format("polygon = [{}]", corners);
}

/// The key of a shape, and where its own origin is in the body.
std::pair<std::string, Vec2> shapeKey(const ConvexShape& shape) {
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    return {fmt::format("circle = {}", circle->radius), circle->center};
  }
  Vec2 center = Vec2::Zero();
  const auto& polygon = std::get<Polygon>(shape);
  if (const auto box = boxKey(polygon, center)) return {*box, center};
  return {polygonKey(polygon), Vec2::Zero()};
}

std::string shapeLines(const std::vector<ConvexShape>& shapes) {
  const auto [first, origin] = shapeKey(shapes.front());
  if (shapes.size() == 1 && origin == Vec2::Zero()) return first + "\n";
  std::string lines = "shapes = [\n";
  for (const ConvexShape& shape : shapes) {
    const auto [key, at] = shapeKey(shape);
    const std::string place = at == Vec2::Zero() ? "" : ", at = " + written(at);
    lines += fmt::format("  {{ {}{} }},\n", key, place);
  }
  return lines + "]\n";
}

// Scripts

std::string written(const Sinusoid& s) {
  return fmt::format("{{ axis = {}, amplitude = {}, period = {} }}", written(s.axis),
                     written(s.amplitude), s.period);
}

std::string written(const Keyframes& path) {
  std::string rows;
  for (const Keyframes::Key& key : path.keys) {
    rows += fmt::format("{}[{}, {}, {}, {}]", rows.empty() ? "" : ", ", written(key.time),
                        written(key.position.x()), written(key.position.y()),
                        written(degrees(key.angle)));
  }
  return fmt::format("{{ keyframes = [{}] }}", rows);
}

std::string written(const SteadyMotion& motion) {
  return fmt::format("{{ velocity = {}, spin = {} }}", written(motion.velocity),
                     written(degrees(motion.spin)));
}

// The parts of a scene

void writeWorld(TomlText& out, const Scene& scene) {
  out.put("format", 1);
  out.put("title", scene.title);
  out.put("gravity", scene.gravity);
  out.put("step", scene.step);
  out.put("duration", scene.duration);
  out.put("seed", scene.seed);
}

void writeCamera(TomlText& out, const Scene& scene) {
  const double usual = Scene{}.margin;
  if (!scene.camera && !scene.follow && scene.margin == usual) return;
  out.heading("[camera]");
  if (scene.follow) out.put("follow", scene.bodies[*scene.follow].name);
  if (scene.camera) {
    out.put("center", scene.camera->center);
    out.put("height", scene.camera->height);
  }
  out.put("margin", scene.margin, usual);
}

/// All settings as (table, key, text).
std::vector<std::array<std::string, 3>> settingLines(const Settings& settings) {
  std::vector<std::array<std::string, 3>> lines;
  forEachSetting(settings,
                 [&](const char* table, const char* key, const auto& value, const Range&) {
                   lines.push_back({table, key, written(value)});
                 });
  return lines;
}

void writeSettings(TomlText& out, const Settings& settings) {
  const auto usual = settingLines(Settings{});
  const auto lines = settingLines(settings);
  std::string current;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] == usual[i]) continue;
    const auto& [table, key, value] = lines[i];
    if (table != current) out.heading(fmt::format("[{}]", table));
    current = table;
    out.raw(key, value);
  }
}

void writeBodyKeys(TomlText& out, const BodyDesc& body, const Material& material) {
  const bool follows_keys = body.script && std::holds_alternative<Keyframes>(*body.script);
  if (!body.name.empty()) out.put("name", body.name);
  out.put("motion", body.motion, Motion::Dynamic);
  if (!follows_keys) {
    out.put("at", body.at);
    out.put("angle", degrees(body.angle), 0.0);
  }
  out.put("velocity", body.velocity, Vec2(0, 0));
  out.put("spin", degrees(body.spin), 0.0);
  out.lines(shapeLines(body.shapes));
  if (body.mass) out.put("mass", *body.mass);
  out.put("density", body.density, material.density);
  out.put("friction", body.friction, material.friction);
  out.put("restitution", body.restitution, material.restitution);
  out.put("rolling", body.rolling, material.rolling);
  out.put("surface_velocity", body.surface_velocity, 0.0);
  out.put("pinned_until", body.pinned_until, 0.0);
  if (!body.script) return;
  out.raw("script", std::visit([](const auto& script) { return written(script); }, *body.script));
}

void writeBodies(TomlText& out, const Scene& scene) {
  for (const BodyDesc& body : scene.bodies) {
    out.heading("[[body]]");
    writeBodyKeys(out, body, scene.settings.material);
  }
}

void writeSprings(TomlText& out, const Scene& scene) {
  for (const SpringDesc& spring : scene.springs) {
    out.heading("[[spring]]");
    out.put("body", scene.bodies[spring.body].name);
    out.put("anchor", spring.anchor);
    if (spring.to_body) out.put("to_body", scene.bodies[*spring.to_body].name);
    out.put(spring.to_body ? "to_anchor" : "to", spring.to);
    out.put("stiffness", spring.stiffness);
    out.put("damping", spring.damping, 0.0);
    out.put("rest_length", spring.rest_length, 0.0);
  }
}

void writeImpulsesAndForces(TomlText& out, const Scene& scene) {
  for (const ImpulseDesc& impulse : scene.impulses) {
    out.heading("[[impulse]]");
    out.put("body", scene.bodies[impulse.body].name);
    out.put("at", impulse.at);
    out.put("impulse", impulse.impulse);
    out.put("time", impulse.time);
  }
  for (const ForceDesc& force : scene.forces) {
    out.heading("[[force]]");
    out.put("body", scene.bodies[force.body].name);
    out.put("at", force.at);
    out.put("force", force.force);
    out.put("from", force.from, 0.0);
    if (force.until < kForever) out.put("until", force.until);
  }
}

void writeMagnets(TomlText& out, const Scene& scene) {
  for (const MagnetDesc& magnet : scene.magnets) {
    out.heading("[[magnet]]");
    out.put("body", scene.bodies[magnet.body].name);
    const bool always =
        magnet.on.size() == 1 && magnet.on[0].from == 0.0 && magnet.on[0].until == kForever;
    if (always) continue;
    std::string rows;
    for (const auto& [from, until] : magnet.on) {
      rows += fmt::format("{}[{}, {}]", rows.empty() ? "" : ", ", from, until);
    }
    out.raw("on", fmt::format("[{}]", rows));
  }
}

/// The pair `[lower, upper]` in the units of the file.
std::string written(const JointDesc::Limits& limits, bool angles) {
  if (angles) return written(Vec2(degrees(limits.lower), degrees(limits.upper)));
  return written(Vec2(limits.lower, limits.upper));
}

std::string written(const JointDesc::Motor& motor, bool angles) {
  return fmt::format("{{ speed = {}, {} = {} }}", angles ? degrees(motor.speed) : motor.speed,
                     angles ? "torque" : "force", motor.strength);
}

void writeJoints(TomlText& out, const Scene& scene) {
  for (const JointDesc& joint : scene.joints) {
    const bool angles = joint.kind == JointKind::Revolute;
    out.heading("[[joint]]");
    out.put("kind", joint.kind);
    std::string bodies = written(scene.bodies[joint.a].name);
    if (joint.b) bodies += ", " + written(scene.bodies[*joint.b].name);
    out.raw("bodies", fmt::format("[{}]", bodies));
    out.put("at", joint.at);
    if (joint.kind == JointKind::Distance) out.put("to", joint.to);
    if (joint.kind == JointKind::Prismatic) out.put("axis", joint.axis);
    if (joint.length) out.put("length", *joint.length);
    out.put("stiffness", joint.stiffness, 0.0);
    out.put("damping", joint.damping, 0.0);
    if (joint.limits) out.raw("limits", written(*joint.limits, angles));
    if (joint.motor) out.raw("motor", written(*joint.motor, angles));
    out.put("compliance", joint.compliance, 0.0);
    out.put("break_force", joint.break_force, kForever);
    out.put("break_torque", joint.break_torque, kForever);
    out.put("collide", joint.collide, false);
  }
}

void writeEmitters(TomlText& out, const Scene& scene) {
  for (const EmitterDesc& emitter : scene.emitters) {
    out.heading("[[emitter]]");
    out.put("every", emitter.every);
    out.put("start", emitter.start, 0.0);
    out.put("count", emitter.count);
    out.put("spread", emitter.spread);
    out.put("seed", emitter.seed);
    writeBodyKeys(out, emitter.body, scene.settings.material);
  }
}

}  // namespace

std::string toToml(const Scene& scene) {
  TomlText out;
  writeWorld(out, scene);
  writeCamera(out, scene);
  writeSettings(out, scene.settings);
  writeBodies(out, scene);
  writeSprings(out, scene);
  writeImpulsesAndForces(out, scene);
  writeMagnets(out, scene);
  writeJoints(out, scene);
  writeEmitters(out, scene);
  return out.take();
}

}  // namespace merge2d
