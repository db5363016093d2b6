/// Bodies that have merged with one frame each, and that a joint holds together.

#include <fmt/format.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// `n` boxes of 1 kg in a row on the ground, each joined to the next one.
std::string joinedRow(int n, double friction, const std::string& joint) {
  std::string toml = kGround;
  for (int i = 0; i < n; ++i) {
    toml += fmt::format(R"(
[[body]]
name = "b{}"
at = [{:.3f}, 0.15]
box = [0.6, 0.3]
mass = 1
friction = {}
)",
                        i, 1.1 * i, friction);
  }
  for (int i = 1; i < n; ++i) {
    toml += fmt::format(R"(
[[joint]]
bodies = ["b{}", "b{}"]
{}
)",
                        i - 1, i,
                        fmt::format(fmt::runtime(joint), fmt::arg("left", 1.1 * i - 0.8),
                                    fmt::arg("right", 1.1 * i - 0.3)));
  }
  toml = toml.replace(toml.find("box = [400, 1]"), 14,
                      fmt::format("box = [400, 1]\nfriction = {}", friction));
  return toml;
}

const std::string kRod = "kind = 'distance'\nat = [{left:.3f}, 0.15]\nto = [{right:.3f}, 0.15]";
const std::string kRope = kRod + "\nlimits = [0, 0.65]";
const std::string kSlider =
    "kind = 'prismatic'\nat = [{left:.3f}, 0.15]\naxis = [1, 0]\nlimits = [-0.1, 0.15]";

/// Every body of the row has come by x = (F/m − μ g) t²/2.
TEST(JoinedStacks, APullMovesAllBodiesOfARow) {
  for (const int n : {2, 3, 5}) {
    for (const double force : {1.5, 10.0}) {  // of all friction
      SCOPED_TRACE(testing::Message() << n << " boxes, " << force << " times their friction");
      const double friction = 0.3, slips = friction * kGravity * n, pull = force * slips;
      const std::string toml = joinedRow(n, friction, kRod) + fmt::format(R"(
[[force]]
body = "b{}"
force = [{}, 0]
from = 1.0
)",
                                                                          n - 1, pull);
      Simulation run(toml, Mode::Merge);
      run.until(1.0);
      EXPECT_TRUE(run.anchored("b0"));
      run.until(2.0);
      const double way = 0.5 * (pull - slips) / n;
      EXPECT_NEAR(run.body("b0").x.x(), way, 0.02 * way);
    }
  }
}

TEST(JoinedStacks, APullBelowTheFrictionOfAllMovesNone) {
  Simulation run(joinedRow(3, 0.3, kRod) + R"(
[[force]]
body = "b2"
force = [7.9, 0]
from = 1.0
)",
                 Mode::Merge);
  run.until(4.0);
  for (const char* body : {"b0", "b1", "b2"}) EXPECT_TRUE(run.anchored(body)) << body;
  EXPECT_NEAR(run.body("b0").x.x(), 0.0, 1e-3);
}

/// The momentum is shared where the rope gets taut, and friction takes the rest of it:
/// x = v²/(2 μ g).
TEST(JoinedStacks, ARopeThatGetsTautTakesAMergedBodyAlong) {
  const double friction = 0.05, slack = 0.15, kick = 4.0;
  for (const std::string& joint : {kRope, kSlider}) {
    SCOPED_TRACE(joint);
    Simulation run(joinedRow(2, friction, joint), Mode::Merge);
    run.until(1.0);
    EXPECT_TRUE(run.anchored("b0"));
    run.kick("b1", {kick, 0});
    run.until(8.0);
    const double taut = std::sqrt(kick * kick - 2.0 * friction * kGravity * slack);
    EXPECT_NEAR(run.body("b0").x.x(), 0.25 * taut * taut / (2.0 * friction * kGravity), 0.1);
  }
}

/// A body that was held until then has its speed at once.
TEST(JoinedStacks, ABodyThatIsReleasedTakesAMergedOneAlong) {
  std::string toml = joinedRow(2, 0.1, kRod);
  toml.replace(toml.find("name = \"b1\""), 11,
               "name = \"b1\"\npinned_until = 1.0\nvelocity = [3, 0]");
  Simulation run(toml, Mode::Merge);
  run.until(3.0);
  EXPECT_NEAR(run.body("b0").x.x(), 1.5 * 1.5 / (2.0 * 0.1 * kGravity), 0.03);
}

}  // namespace
}  // namespace merge2d
