/// What the base solver holds, without merging and sleeping: everything else is judged against it.

#include "src2d/dynamics/solver.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "src2d/merging/metric.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

constexpr double kAtRest = 1e-4;     ///< [m/s]
constexpr double kSlip = 1e-2;       ///< Eq. (18) [m/s]
constexpr double kBreathing = 1e-5;  ///< [m] per step
constexpr double kMotion = 1e-2;     ///< Eq. (17) [m/s]
constexpr int kReadySteps = 3;

/// Watches a world and tells since when all pairs in contact could merge.
class Readiness {
 public:
  explicit Readiness(const World& world) : world_(world) {}

  /// To be called after each step; true when all criteria held for three steps.
  bool ready() {
    world_.capture(now_);
    quiet_ = allQuiet() ? quiet_ + 1 : 0;
    return quiet_ >= kReadySteps;
  }

 private:
  using Key = std::tuple<BodyId, BodyId, std::uint32_t>;

  bool allQuiet() {
    std::map<Key, double> gaps;
    bool quiet = true;
    for (const ContactView& c : now_.contacts) {
      const Key key{c.a, c.b, c.feature};
      gaps[key] = c.gap;
      if (c.lambda_n <= 0.0) continue;
      const auto before = gaps_.find(key);
      quiet &= before != gaps_.end() && std::abs(c.gap - before->second) < kBreathing;
      quiet &= std::abs(c.w_t) < kSlip;
      quiet &= relativeMotion(state(c.a), state(c.b)) < kMotion;
    }
    gaps_ = std::move(gaps);
    return quiet && !gaps_.empty();
  }

  const BodyState& state(BodyId id) const { return now_.bodies[index(id)]; }

  /// The fastest corner of either body against the other; the ground's are not looked at.
  double relativeMotion(const BodyState& a, const BodyState& b) const {
    double fastest = 0.0;
    const VelocityField field_a{a.x, a.v, a.omega}, field_b{b.x, b.v, b.omega};
    for (const BodyState* body : {&a, &b}) {
      const BodyInfo& info = world_.bodies()[index(body->id)];
      if (info.motion != Motion::Dynamic) continue;
      for (const Vec2& p : outlinePoints(info.shapes.front())) {
        const Vec2 at = body->pose() * p;
        fastest = std::max(fastest, (field_a.at(at) - field_b.at(at)).norm());
      }
    }
    return fastest;
  }

  const World& world_;
  Snapshot now_;
  std::map<Key, double> gaps_;
  int quiet_ = 0;
};

/// The step after which all pairs were ready to merge, or the last one.
int stepsUntilReady(const Scene& scene, int most) {
  World world = reference(scene);
  Readiness readiness(world);
  for (int i = 1; i < most; ++i) {
    world.step();
    if (readiness.ready()) return i;
  }
  return most;
}

double speedAfterFiveSeconds(const Scene& scene) {
  World world = reference(scene);
  runSeconds(world, 5);
  return fastest(world);
}

struct Pile {
  const char* name;
  Scene scene;
  double penetration = 0.02;  ///< at most [m]
};

std::vector<Pile> piles() {
  return {{"column of 10", column(10)},
          {"column of 20", column(20)},
          {"column of 40", column(40)},
          {"wall of 18 x 18", wall(18, 18)},
          {"wall of 31 x 32", wall(31, 32)},
          {"pyramid of base 50", pyramid(50)},
          {"arch of 11 stones", arch(11)},
          {"column with mass ratio 10", unequalColumn(10, 10)},
          {"column with mass ratio 100", unequalColumn(10, 100), 0.06}};
}

TEST(Solver, PilesComeToRestWithinFiveSecondsWhereTheyWereBuilt) {
  for (const Pile& pile : piles()) {
    World world = reference(pile.scene);
    const Snapshot before = world.capture();
    runSeconds(world, 5);
    const Snapshot after = world.capture();
    double sideways = 0.0, turned = 0.0;
    for (std::size_t i = 0; i < after.bodies.size(); ++i) {
      sideways = std::max(sideways, std::abs(after.bodies[i].x.x() - before.bodies[i].x.x()));
      turned = std::max(turned, std::abs(after.bodies[i].angle - before.bodies[i].angle));
    }
    EXPECT_LT(fastest(world), kAtRest) << pile.name;
    EXPECT_LT(sideways, 0.05) << pile.name;
    EXPECT_LT(turned, 0.02) << pile.name;
    EXPECT_LT(after.stats.max_penetration, pile.penetration) << pile.name;
  }
}

TEST(Solver, AllPairsOfAPileAreReadyToMergeWithin150Steps) {
  for (const Pile& pile : piles()) {
    EXPECT_LE(stepsUntilReady(pile.scene, 400), 150) << pile.name;
  }
}

TEST(LongSolver, AWallOf5000ComesToRest) {
  const Scene scene = wall(70, 71);
  EXPECT_LT(speedAfterFiveSeconds(scene), 5e-3);
  EXPECT_LE(stepsUntilReady(scene, 600), 300);
}

/// How far a box of a wall goes in two periods of swinging, seen from the platform [m]; before it
/// swings for two others.
double creepOnAPlatform(int rows, int columns, double period) {
  World world = reference(wallOnSwingingPlatform(rows, columns, 0.4, period));
  const auto places = [&] {
    const Snapshot snapshot = world.capture();
    std::vector<Vec2> x;
    for (const BodyState& body : snapshot.bodies) x.push_back(body.x - snapshot.bodies[0].x);
    return x;
  };
  runSeconds(world, 2.0 * period);
  const auto before = places();
  runSeconds(world, 2.0 * period);
  const auto after = places();
  double creep = 0.0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    creep = std::max(creep, (after[i] - before[i]).norm());
  }
  return creep;
}

TEST(Solver, AWallDoesNotCreepOnASwingingPlatform) {
  for (const double period : {4.0, 5.0}) EXPECT_LT(creepOnAPlatform(18, 18, period), 1e-4);
}

TEST(LongSolver, AWallOf992DoesNotCreepOnASwingingPlatform) {
  for (const double period : {4.0, 5.0}) EXPECT_LT(creepOnAPlatform(31, 32, period), 1e-4);
}

TEST(Solver, EachContactOfAColumnCarriesTheWeightAboveIt) {
  const int n = 10;
  World world = reference(column(n));
  runSeconds(world, 5);
  std::vector<double> force(n, 0.0);
  for (const ContactView& c : world.capture().contacts) {
    force[index(c.a)] += c.lambda_n / world.scene().step;
    EXPECT_LT(std::abs(c.lambda_t), 1e-9);
  }
  for (int k = 0; k < n; ++k) {
    EXPECT_NEAR(force[static_cast<std::size_t>(k)], (n - k) * kGravity, 1e-6 * n * kGravity);
  }
}

TEST(Solver, ThePressureOnTheGroundIsTheWeightOfAllThatStandsOnIt) {
  World world = reference(arch(11));
  runSeconds(world, 5);
  double weight = 0.0, thrust = 0.0, pressure = 0.0;
  for (const BodyInfo& body : world.bodies()) {
    if (body.motion == Motion::Dynamic) weight += body.mass * kGravity;
  }
  for (const ContactView& c : world.capture().contacts) {
    if (c.a != BodyId{0}) continue;
    pressure += c.lambda_n / world.scene().step;
    thrust += c.lambda_t / world.scene().step;
    EXPECT_GT(std::abs(c.lambda_t), 1e-3) << "an arch pushes outwards";
  }
  EXPECT_NEAR(pressure, weight, 1e-6 * weight);
  EXPECT_NEAR(thrust, 0.0, 1e-6 * weight);
}

TEST(Solver, ImpulsesPersistFromStepToStepByTheirFeatures) {
  World world = reference(column(10));
  runSeconds(world, 5);
  const Snapshot before = world.capture();
  world.step();
  const Snapshot after = world.capture();
  ASSERT_EQ(before.contacts.size(), 20u);
  ASSERT_EQ(after.contacts.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(after.contacts[i].feature, before.contacts[i].feature);
    EXPECT_NEAR(after.contacts[i].lambda_n, before.contacts[i].lambda_n, 1e-9);
    EXPECT_FALSE(after.contacts[i].fresh);
  }
}

TEST(Solver, TheWarmStartMakesASingleSweepPerStepEnoughForAColumn) {
  Scene scene = column(5);
  scene.settings.solver.iterations = 1;
  EXPECT_LT(speedAfterFiveSeconds(scene), kAtRest);
}

/// The residual of the step in which a wall first feels its weight.
double firstResidual(SolverMethod method, int iterations) {
  Scene scene = wall(6, 6);
  scene.settings.solver.method = method;
  scene.settings.solver.iterations = iterations;
  World world = reference(scene);
  world.step();
  return world.stats().residual;
}

TEST(Solver, TheResidualFallsWithTheIterations) {
  for (const auto method : {SolverMethod::Pgs, SolverMethod::Block, SolverMethod::Nncg}) {
    double before = firstResidual(method, 2);
    EXPECT_GT(before, 0.0);
    for (const int iterations : {10, 40, 160}) {
      const double residual = firstResidual(method, iterations);
      EXPECT_LT(residual, 0.7 * before) << iterations << " iterations";
      before = residual;
    }
  }
}

TEST(Solver, WithManySweepsAllMethodsFindTheSameForces) {
  std::vector<Snapshot> found;
  for (const auto method : {SolverMethod::Pgs, SolverMethod::Block, SolverMethod::Nncg}) {
    Scene scene = column(6);
    scene.settings.solver.method = method;
    scene.settings.solver.iterations = 3000;
    World world = reference(scene);
    world.step();
    found.push_back(world.capture());
  }
  for (const Snapshot& other : found) {
    ASSERT_EQ(other.contacts.size(), found[0].contacts.size());
    for (std::size_t i = 0; i < other.contacts.size(); ++i) {
      EXPECT_NEAR(other.contacts[i].lambda_n, found[0].contacts[i].lambda_n, 1e-9);
    }
  }
}

TEST(Solver, FarAwayBodiesDoNotMatter) {
  Scene alone = wall(6, 6), beside = wall(6, 6);
  addColumn(beside, 10, {50, 3});
  World one = reference(alone), two = reference(beside);
  for (int i = 0; i < 100; ++i) {
    one.step();
    two.step();
  }
  for (std::size_t i = 0; i < alone.bodies.size(); ++i) {
    EXPECT_EQ(one.capture().bodies[i].x, two.capture().bodies[i].x);
  }
}

TEST(Solver, AnOverlapIsRemovedNoFasterThanTheSettingAllows) {
  Scene scene = onGround();
  add(scene, box(1, 1, {0, 0.1}));  // 0.4 m too deep
  World world = reference(scene);
  const double fastest_way_out = scene.settings.solver.max_correction;
  double highest = 0.0;
  for (int i = 0; i < 300; ++i) {
    world.step();
    ASSERT_LE(see(world, BodyId{1}).v.y(), fastest_way_out + 1e-9);
    highest = std::max(highest, see(world, BodyId{1}).x.y() - 0.5);
  }
  EXPECT_LT(highest, fastest_way_out * fastest_way_out / (2 * kGravity));
  EXPECT_LT(world.capture().stats.max_penetration, 1e-3);
  EXPECT_LT(fastest(world), kAtRest);
}

}  // namespace
}  // namespace merge2d
