#include "app/doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "src2d/scene/rules.h"
#include "src2d/world.h"

namespace merge2d {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;  ///< in a radian

/// The greatest speed and spin of a body.
struct Pace {
  double speed = 0.0;  ///< [m/s]
  double spin = 0.0;   ///< [rad/s]
};

Pace paceOf(const Sinusoid& script) {
  return {script.axis.norm() * std::abs(script.amplitude) * 2.0 * std::numbers::pi / script.period,
          0.0};
}

Pace paceOf(const SteadyMotion& script) { return {script.velocity.norm(), std::abs(script.spin)}; }

/// The means between two key frames; in their middle the body is a little faster.
Pace paceOf(const Keyframes& script) {
  Pace pace;
  for (std::size_t i = 1; i < script.keys.size(); ++i) {
    const Keyframes::Key &from = script.keys[i - 1], &to = script.keys[i];
    const double time = to.time - from.time;
    pace.speed = std::max(pace.speed, (to.position - from.position).norm() / time);
    pace.spin = std::max(pace.spin, std::abs(to.angle - from.angle) / time);
  }
  return pace;
}

Pace paceOf(const BodyDesc& body) {
  if (!body.script) return {body.velocity.norm(), std::abs(body.spin)};
  return std::visit([](const auto& script) { return paceOf(script); }, *body.script);
}

/// The warning for the body that exceeds `limit` most, and the number of others that do.
class Excess {
 public:
  explicit Excess(double limit) : limit_(limit) {}

  void add(const BodyDesc& body, double value) {
    if (value <= limit_) return;
    ++count_;
    if (value > most_) worst_ = body.name;
    most_ = std::max(most_, value);
  }

  /// `sentence` takes the greatest value.
  template <class Sentence>
  void warn(Scene& scene, Sentence sentence) const {
    if (count_ == 0) return;
    const std::string more = count_ == 1   ? ""
                             : count_ == 2 ? ", and another does so too"
                                           : fmt::format(", and {} others do so too", count_ - 1);
    scene.warnings.push_back(fmt::format("'{}' {}{}", worst_, sentence(most_), more));
  }

 private:
  double limit_;
  double most_ = 0.0;
  std::string worst_;
  int count_ = 0;
};

/// How far `value` lies outside the limits.
double beyond(double value, const JointDesc::Limits& limits) {
  return std::max({limits.lower - value, value - limits.upper, 0.0});
}

/// The fault of a joint's start, if there is one.
std::optional<std::string> strainOf(const JointDesc& joint) {
  constexpr double kSlack = 1e-3;  // [m] or [rad]
  const bool distance = joint.kind == JointKind::Distance;
  const double start = distance ? (joint.to - joint.at).norm() : 0.0;
  if (joint.limits && beyond(start, *joint.limits) > kSlack) {
    const bool angle = joint.kind == JointKind::Revolute;
    const double unit = angle ? kDegrees : 1.0;
    return fmt::format("starts at {:.4g} {}, outside its limits [{:.4g}, {:.4g}]", unit * start,
                       angle ? "degrees" : "m", unit * joint.limits->lower,
                       unit * joint.limits->upper);
  }
  const bool rod = distance && joint.length && joint.stiffness == 0.0;
  if (!rod || std::abs(start - *joint.length) <= kSlack) return std::nullopt;
  return fmt::format("starts {:.4g} m long, but its length is {:.4g} m", start, *joint.length);
}

}  // namespace

void warnOfOverlaps(Scene& scene) {
  World world(scene, {.mode = Mode::Reference, .timings = false});
  world.step();  // finds the contacts of the starting poses
  const Snapshot snapshot = world.capture();
  const double tolerance = std::max(scene.settings.solver.margin, 1e-3);
  std::map<std::pair<BodyId, BodyId>, double> overlaps;  // [m]
  for (const ContactView& contact : snapshot.contacts) {
    if (-contact.gap <= tolerance) continue;
    double& deepest = overlaps[{contact.a, contact.b}];
    deepest = std::max(deepest, -contact.gap);
  }
  if (overlaps.empty()) return;
  const auto& [pair, depth] = *std::ranges::max_element(
      overlaps, [](const auto& x, const auto& y) { return x.second < y.second; });
  const auto& bodies = world.bodies();
  scene.warnings.push_back(fmt::format(
      "'{}' and '{}' overlap by {:.3g} m at the start{}", bodies[index(pair.first)].name,
      bodies[index(pair.second)].name, depth,
      overlaps.size() > 1 ? fmt::format(", and {} more pairs by less", overlaps.size() - 1) : ""));
}

void warnOfWhatComesTooLate(Scene& scene) {
  const auto check = [&](double time, std::string_view kind, std::size_t i, std::string_view name) {
    if (time < scene.duration) return;
    scene.warnings.push_back(
        fmt::format("{}[{}] of '{}' is due at {} s, but the scene ends at {} s", kind, i, name,
                    time, scene.duration));
  };
  const auto checkEach = [&](const auto& actions, std::string_view kind, auto timeOf) {
    for (std::size_t i = 0; i < actions.size(); ++i) {
      check(timeOf(actions[i]), kind, i, scene.bodies[actions[i].body].name);
    }
  };
  checkEach(scene.impulses, "impulse", [](const ImpulseDesc& impulse) { return impulse.time; });
  checkEach(scene.forces, "force", [](const ForceDesc& force) { return force.from; });
  for (std::size_t i = 0; i < scene.magnets.size(); ++i) {
    const MagnetDesc& magnet = scene.magnets[i];
    for (const auto& on : magnet.on) check(on.from, "magnet", i, scene.bodies[magnet.body].name);
  }
  for (std::size_t i = 0; i < scene.emitters.size(); ++i) {
    check(scene.emitters[i].start, "emitter", i, scene.emitters[i].body.name);
  }
}

void warnOfHaste(Scene& scene) {
  constexpr double kFast = 300.0;                      // [m/s], nearly that of sound
  constexpr double kQuarter = 0.5 * std::numbers::pi;  // [rad] in a step
  Excess speed(kFast), spin(kQuarter / scene.step);
  const auto look = [&](const BodyDesc& body) {
    const Pace pace = paceOf(body);
    speed.add(body, pace.speed);
    spin.add(body, pace.spin);
  };
  for (const BodyDesc& body : scene.bodies) look(body);
  for (const EmitterDesc& emitter : scene.emitters) look(emitter.body);
  const double h = scene.step;
  speed.warn(scene, [h](double v) {
    return fmt::format("moves at {:.3g} m/s, {:.3g} m in a step", v, v * h);
  });
  spin.warn(scene, [h](double omega) {
    return fmt::format("turns by {:.4g} degrees in a step", kDegrees * omega * h);
  });
}

void warnOfWhatDoesNothing(Scene& scene) {
  const auto warn = [&](const std::string& sentence) { scene.warnings.push_back(sentence); };
  for (const BodyDesc& body : scene.bodies) {
    const Pace pace = paceOf(body);
    const bool idle = body.script && pace.speed == 0.0 && pace.spin == 0.0;
    if (idle) warn(fmt::format("the script of '{}' never moves it", body.name));
    if (body.mass && body.motion != Motion::Dynamic) {
      warn(fmt::format("the mass of '{}' has no effect: it is {}", body.name, name(body.motion)));
    }
  }
  const auto look = [&](const auto& actions, std::string_view kind, auto isZero) {
    for (std::size_t i = 0; i < actions.size(); ++i) {
      if (!isZero(actions[i])) continue;
      const std::string& name = scene.bodies[actions[i].body].name;
      warn(fmt::format("{}[{}] of '{}' is zero and does nothing", kind, i, name));
    }
  };
  look(scene.springs, "spring",
       [](const SpringDesc& spring) { return spring.stiffness == 0.0 && spring.damping == 0.0; });
  look(scene.impulses, "impulse", [](const ImpulseDesc& i) { return i.impulse == Vec2::Zero(); });
  look(scene.forces, "force", [](const ForceDesc& f) { return f.force == Vec2::Zero(); });
}

void warnOfMixedRules(Scene& scene) {
  if (const auto doubt = doubtOfMixedRules(scene.settings)) scene.warnings.push_back(*doubt);
}

void warnOfStrainedJoints(Scene& scene) {
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const JointDesc& joint = scene.joints[i];
    const auto strain = strainOf(joint);
    if (!strain) continue;
    scene.warnings.push_back(
        fmt::format("joint[{}] of '{}' {}", i, scene.bodies[joint.a].name, *strain));
  }
}

}  // namespace merge2d
