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
    if (!table.has("kind")) failWithoutKind(table);
    table.read("kind", joint.kind);
    if (const auto bodies = table.require("bodies")) readBodies(*bodies, joint);
    if (table.require("at")) table.read("at", joint.at, kPosition);
    readKind(table, joint);
    table.read("compliance", joint.compliance, kNotNegative);
    table.read("break_force", joint.break_force, kPositive);
    table.read("collide", joint.collide);
    refuseOthersKeys(table, joint.kind);
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
    const BodyDesc* b = joint.b ? &scene_.bodies[*joint.b] : nullptr;
    if (const Verdict verdict = judgeJoint(scene_.bodies[joint.a], b))
      value.fail(verdict->sentence);
  }

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
    if (table.has("to")) obey(table, judgeDistance(joint));
  }

  static void readLimits(TableReader& table, JointDesc& joint, bool angles) {
    const auto value = table.get("limits");
    if (!value) return;
    const std::vector<double> ends = value->numbers(2, "[lower, upper]");
    if (const Verdict verdict = judgeLimits({ends[0], ends[1]})) value->fail(verdict->sentence);
    joint.limits = {ends[0], ends[1]};
    if (angles) joint.limits = {radians(ends[0]), radians(ends[1])};
  }

  static void readMotor(TableReader& table, JointDesc& joint, std::string_view strength,
                        bool angles) {
    const auto value = table.get("motor");
    if (!value) return;
    TableReader motor = value->table(fmt::format("a table {{ speed = …, {} = … }}", strength));
    const std::string_view others = angles ? "force" : "torque";
    if (motor.holds(others)) {
      motor.failAt(others, fmt::format("the motor of a {} joint has a '{}', not a '{}'",
                                       nameOf(joint.kind), strength, others));
    }
    joint.motor = JointDesc::Motor{};
    if (motor.require("speed")) motor.read("speed", joint.motor->speed);
    if (motor.require(strength)) motor.read(strength, joint.motor->strength, kPositive);
    motor.done();
    if (angles) joint.motor->speed = radians(joint.motor->speed);
  }

  /// A key that only some kinds have.
  struct KindsKey {
    std::string_view key;
    std::string_view kinds;
    bool (*fits)(JointKind);
  };
  static constexpr std::array<KindsKey, 8> kKindsKeys{
      {{"to", "a distance joint", [](JointKind k) { return k == JointKind::Distance; }},
       {"length", "a distance joint", [](JointKind k) { return k == JointKind::Distance; }},
       {"stiffness", "a distance joint", [](JointKind k) { return k == JointKind::Distance; }},
       {"damping", "a distance joint", [](JointKind k) { return k == JointKind::Distance; }},
       {"axis", "a prismatic joint", [](JointKind k) { return k == JointKind::Prismatic; }},
       {"limits", "a revolute, distance or prismatic joint",
        [](JointKind k) { return k != JointKind::Weld; }},
       {"motor", "a revolute or prismatic joint",
        [](JointKind k) { return k == JointKind::Revolute || k == JointKind::Prismatic; }},
       {"break_torque", "a weld or prismatic joint",
        [](JointKind k) { return k == JointKind::Weld || k == JointKind::Prismatic; }}}};

  /// Keys of other kinds are no typing errors: the message says where they belong.
  static void refuseOthersKeys(TableReader& table, JointKind kind) {
    for (const KindsKey& key : kKindsKeys) {
      if (key.fits(kind) || !table.has(key.key)) continue;
      table.failAt(key.key, fmt::format("'{}' belongs to {}, but this one is \"{}\"", key.key,
                                        key.kinds, nameOf(kind)));
    }
  }

  /// Before any other complaint, as the kind decides which keys a joint has.
  [[noreturn]] static void failWithoutKind(TableReader& table) {
    for (const KindsKey& key : kKindsKeys) table.has(key.key);
    for (const char* key : {"bodies", "at", "compliance", "break_force", "collide"}) table.has(key);
    if (table.holds("type")) {  // as other engines call it
      table.failAt("type",
                   fmt::format("[[joint]] has no 'type' but a 'kind', {}", choiceOf<JointKind>()));
    }
    table.done();
    table.fail(fmt::format("[[joint]] needs the key 'kind', {}", choiceOf<JointKind>()));
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
