/// [[joint]] of a scene file: what it means, what it says when it is wrong, and writing it again.

#include <fmt/format.h>

#include <numbers>

#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

const std::string kBodies = R"([[body]]
name = "crate"
circle = 1
[[body]]
name = "cart"
circle = 1
[[body]]
name = "wall"
motion = "pinned"
circle = 1
[[body]]
name = "ship"
motion = "scripted"
script = { spin = 1 }
circle = 1
)";

/// The joint stands from line 16 on.
std::string joint(std::string_view lines) { return kBodies + "[[joint]]\n" + std::string(lines); }

void expectError(std::string_view lines, std::string_view message) {
  EXPECT_EQ(firstLineOf(joint(lines)), fmt::format("s.toml:{}", message)) << lines;
}

constexpr std::string_view kFull = R"(kind = "prismatic"
bodies = ["crate", "wall"]
at = [1, 2]
axis = [3, 4]
limits = [-1, 2]
motor = { speed = 0.5, force = 20 }
break_force = 100
break_torque = 7
collide = true
[[joint]]
kind = "revolute"
bodies = ["cart"]
at = [5, 6]
limits = [-90, 45]
motor = { speed = 180, torque = 2 }
[[joint]]
kind = "distance"
bodies = ["crate", "cart"]
at = [0, 0]
to = [3, 4]
stiffness = 50
damping = 2
[[joint]]
kind = "distance"
bodies = ["crate", "cart"]
at = [0, 0]
to = [3, 4]
length = 6
[[joint]]
kind = "weld"
bodies = ["ship", "cart"]
at = [0, 0]
break_torque = 9
)";

TEST(Joints, AreRead) {
  const Scene scene = parseScene(joint(kFull), "s.toml");
  ASSERT_EQ(scene.joints.size(), 5u);
  const JointDesc& slide = scene.joints[0];
  EXPECT_EQ(slide.kind, JointKind::Prismatic);
  EXPECT_EQ(slide.a, 0u);
  EXPECT_EQ(slide.b, 2u);
  EXPECT_EQ(slide.at, Vec2(1, 2));
  EXPECT_EQ(slide.axis, Vec2(3, 4));
  EXPECT_EQ(slide.limits->upper, 2);
  EXPECT_EQ(slide.motor->strength, 20);
  EXPECT_EQ(slide.break_force, 100);
  EXPECT_EQ(slide.break_torque, 7);
  EXPECT_TRUE(slide.collide);
  const JointDesc& pivot = scene.joints[1];
  EXPECT_FALSE(pivot.b.has_value());
  EXPECT_DOUBLE_EQ(pivot.limits->lower, -0.5 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(pivot.motor->speed, std::numbers::pi);
  EXPECT_EQ(pivot.break_force, kForever);
  EXPECT_FALSE(pivot.collide);
  EXPECT_EQ(scene.joints[2].stiffness, 50);
  EXPECT_EQ(scene.joints[2].to, Vec2(3, 4));
  EXPECT_EQ(scene.joints[3].length, 6);
  EXPECT_EQ(scene.joints[4].break_torque, 9);
}

TEST(Joints, AreWrittenAsTheyWereRead) {
  const Scene scene = parseScene(joint(kFull), "s.toml");
  const std::string text = toToml(scene);
  const Scene again = parseScene(text, "s.toml");
  ASSERT_EQ(again.joints.size(), scene.joints.size());
  EXPECT_DOUBLE_EQ(again.joints[1].limits->lower, scene.joints[1].limits->lower);
  EXPECT_EQ(again.joints[0].axis, scene.joints[0].axis);
  EXPECT_EQ(again.joints[3].length, scene.joints[3].length);
  EXPECT_EQ(toToml(again), text);
}

TEST(Joints, AreChangedFromTheCommandLine) {
  const Scene scene = parseScene(joint(kFull), "s.toml", {{"joint[4].break_torque", "3"}});
  EXPECT_EQ(scene.joints[4].break_torque, 3);
}

TEST(Joints, NeedTwoBodiesThatAreThere) {
  expectError("kind = \"weld\"\nbodies = [\"crate\", \"carr\"]\nat = [0, 0]",
              "18:20: no body is called 'carr' (did you mean 'cart'?)");
  expectError("kind = \"weld\"\nbodies = [\"crate\", \"crate\"]\nat = [0, 0]",
              "18:20: a joint needs two bodies, but both are 'crate'");
  expectError("kind = \"weld\"\nbodies = []\nat = [0, 0]",
              "18:10: 'bodies' in [[joint]] must be [\"a\", \"b\"], or [\"a\"] for a joint to the "
              "world, but is a list of 0");
  expectError("kind = \"weld\"\nat = [0, 0]", "16:1: [[joint]] needs the key 'bodies'");
}

TEST(Joints, NeedABodyThatMoves) {
  expectError("kind = \"weld\"\nbodies = [\"wall\", \"ship\"]\nat = [0, 0]",
              "18:10: a joint has no effect between 'wall', which is pinned, and 'ship', which is "
              "scripted");
  expectError("kind = \"weld\"\nbodies = [\"wall\"]\nat = [0, 0]",
              "18:10: a joint to the world has no effect on 'wall', which is pinned");
}

TEST(Joints, AreOfAKnownKindWithItsOwnKeys) {
  expectError("kind = \"weldd\"\nbodies = [\"crate\"]\nat = [0, 0]",
              "17:8: 'kind' in [[joint]] must be one of \"revolute\", \"weld\", \"distance\", "
              "\"prismatic\", but is \"weldd\" (did you mean 'weld'?)");
  expectError("kind = \"weld\"\nbodies = [\"crate\"]\nat = [0, 0]\naxis = [1, 0]",
              "20:8: 'axis' belongs to a prismatic joint, but this one is \"weld\"");
  expectError("kind = \"revolute\"\nbodies = [\"crate\"]\nat = [0, 0]\nlength = 2",
              "20:10: 'length' belongs to a distance joint, but this one is \"revolute\"");
  expectError("kind = \"weld\"\nbodies = [\"crate\"]\nat = [0, 0]\nbrek_force = 2",
              "20:1: unknown key 'brek_force' in [[joint]] (did you mean 'break_force'?)");
  expectError("kind = \"weld\"\nbodies = [\"crate\"]\nat = [0, 0]\nlimits = [0, 1]",
              "20:10: 'limits' belongs to a revolute, distance or prismatic joint, but this one is "
              "\"weld\"");
  expectError("kind = \"revolute\"\nbodies = [\"crate\"]", "16:1: [[joint]] needs the key 'at'");
  expectError("bodies = [\"crate\"]\nat = [0, 0]\naxis = [1, 0]",
              "16:1: [[joint]] needs the key 'kind', one of \"revolute\", \"weld\", \"distance\", "
              "\"prismatic\"");
  expectError("kind = \"weld\"\nbody = \"crate\"\nat = [0, 0]",
              "18:1: unknown key 'body' in [[joint]] (did you mean 'bodies'?)");
  expectError("knd = \"weld\"\nbodies = [\"crate\"]\nat = [0, 0]",
              "17:1: unknown key 'knd' in [[joint]] (did you mean 'kind'?)");
  expectError("type = \"weld\"\nbodies = [\"crate\"]\nat = [0, 0]",
              "17:8: [[joint]] has no 'type' but a 'kind', one of \"revolute\", \"weld\", "
              "\"distance\", \"prismatic\"");
}

TEST(Joints, SayWhatIsWrongWithTheirNumbers) {
  expectError("kind = \"revolute\"\nbodies = [\"crate\"]\nat = [0, 0]\nlimits = [30, -30]",
              "20:10: the lower limit must come first, but 30 is above -30: write [-30, 30]");
  expectError(
      "kind = \"distance\"\nbodies = [\"crate\"]\nat = [1, 0]\nto = [2, 0]\nlimits = [-1, 2]",
      "21:10: the limits of a distance joint are lengths: 0 or more");
  expectError(
      "kind = \"distance\"\nbodies = [\"crate\"]\nat = [1, 0]\nto = [2, 0]\nlimits = [0, 0]",
      "21:10: the longest length must be positive; what shares a point is joined by kind = "
      "\"revolute\"");
  expectError("kind = \"prismatic\"\nbodies = [\"crate\"]\nat = [0, 0]\naxis = [0, 0]",
              "20:8: 'axis' must not be [0, 0]");
  expectError("kind = \"distance\"\nbodies = [\"crate\"]\nat = [1, 0]\nto = [1, 0]",
              "20:6: the ends of a distance joint must be apart: 'at' and 'to' are one point");
  expectError("kind = \"revolute\"\nbodies = [\"crate\"]\nat = [0, 0]\nmotor = { speed = 1 }",
              "20:9: 'motor' of [[joint]] needs the key 'torque'");
  expectError(
      "kind = \"revolute\"\nbodies = [\"crate\"]\nat = [0, 0]\nmotor = \"x\"",
      "20:9: 'motor' in [[joint]] must be a table { speed = …, torque = … }, but is the text "
      "\"x\"");
  expectError(
      "kind = \"revolute\"\nbodies = [\"crate\"]\nat = [0, 0]\nmotor = { speed = 1, force = 2 }",
      "20:30: the motor of a revolute joint has a 'torque', not a 'force'");
  expectError("kind = \"revolute\"\nbodies = [\"crate\"]\nat = [0, 0]\nbreak_force = 0",
              "20:15: 'break_force' in [[joint]] must be positive (1e-12 to 1e12), but is 0");
}

}  // namespace
}  // namespace merge2d
