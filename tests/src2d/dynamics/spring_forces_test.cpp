/// Springs against closed forms, and their energy.

#include "src2d/dynamics/spring_forces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace merge2d {
namespace {

constexpr double kPi = std::numbers::pi;

/// A mass of 1 kg on a spring of zero length, pulled out by 1 m.
Scene massOnSpring(double stiffness) {
  Scene scene = noGravity();
  add(scene, box(1, 1, {1, 0}));
  scene.springs.push_back({.body = 0, .to_body = {}, .stiffness = stiffness});
  return scene;
}

/// The mean time between two passages of x = 0 in one direction, over ten of them.
double measuredPeriod(const Scene& scene) {
  World world = reference(scene);
  std::vector<double> passages;
  double before = see(world, BodyId{0}).x.x();
  while (passages.size() < 11 && world.time() < 100.0) {
    world.step();
    const double now = see(world, BodyId{0}).x.x();
    if (before > 0.0 && now <= 0.0) {
      passages.push_back(world.time() - scene.step * now / (now - before));
    }
    before = now;
  }
  return (passages.back() - passages.front()) / static_cast<double>(passages.size() - 1);
}

TEST(Spring, AMassSwingsWithThePeriodOfItsStiffness) {
  const double stiffness = 25.0, h = 0.01, omega = std::sqrt(stiffness);
  const double exact = 2.0 * kPi / omega;
  const double discrete = kPi * h / std::asin(0.5 * omega * h);  // of symplectic Euler
  EXPECT_NEAR(measuredPeriod(massOnSpring(stiffness)), discrete, 2e-6);
  EXPECT_NEAR(discrete, exact, 2e-4);
}

TEST(Spring, ItsPeriodConvergesToTheExactOneWithTheSquareOfTheStep) {
  const double exact = 2.0 * kPi / std::sqrt(50.0);
  Scene scene = massOnSpring(50.0);
  const double coarse = measuredPeriod(scene) - exact;
  scene.step *= 0.25;
  const double fine = measuredPeriod(scene) - exact;
  EXPECT_NEAR(coarse / fine, 16.0, 0.5);
}

TEST(Spring, AMassHangsWhereItsWeightStretchesIt) {
  Scene scene;
  add(scene, box(1, 1, {0, 0}));
  scene.springs.push_back({.body = 0,
                           .to = {0, 5},
                           .to_body = {},
                           .stiffness = 40.0,
                           .damping = 8.0,
                           .rest_length = 3.0});
  World world = reference(scene);
  runSeconds(world, 20);
  EXPECT_NEAR(see(world, BodyId{0}).x.y(), 5.0 - 3.0 - kGravity / 40.0, 1e-9);
  ASSERT_EQ(world.capture().springs.size(), 1u);
  EXPECT_NEAR(world.capture().springs[0].force, kGravity, 1e-7);
}

TEST(Spring, TwoBodiesJoinedByASpringKeepTheirMomentum) {
  Scene scene = noGravity();
  add(scene, box(1, 1, {-2, 0}));
  add(scene, box(1, 2, {2, 1}));
  scene.bodies[0].velocity = {0.3, -0.7};
  scene.bodies[1].spin = 2.0;
  scene.springs.push_back({.body = 0,
                           .anchor = {0.5, 0.4},
                           .to = {-0.5, 0.9},
                           .to_body = 1,
                           .stiffness = 30.0,
                           .damping = 1.0,
                           .rest_length = 2.0});
  World world = reference(scene);
  const Stats before = world.capture().stats;
  runSeconds(world, 10);
  const Stats after = world.capture().stats;
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12);
  EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 1e-11);
  EXPECT_GT(std::abs(see(world, BodyId{0}).omega), 1e-3) << "the spring turned nothing";
}

/// At the stiffest, h² k / m = 1, the discrete orbit is an ellipse that is 2/√3 longer than wide.
TEST(Spring, ASpringThatIsTooStiffForTheStepGainsNoEnergy) {
  const double longest = 2.0 / std::sqrt(3.0) + 1e-9;
  for (const double stiffness : {1e4, 1e5, 1e7, 1e12}) {
    World world = reference(massOnSpring(stiffness));
    double furthest = 0.0;
    for (int i = 0; i < 1000; ++i) {
      world.step();
      furthest = std::max(furthest, see(world, BodyId{0}).x.norm());
    }
    EXPECT_LE(furthest, longest) << "stiffness " << stiffness;
  }
}

/// Welded to the ground the box does not float, but it would as soon as it is pulled off.
TEST(Spring, ThatIsTooStiffDoesNotTearOffWhatItCannotLift) {
  for (const double stiffness : {2e4, 2e5, 2e7}) {
    for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
      Scene scene = onGround();
      add(scene, box(1, 0.2, {0, 0.1}));
      scene.springs.push_back({.body = 1,
                               .anchor = {0, 0.1},
                               .to = {0, 1.2009},
                               .to_body = {},
                               .stiffness = stiffness,
                               .rest_length = 1.0});
      World world(scene, inMode(mode));
      runSeconds(world, 2);
      EXPECT_NEAR(see(world, BodyId{1}).x.y(), 0.1, 2e-3) << stiffness << " " << name(mode);
      EXPECT_LT(see(world, BodyId{1}).v.norm(), 1e-3) << stiffness << " " << name(mode);
    }
  }
}

/// A plate on springs along two of its sides, which pull it about and turn it.
TEST(Spring, ManyOnOneBodyDoNotExplodeTogether) {
  for (const double stiffness : {5e3, 1e5, 1e7, 1e12}) {
    Scene scene;
    add(scene, box(2, 1, {0, 0}));
    for (int i = 0; i < 12; ++i) {
      const Vec2 at(i % 2 == 0 ? -1.0 : 1.0, 0.1 * (i / 2) - 0.3);
      scene.springs.push_back({.body = 0,
                               .anchor = at,
                               .to = at + Vec2(0.1 * i, 0.2),
                               .to_body = {},
                               .stiffness = stiffness,
                               .damping = 1e-3 * stiffness});
    }
    World world = reference(scene);
    for (int i = 0; i < 1000; ++i) {
      world.step();
      ASSERT_LT(see(world, BodyId{0}).x.norm(), 2.0) << "stiffness " << stiffness;
    }
    EXPECT_LT(see(world, BodyId{0}).v.norm(), 1e-3) << "stiffness " << stiffness;
  }
}

/// It swings down from where it is level, and nothing of it moves faster than a fall from there.
TEST(Spring, AStiffChainGainsNoEnergy) {
  for (const double stiffness : {1e4, 1e6, 1e9}) {
    Scene scene;
    for (int i = 0; i < 6; ++i) {
      add(scene, box(0.5, 0.5, {1.0 * i, 0}));
      SpringDesc spring{.body = static_cast<BodyIndex>(i),
                        .to = {-1.0, 0.0},
                        .to_body = {},
                        .stiffness = stiffness,
                        .damping = 10.0,
                        .rest_length = 1.0};
      if (i > 0) spring.to = Vec2::Zero(), spring.to_body = static_cast<BodyIndex>(i - 1);
      scene.springs.push_back(spring);
    }
    World world = reference(scene);
    for (int i = 0; i < 2000; ++i) {
      world.step();
      const Snapshot now = world.capture();
      double energy = now.stats.kinetic_energy;
      for (const BodyState& b : now.bodies) energy += 0.25 * kGravity * b.x.y();
      ASSERT_LT(energy, 0.5) << "stiffness " << stiffness << " at " << world.time() << " s";
    }
  }
}

/// The energy of the bodies and springs of a world without gravity [J].
double energyOf(const World& world) {
  const Stats now = world.capture().stats;
  return now.kinetic_energy + now.potential_energy;
}

/// Runs for 30 s: energy may be out by as much as an explicit step makes it while a spring turns
/// far in a step, and does not stay so.
void expectNoGain(const Scene& scene) {
  World world = reference(scene);
  const double begin = energyOf(world);
  const int steps = static_cast<int>(30.0 / scene.step);
  double late = 0.0;
  for (int i = 0; i < steps; ++i) {
    world.step();
    const double now = energyOf(world);
    ASSERT_LT(now, 1.7 * begin) << "in step " << i;
    if (i >= steps - 1000) late += now / 1000.0;
  }
  EXPECT_LT(late, 1.1 * begin);
}

constexpr double kStiffnesses[] = {100.0, 300.0, 1e3, 2e3, 5e3, 2e4, 1e6};

/// It winds a box up that it holds by a corner, so that the box turns far in a step.
TEST(Spring, OneThatHoldsABoxByItsCornerAddsNoEnergyForLong) {
  for (const double h : {0.01, 1.0 / 60.0}) {
    for (const double rest : {0.0, 1.0}) {
      for (const double stiffness : kStiffnesses) {
        SCOPED_TRACE(testing::Message() << stiffness << " N/m, " << rest << " m, h " << h);
        Scene scene = noGravity();
        scene.step = h;
        add(scene, box(1, 1, {0, 0}));
        scene.springs.push_back({.body = 0,
                                 .anchor = {0.5, 0.5},
                                 .to = {0, 3},
                                 .to_body = {},
                                 .stiffness = stiffness,
                                 .rest_length = rest});
        expectNoGain(scene);
      }
    }
  }
}

/// Two boxes at each other's corners, and one between two places.
TEST(Spring, SpringsBetweenBodiesAndManyOnOneAddNoEnergyForLong) {
  for (const double h : {0.01, 1.0 / 60.0}) {
    for (const double stiffness : kStiffnesses) {
      SCOPED_TRACE(testing::Message() << stiffness << " N/m, h " << h);
      Scene two = noGravity();
      two.step = h;
      add(two, box(1, 1, {-2, 0}));
      add(two, box(1, 0.5, {2, 1}));
      two.springs.push_back({.body = 0,
                             .anchor = {0.5, 0.5},
                             .to = {-0.5, 0.25},
                             .to_body = 1,
                             .stiffness = stiffness,
                             .rest_length = 1.0});
      expectNoGain(two);
      Scene one = noGravity();
      one.step = h;
      add(one, box(1, 1, {0, 0}));
      for (const double side : {-1.0, 1.0}) {
        one.springs.push_back({.body = 0,
                               .anchor = {0.5 * side, 0.5},
                               .to = {side, 3},
                               .to_body = {},
                               .stiffness = stiffness,
                               .rest_length = 1.0});
      }
      expectNoGain(one);
    }
  }
}

/// A box that a frame holds is pulled by its corner with the force of the stretch, however stiff
/// the spring.
TEST(Spring, AHeldBodyIsPulledByTheWholeStretch) {
  for (const double stiffness : {1e3, 2.4e3}) {
    Scene scene = onGround();
    add(scene, box(2, 1, {0, 0.5}));
    scene.bodies[1].mass = 1000.0;
    add(scene, named("post", pinned(box(0.1, 1, {1.05, 0.5}))));
    scene.springs.push_back({.body = 1,
                             .anchor = {1, 0.5},
                             .to = {2.5, 1},
                             .to_body = {},
                             .stiffness = stiffness,
                             .rest_length = 1.0});
    for (const Mode mode : {Mode::Reference, Mode::Merge}) {
      World world(scene, inMode(mode));
      runSeconds(world, 1);
      EXPECT_NEAR(world.capture().springs.at(0).force, 0.5 * stiffness, 0.01 * stiffness)
          << stiffness << " " << name(mode);
    }
  }
}

/// Also where an implicit step damps it, with a length and without.
TEST(Spring, OneThatIsTooStiffLeavesTheAngularMomentumOfTwoBodies) {
  for (const double rest : {0.0, 1.0}) {
    Scene scene = noGravity();
    scene.step = 1.0 / 60.0;
    add(scene, box(0.7, 0.3, {0, 0}));
    add(scene, box(0.8, 0.8, {2, 0}));
    scene.bodies[0].spin = 3.5;
    scene.springs.push_back({.body = 0,
                             .anchor = {-0.7, -0.4},
                             .to = {-0.4, -0.4},
                             .to_body = 1,
                             .stiffness = 4e3,
                             .rest_length = rest});
    World world = reference(scene);
    const Stats before = world.capture().stats;
    runSeconds(world, 4);
    EXPECT_NEAR(world.capture().stats.angular_momentum, before.angular_momentum, 1e-10) << rest;
  }
}

/// A soft spring is left alone.
TEST(Spring, ASoftOneHasItsEnergyForLong) {
  Scene scene = noGravity();
  add(scene, box(1, 1, {0, 0}));
  scene.springs.push_back({.body = 0,
                           .anchor = {0.5, 0.5},
                           .to = {0, 3},
                           .to_body = {},
                           .stiffness = 20.0,
                           .rest_length = 1.0});
  World world = reference(scene);
  const double begin = world.capture().stats.potential_energy;
  double sum = 0.0;
  for (int i = 0; i < 6000; ++i) {
    world.step();
    const Stats now = world.capture().stats;
    if (i >= 5000) sum += (now.kinetic_energy + now.potential_energy) / 1000.0;
  }
  EXPECT_NEAR(sum / begin, 1.0, 0.05);
}

}  // namespace
}  // namespace merge2d
