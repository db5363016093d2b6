#include "src2d/scene/check.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>

#include "src2d/core/error.h"
#include "src2d/core/utf8.h"
#include "src2d/scene/crowd.h"
#include "src2d/scene/names.h"
#include "src2d/scene/rules.h"
#include "src2d/scene/settings_list.h"

namespace merge2d {
namespace {

constexpr Range kRadians{-SceneLimits::kNumber * (std::numbers::pi / 180.0),
                         SceneLimits::kNumber*(std::numbers::pi / 180.0), kAnyNumber.words};
template <HasNames E>
bool isNamed(E value) {
  for (const auto& [word, named] : kNames<E>) {
    if (named == value) return true;
  }
  return false;
}

/// The numbers of one description, which `home` names in messages: "body 'a'".
template <class Home>
class Numbers {
 public:
  explicit Numbers(const Home& home) : home_(home) {}

  void number(std::string_view key, double value, const Range& range = kAnyNumber) const {
    const bool fits = std::isfinite(value) && value >= range.lower && value <= range.upper;
    if (fits) return;
    const bool size = std::isfinite(value) && std::abs(value) <= kAnyNumber.upper;
    throw InputError(
        mustBe(key, home_(), size ? range.words : kAnyNumber.words, shownNumber(value)));
  }
  void vector(std::string_view key, const Vec2& value, const Range& range = kAnyNumber) const {
    for (const int i : {0, 1}) {
      if (value[i] >= range.lower && value[i] <= range.upper) continue;
      number(fmt::format("{}[{}]", key, i), value[i], range);
    }
  }
  /// A time or strength that may be without end.
  void endless(std::string_view key, double value, const Range& range) const {
    if (value != kForever) number(key, value, range);
  }
  void obey(const Verdict& verdict) const {
    if (verdict) fail(verdict->sentence);
  }
  [[noreturn]] void fail(std::string_view sentence) const {
    throw InputError(fmt::format("{}: {}", home_(), sentence));
  }

 private:
  const Home& home_;  ///< makes the name, which only messages need
};

template <class Home>
void checkShape(const ConvexShape& shape, const Numbers<Home>& in) {
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    in.number("circle", circle->radius, kLength);
    return in.vector("at", circle->center, kCorner);
  }
  const auto& corners = std::get<Polygon>(shape).vertices;
  const std::size_t n = corners.size();
  if (n < 3 || n > Polygon::kMaxVertices) {
    in.fail(fmt::format("a convex polygon has 3 to {} corners, this one has {}",
                        Polygon::kMaxVertices, n));
  }
  for (const Vec2& corner : corners) in.vector("polygon", corner, kCorner);
  for (std::size_t i = 0; i < n; ++i) {
    constexpr double kRounding = 1e-9;
    const Vec2 side = corners[(i + 1) % n] - corners[i];
    const Vec2 next = corners[(i + 2) % n] - corners[(i + 1) % n];
    if (cross(side, next) >= -kRounding * side.norm() * next.norm()) continue;
    in.fail(
        "the corners of a convex polygon turn left, counter-clockwise; convexPieces cuts others");
  }
  if (!(areaProperties(shape).area > 0.0)) in.fail("the polygon has no area");
}

template <class Home>
void checkScript(const Script& script, const Numbers<Home>& in) {
  if (const auto* sinusoid = std::get_if<Sinusoid>(&script)) {
    in.vector("axis", sinusoid->axis);
    in.number("amplitude", sinusoid->amplitude);
    in.number("period", sinusoid->period, kPositive);
    if (sinusoid->axis == Vec2::Zero()) in.fail("'axis' must not be [0, 0]");
  } else if (const auto* path = std::get_if<Keyframes>(&script)) {
    if (path->keys.empty()) in.fail("a script needs at least one key frame");
    const Keyframes::Key* before = nullptr;
    for (const Keyframes::Key& key : path->keys) {
      in.number("keyframes", key.time);
      for (const double coordinate : key.position) in.number("keyframes", coordinate);
      in.number("keyframes", key.angle, kRadians);
      in.obey(judgeKey(key, before));
      before = &key;
    }
  } else if (const auto* steady = std::get_if<SteadyMotion>(&script)) {
    in.vector("velocity", steady->velocity);
    in.number("spin", steady->spin, kRadians);
  }
}

template <class Home>
void checkBodyIn(const BodyDesc& body, const Home& home) {
  const Numbers in(home);
  if (hasControl(body.name)) in.fail("a name is one line without control characters");
  if (!isNamed(body.motion)) in.fail("the motion is dynamic, pinned or scripted");
  in.obey(judgeBody(body));
  if (body.shapes.size() > SceneLimits::kShapesPerBody) {
    in.fail(fmt::format("a body has at most {} shapes", SceneLimits::kShapesPerBody));
  }
  for (const ConvexShape& shape : body.shapes) checkShape(shape, in);
  in.vector("at", body.at, kPosition);
  in.number("angle", body.angle, kRadians);
  in.vector("velocity", body.velocity);
  in.number("spin", body.spin, kRadians);
  if (body.mass) in.number("mass", *body.mass, kPositive);
  in.number("density", body.density, kPositive);
  in.number("friction", body.friction, kNotNegative);
  in.number("restitution", body.restitution, kFraction);
  in.number("rolling", body.rolling, kNotNegative);
  in.number("surface_velocity", body.surface_velocity);
  in.number("pinned_until", body.pinned_until, kNotNegative);
  if (body.script) checkScript(*body.script, in);
}

template <class Home>
void checkSpringIn(const SpringDesc& spring, const Home& home) {
  const Numbers in(home);
  in.vector("anchor", spring.anchor, kPosition);
  in.vector(spring.to_body ? "to_anchor" : "to", spring.to, kPosition);
  in.number("stiffness", spring.stiffness, kNotNegative);
  in.number("damping", spring.damping, kNotNegative);
  in.number("rest_length", spring.rest_length, kNotNegative);
  if (spring.to_body == spring.body) in.fail("both ends of the spring are on the same body");
}

template <class Home>
void checkJointIn(const JointDesc& joint, const Home& home) {
  const Numbers in(home);
  const bool distance = joint.kind == JointKind::Distance;
  const bool turns = joint.kind == JointKind::Revolute;
  if (!isNamed(joint.kind)) in.fail("the kind is none of those that there are");
  if (joint.b == joint.a) in.fail("a joint needs two bodies, or one and the world");
  in.vector("at", joint.at, kPosition);
  in.number("compliance", joint.compliance, kNotNegative);
  in.endless("break_force", joint.break_force, kPositive);
  in.endless("break_torque", joint.break_torque, kPositive);
  if (joint.limits) {
    in.number("limits", joint.limits->lower, turns ? kRadians : kAnyNumber);
    in.number("limits", joint.limits->upper, turns ? kRadians : kAnyNumber);
    in.obey(judgeLimits(*joint.limits));
  }
  if (joint.motor) {
    in.number("speed", joint.motor->speed, turns ? kRadians : kAnyNumber);
    in.number(turns ? "torque" : "force", joint.motor->strength, kPositive);
  }
  if (joint.kind == JointKind::Prismatic) {
    in.vector("axis", joint.axis);
    if (joint.axis.norm() == 0.0) in.fail("'axis' must not be [0, 0]");
  }
  if (!distance) return;
  in.vector("to", joint.to, kPosition);
  if (joint.length) in.number("length", *joint.length, kLength);
  in.number("stiffness", joint.stiffness, kNotNegative);
  in.number("damping", joint.damping, kNotNegative);
  in.obey(judgeDistance(joint));
}

/// All of one scene.
class SceneCheck {
 public:
  explicit SceneCheck(const Scene& scene) : scene_(scene) {}

  void world() const {
    const auto home = [] { return std::string("the scene"); };
    const Numbers in(home);
    in.vector("gravity", scene_.gravity);
    in.number("step", scene_.step, kStep);
    in.number("seed", static_cast<double>(scene_.seed), kSeed);
  }

  void bodies() const {
    if (scene_.bodies.size() > SceneLimits::kBodies) {
      throw InputError(fmt::format("a scene has at most {} bodies", SceneLimits::kBodies));
    }
    std::unordered_set<std::string_view> names;
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const BodyDesc& body = scene_.bodies[i];
      checkBodyIn(body, [&] { return called("body", i, body.name); });
      if (body.name.empty() || names.insert(body.name).second) continue;
      throw InputError(fmt::format("two bodies are called '{}'", body.name));
    }
  }

  void emitters() const {
    std::size_t all = scene_.bodies.size();
    for (std::size_t i = 0; i < scene_.emitters.size(); ++i) {
      const EmitterDesc& emitter = scene_.emitters[i];
      const auto home = [&] { return called("emitter", i, emitter.body.name); };
      const Numbers in(home);
      checkBodyIn(emitter.body, home);
      if (emitter.body.motion != Motion::Dynamic) in.fail("an emitter's bodies are dynamic");
      in.number("every", emitter.every, kPositive);
      in.number("start", emitter.start, kNotNegative);
      in.number("count", emitter.count, {0, SceneLimits::kBodies, "between 0 and 100000"});
      in.vector("spread", emitter.spread, {0, SceneLimits::kCoordinate, "between 0 and 1e6 m"});
      all += static_cast<std::size_t>(emitter.count);
      if (all <= SceneLimits::kBodies) continue;
      in.fail(fmt::format("a scene has at most {} bodies, but with the emitted ones this makes {}",
                          SceneLimits::kBodies, all));
    }
  }

  void actions() const {
    each("spring", scene_.springs, [&](const SpringDesc& spring, const auto& home) {
      const BodyDesc& body = at(spring.body, home);
      const BodyDesc* other = spring.to_body ? &at(*spring.to_body, home) : nullptr;
      checkSpringIn(spring, home);
      if (other == nullptr || !moves(*other)) Numbers(home).obey(judgeMoves("a spring", body));
    });
    each("impulse", scene_.impulses, [&](const ImpulseDesc& impulse, const auto& home) {
      const Numbers in(home);
      in.obey(judgeMoves("an impulse", at(impulse.body, home)));
      in.vector("at", impulse.at, kPosition);
      in.vector("impulse", impulse.impulse);
      in.number("time", impulse.time, kNotNegative);
    });
    each("force", scene_.forces, [&](const ForceDesc& force, const auto& home) {
      const Numbers in(home);
      in.obey(judgeMoves("a force", at(force.body, home)));
      in.vector("at", force.at, kPosition);
      in.vector("force", force.force);
      in.number("from", force.from, kNotNegative);
      in.endless("until", force.until, kNotNegative);
      in.obey(judgeTimes("a force", force.from, force.until));
    });
  }

  void magnets() const {
    std::unordered_set<BodyIndex> known;
    each("magnet", scene_.magnets, [&](const MagnetDesc& magnet, const auto& home) {
      const Numbers in(home);
      const BodyDesc& body = at(magnet.body, home);
      if (!known.insert(magnet.body).second) {
        in.fail(fmt::format("'{}' is a magnet already", body.name));
      }
      const MagnetDesc::Interval* before = nullptr;
      for (const MagnetDesc::Interval& on : magnet.on) {
        in.number("on", on.from);
        in.endless("on", on.until, kAnyNumber);
        in.obey(judgeInterval(on, before));
        before = &on;
      }
    });
  }

  void joints() const {
    if (scene_.joints.size() > SceneLimits::kJoints) {
      throw InputError(fmt::format("a scene has at most {} joints", SceneLimits::kJoints));
    }
    each("joint", scene_.joints, [&](const JointDesc& joint, const auto& home) {
      const BodyDesc& a = at(joint.a, home);
      const BodyDesc* b = joint.b ? &at(*joint.b, home) : nullptr;
      checkJointIn(joint, home);
      Numbers(home).obey(judgeJoint(a, b));
    });
  }

 private:
  static std::string called(std::string_view kind, std::size_t i, std::string_view name) {
    return name.empty() ? fmt::format("{}[{}]", kind, i) : fmt::format("{} '{}'", kind, name);
  }

  /// Calls `look(description, home)` for each.
  template <class T, class Look>
  static void each(std::string_view kind, const std::vector<T>& list, Look&& look) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      look(list[i], [&] { return fmt::format("{}[{}]", kind, i); });
    }
  }

  template <class Home>
  const BodyDesc& at(BodyIndex body, const Home& home) const {
    if (body < scene_.bodies.size()) return scene_.bodies[body];
    throw InputError(fmt::format("{}: there is no body {}: the scene has {}", home(), body,
                                 scene_.bodies.size()));
  }

  const Scene& scene_;
};

}  // namespace

void checkSimulated(const Scene& scene) {
  const SceneCheck of(scene);
  of.world();
  checkSettings(scene.settings);
  of.bodies();
  of.emitters();
  of.actions();
  of.magnets();
  of.joints();
  refuseCrowds(scene);
}

void check(const Scene& scene) {
  const auto whole = [] { return std::string("the scene"); };
  Numbers(whole).number("duration", scene.duration, kDuration);
  const auto home = [] { return std::string("[camera]"); };
  const Numbers in(home);
  in.number("margin", scene.margin, kNotNegative);
  if (scene.follow && *scene.follow >= scene.bodies.size()) in.fail("'follow' names no body");
  if (scene.camera) {
    in.vector("center", scene.camera->center, kPosition);
    in.number("height", scene.camera->height, kLength);
  }
  checkSimulated(scene);
}

void checkBody(const BodyDesc& body) {
  checkBodyIn(body, [&] {
    return body.name.empty() ? std::string("the body") : fmt::format("body '{}'", body.name);
  });
}

void checkSpring(const SpringDesc& spring) {
  checkSpringIn(spring, [] { return std::string("the spring"); });
}

void checkJoint(const JointDesc& joint) {
  checkJointIn(joint, [] { return std::string("the joint"); });
}

void checkTimeStep(double h) {
  Numbers([] { return std::string("the world"); }).number("step", h, kStep);
}

void checkSettings(const Settings& settings) {
  forEachSetting(settings, [](std::string_view table, std::string_view key, const auto& value,
                              const Range& range) {
    const auto home = [&] { return fmt::format("[{}]", table); };
    using Kind = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Kind, double>) {
      Numbers(home).number(key, value, range);
    } else if constexpr (std::is_enum_v<Kind>) {
      if (!isNamed(value))
        throw InputError(mustBe(key, home(), "one of its words", "none of them"));
    } else if constexpr (std::is_integral_v<Kind>) {
      if (std::is_same_v<Kind, bool>) return;
      if (value >= range.lower && value <= range.upper) return;
      throw InputError(mustBe(key, home(), range.words, fmt::format("{}", value)));
    }
  });
}

}  // namespace merge2d
