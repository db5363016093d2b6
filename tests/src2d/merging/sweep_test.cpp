#include "src2d/merging/sweep.h"

#include <gtest/gtest.h>

#include "src2d/recorder.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

constexpr int kBoxes = 10;

const std::string kColumn = kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
mass = 2
repeat = { count = [1, 10], spacing = [1, 1] }
)";

/// The largest error of the normal forces in a column with `load` [N] on top [N].
double columnError(const Simulation& run, double load) {
  const Snapshot now = run.now();
  double worst = 0.0;
  for (std::uint32_t i = 0; i < kBoxes; ++i) {  // below box i; body 0 is the ground
    const double expected = (kBoxes - static_cast<double>(i)) * 2.0 * kGravity + load;
    const double force = normalForce(now, BodyId{i}, BodyId{i + 1}, run.world().scene().step);
    worst = std::max(worst, std::abs(force - expected));
  }
  return worst;
}

TEST(Sweep, HoldsAColumnsWeight) {
  Simulation run(kColumn, Mode::Merge);
  run.until(10.0);
  ASSERT_TRUE(run.merged("box[0,9]"));
  ASSERT_EQ(run.now().stats.collections, 1);
  EXPECT_LT(columnError(run, 0.0), 2e-4 * kBoxes * 2.0 * kGravity);
}

TEST(Sweep, ALoadOnTopReachesTheBottom) {
  Simulation run(kColumn + R"(
[[force]]
body = "box[0,9]"
at = [0, 0.5]
force = [0, -50]
from = 5.0
)",
                 Mode::Merge);
  run.until(5.0);
  ASSERT_TRUE(run.merged("box[0,9]"));
  run.until(20.0);
  ASSERT_TRUE(run.merged("box[0,9]"));
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
  EXPECT_LT(columnError(run, 50.0), 1e-3 * 50.0);
}

TEST(Sweep, ABodyPutOnTopIsFeltAtTheBottom) {
  Simulation run(kColumn + R"(
[[body]]
name = "late"
at = [0, 10.55]
box = [1, 1]
mass = 5
pinned_until = 5
)",
                 Mode::Merge);
  run.until(20.0);
  const Snapshot now = run.now();
  const double weight = (20.0 + 5.0) * kGravity;
  EXPECT_NEAR(normalForce(now, BodyId{0}, BodyId{1}, 0.01), weight, 2e-4 * weight);
}

/// Two boxes which a spring of force 10 N presses together, turning about their centre.
std::string spinner(double degrees_per_second) {
  const double v = 0.5 * degrees_per_second * std::numbers::pi / 180.0;
  return R"(
format = 1
gravity = [0, 0]
[[body]]
name = "a"
at = [-0.5, 0]
box = [1, 1]
velocity = [0, )" +
         std::to_string(-v) + R"(]
spin = )" +
         std::to_string(degrees_per_second) + R"(
[[body]]
name = "b"
at = [0.5, 0]
box = [1, 1]
velocity = [0, )" +
         std::to_string(v) + R"(]
spin = )" +
         std::to_string(degrees_per_second) + R"(
[[spring]]
body = "a"
to_body = "b"
to_anchor = [0, 0]
stiffness = 20
rest_length = 0.5
)";
}

/// What the springs of the spinner pull more than the contact pushes back, over m ω² r.
double heldOnItsCircle(const Overrides& overrides) {
  Simulation run(spinner(60.0), Mode::Merge, overrides);
  run.until(5.0);
  EXPECT_TRUE(run.merged("a"));
  const Snapshot now = run.now();
  const Vec2 apart = now.bodies[1].x - now.bodies[0].x;
  const double spring = 20.0 * (apart.norm() - 0.5);
  const double omega = now.collections.front().omega;
  const double centripetal = omega * omega * 0.5 * apart.norm();
  EXPECT_GT(centripetal, 0.5);
  const double pressed = normalForce(now, BodyId{0}, BodyId{1}, 0.01);
  return (spring - pressed) / centripetal;
}

TEST(Sweep, HoldsASpinningMemberOnItsCircle) { EXPECT_NEAR(heldOnItsCircle({}), 1.0, 5e-4); }

TEST(Sweep, UnderThePapersRuleTheForceOnACircleIsMissing) {
  EXPECT_NEAR(heldOnItsCircle({{"unmerging.rule", "paper"}}), 0.58, 0.01);
}

TEST(Sweep, UnderThePapersRuleAColumnsForcesFollowTheFrozenOverlap) {
  Simulation run(kColumn, Mode::Merge, {{"unmerging.rule", "paper"}});
  run.until(10.0);
  ASSERT_TRUE(run.merged("box[0,9]"));
  EXPECT_NEAR(columnError(run, 0.0) / (kBoxes * 2.0 * kGravity), 0.033, 0.002);
}

TEST(Sweep, HoldsABoxInASpinningDrumOnItsCircle) {
  Simulation run(R"(
format = 1
gravity = [0, 0]
[[body]]
name = "drum"
motion = "scripted"
script = { spin = 60 }
shapes = [ { box = [8, 1], at = [0, -2.5] }, { box = [8, 1], at = [0, 2.5] } ]
[[body]]
name = "box"
at = [0, -1.5]
box = [1, 1]
velocity = [1.5707963267948966, 0]
spin = 60
)",
                 Mode::Merge);
  run.until(6.0);
  ASSERT_TRUE(run.merged("box"));
  const Snapshot now = run.now();
  const double omega = std::numbers::pi / 3.0, r = now.bodies[1].x.norm();
  EXPECT_NEAR(normalForce(now, BodyId{0}, BodyId{1}, 0.01) / (omega * omega * r), 1.0, 5e-4);
}

/// Remembers the impulses outside collections and looks whether the sweep changes them.
class WarmStartGuard : public Observer {
 public:
  void afterStage(Stage stage, const State& state, const Scratch&) override {
    if (stage == Stage::SleepAndWake) before_ = impulses(state);
    if (stage != Stage::SingleIterationPGS) return;
    EXPECT_EQ(impulses(state), before_) << "in step " << state.step + 1;
    looked_ += before_.size();
  }
  std::size_t looked() const { return looked_; }

 private:
  static std::vector<double> impulses(const State& state) {
    std::vector<double> all;
    for (const ContactTable::Slot entry : state.contacts.order) {
      const Contact& contact = state.contacts[entry];
      for (int i = 0; i < contact.count; ++i) {
        const ContactPoint& p = contact.points[static_cast<std::size_t>(i)];
        all.insert(all.end(), {p.lambda_n, p.lambda_t});
      }
    }
    return all;
  }

  std::vector<double> before_;
  std::size_t looked_ = 0;
};

TEST(Sweep, UnderThePapersRuleLeavesTheFullSolvesWarmStartUntouched) {
  Simulation run(kColumn + R"(
[[body]]
name = "rocker"
at = [0.1, 10.35]
circle = 0.3
spin = 40
[[body]]
name = "slider"
at = [3, 0.5]
box = [1, 1]
velocity = [6, 0]
)",
                 Mode::Merge, {{"unmerging.rule", "paper"}});
  WarmStartGuard guard;
  run.world().observe(&guard);
  run.steps(300);
  EXPECT_TRUE(run.merged("box[0,0]"));
  EXPECT_GT(guard.looked(), 100u);
}

/// Counts the contacts of a disc, which is in no collection, that the sweep looks at.
class DiscWatch : public Observer {
 public:
  explicit DiscWatch(BodyId disc) : disc_(static_cast<std::uint32_t>(disc)) {}
  void afterStage(Stage stage, const State&, const Scratch& scratch) override {
    if (stage != Stage::SingleIterationPGS || !scratch.sweeping) return;
    for (const SweepContact& c : scratch.sweep_contacts) {
      rows_ += c.block.a == disc_ || c.block.b == disc_;
    }
  }
  int rows() const { return rows_; }

 private:
  std::uint32_t disc_;
  int rows_ = 0;
};

int sweptContactsOfDisc() {
  Simulation run(kColumn + R"(
[[body]]
name = "disc"
at = [5, 0.5]
circle = 0.5
)",
                 Mode::Merge, {{"unmerging.rule", "paper"}});
  run.until(2.0);
  EXPECT_TRUE(run.merged("box[0,0]"));
  EXPECT_FALSE(run.merged("disc"));
  DiscWatch watch(run.id("disc"));
  run.world().observe(&watch);
  run.steps(10);
  return watch.rows();
}

TEST(Sweep, UnderThePapersRuleLooksAtAllContacts) { EXPECT_EQ(sweptContactsOfDisc(), 10); }

/// How many contacts away from the blow on the left pile the walk finds the foot of the right one,
/// both on one floor; 0: never.
int depthOfOtherPile() {
  Scene scene = onGround();
  for (const double x : {-3.0, 3.0}) {
    add(scene, box(1, 1, {x, 0.5}));
    add(scene, box(1, 1, {x, 1.5}));
  }
  scene.settings.unmerging.rule = UnmergingRule::Paper;
  scene.impulses.push_back({.body = 2, .at = {-3.0, 1.5}, .impulse = {0.0, -1.0}, .time = 2.0});
  Recorder recorder(scene, Mode::Merge);
  recorder.skipTo(200);
  for (const NotedVisit& visit : recorder.record().notes.order) {
    if (visit.a == BodyId{0} && visit.b == BodyId{3}) return visit.depth;
  }
  return 0;
}

TEST(Sweep, UnderThePapersRuleTheWalkPassesTheFloor) { EXPECT_EQ(depthOfOtherPile(), 3); }

/// How far the friction under a wall is from what moves the wall with its platform, at most, in
/// parts of the amplitude of that force.
double errorOfBaseShear(Mode mode) {
  constexpr double kAcceleration = 0.4;
  World world(wallOnSwingingPlatform(10, 10, kAcceleration, 4.0), inMode(mode));
  double mass = 0.0, worst = 0.0;
  for (const BodyInfo& body : world.bodies())
    mass += body.motion == Motion::Dynamic ? body.mass : 0;
  runSeconds(world, 8);
  for (int i = 0; i < 400; ++i) {
    const double before = world.capture().bodies[0].v.x();
    world.step();
    const Snapshot now = world.capture();
    Vec2 force = Vec2::Zero();
    for (const ContactView& c : now.contacts) {
      if (c.a != BodyId{0}) continue;
      force += (c.lambda_n * c.normal + c.lambda_t * perpendicular(c.normal)) / 0.01;
    }
    const double wanted = mass * (now.bodies[0].v.x() - before) / 0.01;
    worst = std::max(worst, std::abs(force.x() - wanted));
  }
  return worst / (mass * kAcceleration);
}

TEST(Sweep, KeepsUpWithALoadThatChangesAllTheTime) {
  EXPECT_LT(errorOfBaseShear(Mode::Reference), 0.02);
  EXPECT_LT(errorOfBaseShear(Mode::Merge), 0.03);
}

TEST(Sweep, OfASettledColumnChangesNothing) {
  Simulation run(kColumn, Mode::Merge);
  run.until(10.0);
  const Snapshot before = run.now();
  run.steps(1);
  const Snapshot after = run.now();
  ASSERT_EQ(before.contacts.size(), after.contacts.size());
  for (std::size_t i = 0; i < before.contacts.size(); ++i) {
    EXPECT_NEAR(after.contacts[i].lambda_n, before.contacts[i].lambda_n, 1e-12);
    EXPECT_NEAR(after.contacts[i].lambda_t, before.contacts[i].lambda_t, 1e-12);
  }
}

/// Twenty layers of bricks.
const std::string kWall = kGround + R"(
[[body]]
name = "even"
at = [0, 0.25]
box = [1, 0.5]
repeat = { count = [10, 10], spacing = [1, 1] }
[[body]]
name = "odd"
at = [0.5, 0.75]
box = [1, 0.5]
repeat = { count = [10, 10], spacing = [1, 1] }
)";

std::vector<double> normalImpulses(const Snapshot& now) {
  std::vector<double> all;
  for (const ContactView& c : now.contacts) all.push_back(c.lambda_n);
  return all;
}

/// Of so many, the steps in which a sweep changes some impulse.
int stepsThatSweep(Simulation& run, int steps) {
  int count = 0;
  std::vector<double> before = normalImpulses(run.now());
  run.steps(steps, [&] {
    std::vector<double> after = normalImpulses(run.now());
    count += after != before ? 1 : 0;
    before = std::move(after);
  });
  return count;
}

TEST(Sweep, RestsWhereTheLastImpulsesStillHold) {
  Simulation run(kWall, Mode::Merge);
  run.until(30.0);
  ASSERT_TRUE(run.merged("odd[4,9]"));
  EXPECT_EQ(stepsThatSweep(run, 80), 0);
}

TEST(Sweep, UnderThePapersRuleNeverRests) {
  Simulation run(kWall, Mode::Merge, {{"unmerging.rule", "paper"}});
  run.until(30.0);
  ASSERT_TRUE(run.merged("odd[4,9]"));
  EXPECT_EQ(stepsThatSweep(run, 80), 80);
}

TEST(Sweep, DoesNotRestInAStepWithAnotherLoad) {
  const std::string load = R"(
[[force]]
body = "odd[4,9]"
force = [0, -0.05]
from = 30.01
)";
  Simulation loaded(kWall + load, Mode::Merge), run(kWall, Mode::Merge);
  loaded.until(30.01), run.until(30.01);
  EXPECT_EQ(stepsThatSweep(run, 1), 0);
  EXPECT_EQ(stepsThatSweep(loaded, 1), 1);
}

}  // namespace
}  // namespace merge2d
