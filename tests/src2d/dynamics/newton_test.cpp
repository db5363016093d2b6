/// Newton's method, which solves all rows of an island at once.

#include "src2d/dynamics/newton.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "src2d/scene/load.h"
#include "tests/support/modes_and_steps.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

Scene byNewton(Scene scene, int sweeps = 10) {
  scene.settings.solver.method = SolverMethod::Newton;
  scene.settings.solver.iterations = sweeps;
  return scene;
}

World newtonWorld(const std::string& toml, double h) {
  Scene scene = sceneOf(toml);
  scene.step = h;
  return reference(byNewton(scene));
}

// The tolerance is two thousandths of the velocity that gravity gives in a step, 0.0981 m/s.
TEST(Newton, FindsInTheFirstStepTheForcesThatManySweepsFind) {
  for (const Scene& scene : {column(6), wall(6, 6), unequalColumn(6, 100)}) {
    Scene many = scene;
    many.settings.solver.iterations = 3000;
    World newton = reference(byNewton(scene)), sweeps = reference(many);
    newton.step(), sweeps.step();
    const Snapshot a = newton.capture(), b = sweeps.capture();
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
      EXPECT_LT((a.bodies[i].v - b.bodies[i].v).norm(), 2e-4);
      EXPECT_NEAR(a.bodies[i].omega, b.bodies[i].omega, 2e-4);
    }
  }
}

/// Boxes of 1 kg carry boxes of 1,000 kg, in turn, by hard contacts: each has the weight above it.
TEST(Newton, AColumnOfAnyRatioCarriesItsWeight) {
  Scene scene = byNewton(unequalColumn(20, 1000));
  scene.settings.solver.compliance = 0.0;
  World world = reference(scene);
  runSeconds(world, 0.1);
  std::map<BodyId, double> force;
  double above = 0.0;
  for (const ContactView& c : world.capture().contacts)
    force[c.b] += c.lambda_n / world.scene().step;
  const std::vector<BodyInfo>& bodies = world.bodies();
  for (std::size_t i = bodies.size(); i-- > 1;) {
    above += bodies[i].mass * kGravity;
    EXPECT_NEAR(force[BodyId{static_cast<std::uint32_t>(i)}], above, 1e-3 * above)
        << bodies[i].name;
  }
}

/// Layers a hundred times heavier in turn (Section 8.1 of the paper).
TEST(Newton, HeavyLayersRestAfterASecond) {
  const auto fastestOf = [](Scene scene) {
    World world = reference(scene);
    runSeconds(world, 1.0);
    return fastest(world);
  };
  Scene scene = unequalColumn(12, 100);
  scene.settings.solver.compliance = 2e-6;
  EXPECT_LT(fastestOf(byNewton(scene)), 0.01 * fastestOf(scene));
}

/// x = ½ g (sin α − μ cos α) t², and it does not lift off while it slides.
TEST(Newton, ABlockSlidesAsCoulombSays) {
  const double slope = 30.0 * kDegree;
  for (const double mu : {0.1, 0.3, 0.5, 0.6}) {
    World world = newtonWorld(
        fmt::format("gravity = [{}, {}]\n[material]\nfriction = {}\n[[body]]\nmotion = \"pinned\"\n"
                    "at = [0, -0.5]\nbox = [100, 1]\n[[body]]\nname = \"block\"\nat = [0, 0.25]\n"
                    "box = [1, 0.5]\n",
                    kGravity * std::sin(slope), -kGravity * std::cos(slope), mu),
        0.01);
    runSeconds(world, 2.0);
    const double a = std::max(0.0, kGravity * (std::sin(slope) - mu * std::cos(slope)));
    EXPECT_NEAR(see(world, "block").x.x(), 0.5 * a * 4.0, 0.01 * a * 2.0 + 1e-4) << mu;
    EXPECT_NEAR(see(world, "block").x.y(), 0.25, 2e-3) << mu;
  }
}

/// As in belt_test.cpp and rolling_test.cpp.
TEST(Newton, BeltsDriveAndRollingResists) {
  World belt = newtonWorld(
      "[[body]]\nmotion = \"pinned\"\nat = [0, -0.5]\nbox = [200, 1]\nsurface_velocity = 1.5\n"
      "[[body]]\nname = \"box\"\nat = [0, 0.25]\nbox = [0.5, 0.5]\n",
      0.01);
  runSeconds(belt, 6.0);
  const double v = 1.5, lag = v * v / (2.0 * 0.6 * kGravity);
  EXPECT_NEAR(see(belt, "box").x.x(), 6.0 * v - lag, 0.01 * v);

  World disc = newtonWorld(
      "[[body]]\nmotion = \"pinned\"\nat = [0, -0.5]\nbox = [200, 1]\n[[body]]\nname = \"disc\"\n"
      "at = [0, 0.5]\ncircle = 0.5\nrolling = 0.05\nvelocity = [2, 0]\nspin = -229.183\n",
      0.01);
  runSeconds(disc, 1.0);
  EXPECT_NEAR(see(disc, "disc").v.x(), 2.0 - 2.0 / 3.0 * 0.05 * kGravity / 0.5, 0.01);
}

/// An arm on a hinge with a motor that is too weak falls on its limit, and stays there.
TEST(Newton, MotorsAndLimitsKeepTheirBounds) {
  const auto angleWith = [](double torque) {
    World world = newtonWorld(
        fmt::format("[[body]]\nname = \"post\"\nmotion = \"pinned\"\nbox = [0.2, 0.2]\n[[body]]\n"
                    "name = \"arm\"\nat = [0.5, 0]\nbox = [1, 0.1]\nmass = 2\n[[joint]]\n"
                    "kind = \"revolute\"\nbodies = [\"post\", \"arm\"]\nat = [0, 0]\n"
                    "limits = [-30, 60]\nmotor = {{ speed = 90, torque = {} }}\n",
                    torque),
        0.01);
    runSeconds(world, 3.0);
    return see(world, "arm").angle / kDegree;
  };
  EXPECT_NEAR(angleWith(5.0), -30.0, 0.1) << "its weight is worth 9.81 N m";
  EXPECT_NEAR(angleWith(15.0), 60.0, 0.1);
}

/// The energy at any time, less that at the start [J].
double gainOfEnergy(World world, double seconds) {
  const auto energy = [&] {
    const Stats stats = world.capture().stats;
    return stats.kinetic_energy + stats.potential_energy;
  };
  const double before = energy();
  double most = 0.0;
  while (world.time() < seconds) {
    world.step();
    most = std::max(most, energy() - before);
  }
  return most;
}

/// The point that is hit has a row that takes no part in the solve, beside rows that do.
TEST(Newton, AHitBesideContactsThatCarryGivesNoEnergy) {
  const std::string scene =
      "[[body]]\nmotion = \"pinned\"\nat = [0, -0.5]\nbox = [20, 1]\n[[body]]\nat = [0, 0.5]\n"
      "box = [1, 1]\n[[body]]\nat = [0.2, 1.25]\nbox = [1, 0.5]\n[[body]]\nat = [0.1, 4]\n"
      "circle = 0.3\nrestitution = 0.5\n";
  EXPECT_LT(gainOfEnergy(newtonWorld(scene, 0.01), 3.0), 0.01);
  Scene fast = sceneOf(scene);
  fast.bodies.back().velocity = {0.0, -30.0};  // it meets in the middle of a step
  EXPECT_LT(gainOfEnergy(reference(byNewton(fast)), 1.0), 0.01);
}

TEST(Newton, DominoesFallAsInSweeps) {
  const auto last = [](const Scene& scene) {
    World world = reference(scene);
    runSeconds(world, 3.0);
    return world.capture().stats.potential_energy;
  };
  const Scene scene = loadScene("dominoes");
  EXPECT_NEAR(last(byNewton(scene)), last(scene), 0.3) << "of 53 J before they fall";
}

TEST(Newton, ReachesTheSameBytesInEachRun) {
  const auto last = [] {
    World world = reference(byNewton(wall(5, 5)));
    runSeconds(world, 0.5);
    return world.capture();
  };
  const Snapshot a = last(), b = last();
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].x, b.bodies[i].x);
    EXPECT_EQ(a.bodies[i].angle, b.bodies[i].angle);
  }
}

/// In the step after its load has gone a brake has impulses of the step before, and nothing moves.
TEST(Newton, ABrakeOutlivesTheEndOfItsLoad) {
  World world = newtonWorld(R"(
gravity = [0, 0]
[[body]]
name = "post"
motion = "pinned"
at = [-0.25, 0]
box = [0.5, 0.5]
[[body]]
name = "arm"
at = [1, 0]
box = [2, 0.2]
mass = 1
[[joint]]
kind = "revolute"
bodies = ["post", "arm"]
at = [0, 0]
motor = { speed = 0, torque = 20 }
[[force]]
body = "arm"
force = [0, -15]
from = 0.2
until = 0.4
)",
                            0.01);
  runSteps(world, 100);
  EXPECT_NEAR(world.capture().bodies[1].omega, 0.0, 1e-6);
}

}  // namespace
}  // namespace merge2d
