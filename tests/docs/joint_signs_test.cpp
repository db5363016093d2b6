/// The picture of the signs of joints shows where positive motors take the bodies that it draws.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/docs/docs_testing.h"
#include "tests/support/scenes.h"

namespace merge2d::docs {
namespace {

const std::string& picture() {
  static const std::string svg = read(kRoot / "docs/pictures/joint-signs.svg");
  return svg;
}

/// The numbers that a pattern finds first, after the comment that stands before a joint.
std::vector<double> numbersAfter(const std::string& comment, const std::string& pattern) {
  const std::size_t at = picture().find(comment);
  std::smatch found;
  const std::string rest = at == std::string::npos ? "" : picture().substr(at);
  std::vector<double> numbers;
  if (!std::regex_search(rest, found, std::regex(pattern))) return numbers;
  for (std::size_t i = 1; i < found.size(); ++i) numbers.push_back(std::stod(found[i].str()));
  return numbers;
}

/// Pictures count y downwards.
Vec2 placeOf(double x, double y) { return {x, -y}; }

/// The turn of a body [degrees] and the way of its arrow about the pivot, as they are drawn.
struct DrawnTurn {
  double body = 0.0, arrow = 0.0;
};
DrawnTurn drawnTurn(const std::string& comment) {
  const auto body = numbersAfter(comment, R"x(<g transform="rotate\((-?\d+) (\d+) (\d+)\)")x");
  const auto arrow = numbersAfter(
      comment, R"x(<path d="M(\d+) (\d+) A\d+ \d+ 0 0 0 (\d+) (\d+)" [^>]*url\(#tip\))x");
  if (body.size() != 3 || arrow.size() != 4) return {};
  const Vec2 pivot = placeOf(body[1], body[2]);
  const Vec2 from = placeOf(arrow[0], arrow[1]) - pivot, to = placeOf(arrow[2], arrow[3]) - pivot;
  return {-body[0], cross(from, to)};
}

/// The label of a joint is its text in a scene: `revolute, bodies = ["w"]`.
std::string labelledJoint(const std::string& kind, const std::string& bodies) {
  const std::string label = fmt::format(">{}, bodies = [{}]<", kind, bodies);
  EXPECT_NE(picture().find(label), std::string::npos) << label;
  return fmt::format("[[joint]]\nkind = \"{}\"\nbodies = [{}]\n", kind, bodies);
}

/// A bar called `last` after half a second of a positive motor; `before` stands before it.
BodyState driven(const std::string& before, const std::string& last, const std::string& joint) {
  World world(sceneOf(fmt::format("gravity = [0, 0]\n{}[[body]]\nname = \"{}\"\nbox = [1, 0.1]\n{}"
                                  "at = [-0.5, 0]\n",
                                  before, last, joint)),
              {});
  runSeconds(world, 0.5);
  return see(world, last);
}

TEST(JointSignsPicture, TheBarTurnsAsItsMotorTurnsIt) {
  const DrawnTurn drawn = drawnTurn("a body that turns about a point of the world");
  const BodyState bar = driven(
      "", "w", labelledJoint("revolute", "\"w\"") + "motor = { speed = 50, torque = 100 }\n");
  EXPECT_NEAR(bar.angle / kDegree, drawn.body, 0.1);
  EXPECT_GT(drawn.arrow * bar.omega, 0.0);
}

TEST(JointSignsPicture, TheSliderGoesAlongItsAxis) {
  const std::string comment = "a body that slides along an axis of the world";
  const auto arrow = numbersAfter(comment, R"x(<path d="M\d+ (\d+) V(\d+)" [^>]*url\(#tip\))x");
  ASSERT_EQ(arrow.size(), 2u);
  ASSERT_NE(picture().find(">axis = [0, 1]<"), std::string::npos);
  const BodyState slider = driven("", "p",
                                  labelledJoint("prismatic", "\"p\"") +
                                      "axis = [0, 1]\nmotor = { speed = 0.5, force = 100 }\n");
  EXPECT_NEAR(slider.x.x(), 0.0, 1e-9);
  EXPECT_GT((arrow[0] - arrow[1]) * slider.x.y(), 0.0);
}

TEST(JointSignsPicture, TheSecondBodyTurnsAgainstTheFirst) {
  const DrawnTurn drawn = drawnTurn("the second body against the first");
  const BodyState bar =
      driven("[[body]]\nname = \"a\"\nmotion = \"pinned\"\nat = [-1, 0]\nbox = [1, 0.1]\n", "b",
             labelledJoint("revolute", "\"a\", \"b\"") + "motor = { speed = 120, torque = 100 }\n");
  EXPECT_NEAR(bar.angle / kDegree, drawn.body, 0.1);
  EXPECT_GT(drawn.arrow * bar.omega, 0.0);
}

}  // namespace
}  // namespace merge2d::docs
