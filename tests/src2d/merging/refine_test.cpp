/// Sweeps that go on where a blow is still travelling.

#include "src2d/merging/refine.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/src2d/merging/merging_testing.h"

namespace merge2d {
namespace {

/// Twenty boxes in a row, held together by a spring at either end and free to fly.
const std::string kRow = R"(
format = 1
gravity = [0, 0]
[[body]]
name = "box"
at = [0, 0]
box = [1, 1]
mass = 2
repeat = { count = [20, 1], spacing = [1, 1] }
[[spring]]
body = "box[0,0]"
to_body = "box[19,0]"
to_anchor = [0, 0]
rest_length = 0
stiffness = 1
)";

/// Looks at the velocities of the sweep of one step, which are thrown away after it.
class SweepWatch : public Observer {
 public:
  void afterStage(Stage stage, const State& state, const Scratch& scratch) override {
    if (stage != Stage::SingleIterationPGS || scratch.sweep_u.empty()) return;
    velocity.clear();
    for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
      velocity.push_back({scratch.sweep_u[i].vx, scratch.sweep_u[i].vy});
    }
    residual = 0.0F;
    for (const Collection& c : state.collections) residual = std::max(residual, c.residual);
  }
  std::vector<Vec2> velocity;
  float residual = 0.0F;  ///< what the last sweep still changed [m/s]
};

/// The velocities in the sweep after a blow of 40 N s at the left end of the row.
std::vector<Vec2> blown(const Overrides& overrides) {
  World world(parseScene(kRow, "row.toml", overrides), {.mode = Mode::Merge});
  for (int i = 0; i < 50; ++i) world.step();
  EXPECT_EQ(world.stats().active_bodies, 1);
  SweepWatch watch;
  world.observe(&watch);
  const Vec2 left = world.capture().bodies[0].x - Vec2(0.5, 0.0);
  world.applyImpulse(BodyId{0}, left, {40.0, 0.0});
  world.step();
  return watch.velocity;
}

TEST(Refine, CarriesABlowAsFarAsItGoes) {
  const std::vector<Vec2> velocity = blown({{"unmerging.disturbed_sweeps", "60"}});
  ASSERT_EQ(velocity.size(), 20u);
  for (const Vec2& v : velocity) EXPECT_NEAR(v.x(), 1.0, 0.05);  // 40 N s on 40 kg
}

TEST(Refine, UnderThePapersRuleABlowStaysNearWhereItFell) {
  const std::vector<Vec2> velocity = blown({{"unmerging.rule", "\"paper\""}});
  double fastest = 0.0, slowest = 1e9;
  for (const Vec2& v : velocity) {
    fastest = std::max(fastest, v.x());
    slowest = std::min(slowest, v.x());
  }
  EXPECT_GT(fastest - slowest, 0.5);
}

/// Ten boxes on the ground, `gap` apart and each merged with it, of which the first is struck.
std::string rowWithGaps(double gap, double friction) {
  return fmt::format(
      "{}[[body]]\nname = \"b\"\nat = [0, 0.5]\nbox = [1, 1]\n"
      "repeat = {{ count = [10, 1], spacing = [{}, 0] }}\n[material]\nfriction = {}\n",
      kGround, 1.0 + gap, friction);
}

/// What a blow closes only after some sweeps, it must still reach in its own step: the full solve
/// would take a box that is welded to the ground for a wall.
TEST(Refine, ABlowGoesThroughGapsInOneStep) {
  struct Case {
    double gap, blow, friction;  // m, N s
  };
  for (const auto& [gap, blow, friction] :
       {Case{0.0005, 10, 0.3}, Case{0.001, 10, 0.45}, Case{0.002, 10, 0.3}, Case{0.004, 20, 0.3},
        Case{0.0005, 10, 0.6}}) {
    const std::string toml = rowWithGaps(gap, friction);
    Simulation run(toml, Mode::Merge), reference(toml, Mode::Reference);
    run.until(2.0), reference.until(2.0);
    ASSERT_TRUE(run.merged("b[9,0]"));
    run.kick("b[0,0]", {blow, 0.0}), reference.kick("b[0,0]", {blow, 0.0});
    run.steps(3), reference.steps(3);
    const double momentum = reference.now().stats.momentum.x();
    EXPECT_NEAR(run.now().stats.momentum.x(), momentum, 0.1 * momentum) << gap << " " << blow;
    run.until(4.0), reference.until(4.0);
    const Snapshot a = run.now(), b = reference.now();
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
      EXPECT_NEAR(a.bodies[i].x.x(), b.bodies[i].x.x(), 0.05) << gap << " " << blow << " " << i;
    }
  }
}

TEST(Refine, FollowsAPushUntilItIsCarried) {
  Simulation run(kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [3, 6], spacing = [1, 1] }
)",
                 Mode::Merge);
  run.until(4.0);
  ASSERT_TRUE(run.merged("box[0,5]"));
  SweepWatch watch;
  run.world().observe(&watch);
  run.kick("box[1,5]", {0.0, -2.0}, {0.0, 0.5});
  run.steps(1);
  EXPECT_GT(watch.residual, 0.0F);
  run.steps(20);
  EXPECT_LT(watch.residual, 1e-4F) << "some steps later hardly anything changes";
  EXPECT_TRUE(run.merged("box[1,5]")) << "it was pressed onto the others";
}

}  // namespace
}  // namespace merge2d
