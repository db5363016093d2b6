/// [[joint]] of a scene file.

#include <fmt/format.h>

#include "src2d/scene/interpret.h"

namespace merge2d {
namespace {

/// Reads the joints of one scene, whose bodies are known by now.
class JointReader {
 public:
  JointReader(Scene& scene, const BodyNames& names) : scene_(scene), names_(names) {}

  void joint(TableReader& table) {
    JointDesc joint;
    if (table.require("kind")) table.read("kind", joint.kind);
    if (const auto bodies = table.require("bodies")) readBodies(*bodies, joint);
    if (table.require("at")) table.read("at", joint.at, kPosition);
    readKind(table, joint);
    table.read("break_force", joint.break_force, kPositive);
    table.read("collide", joint.collide);
    if (table.has("kind")) refuseOthersKeys(table, joint.kind);
    table.done();
    scene_.joints.push_back(joint);
  }

 private:
  void readBodies(const Value& value, JointDesc& joint) const {
    constexpr std::string_view kForm = "[\"a\", \"b\"], or [\"a\"] for a joint to the world";
    const std::vector<Value> bodies = value.elements(kForm);
    if (bodies.empty() || bodies.size() > 2) value.failMustBe(kForm);
    joint.a = bodyNamed(bodies[0], scene_, names_);
    if (bodies.size() == 2) joint.b = bodyNamed(bodies[1], scene_, names_);
    if (joint.b == joint.a) {
      bodies[1].fail(
          fmt::format("a joint needs two bodies, but both are '{}'", scene_.bodies[joint.a].name));
    }
    if (moves(joint.a) || (joint.b && moves(*joint.b))) return;
    const BodyDesc& a = scene_.bodies[joint.a];
    if (!joint.b) {
      value.fail(fmt::format("a joint to the world has no effect on '{}', which is {}", a.name,
                             nameOf(a.motion)));
    }
    const BodyDesc& b = scene_.bodies[*joint.b];
    value.fail(fmt::format("a joint has no effect between '{}', which is {}, and '{}', which is {}",
                           a.name, nameOf(a.motion), b.name, nameOf(b.motion)));
  }

  bool moves(BodyIndex index) const { return scene_.bodies[index].motion == Motion::Dynamic; }

  static void readKind(TableReader& table, JointDesc& joint) {
    switch (joint.kind) {
      case JointKind::Revolute:
        readLimits(table, joint, true);
        readMotor(table, joint, "torque", true);
        break;
      case JointKind::Weld:
        table.read("break_torque", joint.break_torque, kPositive);
        break;
      case JointKind::Distance:
        readDistance(table, joint);
        break;
      case JointKind::Prismatic:
        if (table.require("axis")) table.read("axis", joint.axis);
        if (joint.axis.norm() == 0.0) table.failAt("axis", "'axis' must not be [0, 0]");
        readLimits(table, joint, false);
        readMotor(table, joint, "force", false);
        table.read("break_torque", joint.break_torque, kPositive);
        break;
    }
  }

  static void readDistance(TableReader& table, JointDesc& joint) {
    if (table.require("to")) table.read("to", joint.to, kPosition);
    if (const auto length = table.get("length")) joint.length = length->number(kLength);
    table.read("stiffness", joint.stiffness, kNotNegative);
    table.read("damping", joint.damping, kNotNegative);
    readLimits(table, joint, false);
    if (joint.limits && joint.limits->lower < 0.0) {
      table.failAt("limits", "a length cannot be negative");
    }
    if (joint.limits && joint.length) {
      table.failAt("length", "a joint with 'limits' has no 'length' of its own");
    }
    if (joint.limits && joint.stiffness > 0.0) {
      table.failAt("stiffness", "a joint with 'limits' cannot be a spring too: add another joint");
    }
    if (joint.damping > 0.0 && joint.stiffness == 0.0) {
      table.failAt("damping", "'damping' belongs to a joint with 'stiffness'");
    }
    const double start = (joint.to - joint.at).norm();
    if (table.has("to") && start < SceneLimits::kSmallest && !joint.limits) {
      table.failAt("to", "the ends of a distance joint must be apart: 'at' and 'to' are one point");
    }
  }

  static void readLimits(TableReader& table, JointDesc& joint, bool angles) {
    const auto value = table.get("limits");
    if (!value) return;
    const std::vector<double> ends = value->numbers(2, "[lower, upper]");
    if (ends[1] < ends[0]) value->fail("the lower limit must come first");
    joint.limits = {ends[0], ends[1]};
    if (angles) joint.limits = {radians(ends[0]), radians(ends[1])};
  }

  static void readMotor(TableReader& table, JointDesc& joint, std::string_view strength,
                        bool angles) {
    auto motor = table.table("motor");
    if (!motor) return;
    joint.motor = JointDesc::Motor{};
    if (motor->require("speed")) motor->read("speed", joint.motor->speed);
    if (motor->require(strength)) motor->read(strength, joint.motor->strength, kPositive);
    motor->done();
    if (angles) joint.motor->speed = radians(joint.motor->speed);
  }

  /// Keys of other kinds are no typing errors: the message says where they belong.
  static void refuseOthersKeys(TableReader& table, JointKind kind) {
    struct Key {
      std::string_view key;
      std::string_view kinds;
      bool (*fits)(JointKind);
    };
    static constexpr Key kKeys[] = {
        {"to", "a distance joint", [](JointKind k) { return k == JointKind::Distance; }},
        {"length", "a distance joint", [](JointKind k) { return k == JointKind::Distance; }},
        {"stiffness", "a distance joint", [](JointKind k) { return k == JointKind::Distance; }},
        {"damping", "a distance joint", [](JointKind k) { return k == JointKind::Distance; }},
        {"axis", "a prismatic joint", [](JointKind k) { return k == JointKind::Prismatic; }},
        {"limits", "any joint but a weld", [](JointKind k) { return k != JointKind::Weld; }},
        {"motor", "a revolute or prismatic joint",
         [](JointKind k) { return k == JointKind::Revolute || k == JointKind::Prismatic; }},
        {"break_torque", "a weld or prismatic joint",
         [](JointKind k) { return k == JointKind::Weld || k == JointKind::Prismatic; }}};
    for (const Key& key : kKeys) {
      if (key.fits(kind) || !table.has(key.key)) continue;
      table.failAt(key.key, fmt::format("'{}' belongs to {}, but this one is \"{}\"", key.key,
                                        key.kinds, nameOf(kind)));
    }
  }

  Scene& scene_;
  const BodyNames& names_;
};

}  // namespace

void readJoints(TableReader& root, Scene& scene, const BodyNames& names) {
  JointReader reader(scene, names);
  for (TableReader& table : root.tables("joint")) {
    if (scene.joints.size() == SceneLimits::kJoints) {
      table.fail(fmt::format("a scene has at most {} joints", SceneLimits::kJoints));
    }
    reader.joint(table);
  }
}

}  // namespace merge2d
