/// Blows that reach collections through joints.

#include <fmt/format.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// A cart of 20 kg on two wheels with a crate of 20 kg on it, that rolls with `speed`.
std::string cart(double speed, const std::string& more) {
  std::string toml = kGround + "[material]\nfriction = 0.5\n";
  const auto add = [&](const std::string& name, double x, double y, const std::string& rest) {
    toml += fmt::format("[[body]]\nname = \"{}\"\nat = [{}, {}]\nvelocity = [{}, 0]\n{}\n", name, x,
                        y, speed, rest);
  };
  add("cart", 0, 0.5, "box = [2, 0.2]\nmass = 20");
  add("crate", 0, 0.85, "box = [0.5, 0.5]\nmass = 20");
  for (const auto& [name, x] : {std::pair("rear", -0.7), std::pair("front", 0.7)}) {
    const double spin = -speed / 0.2 / kDegree;
    add(name, x, 0.2, fmt::format("circle = 0.2\nmass = 1\nspin = {}", spin));
    toml += fmt::format(
        "[[joint]]\nkind = \"revolute\"\nbodies = [\"cart\", \"{}\"]\nat = [{}, 0.2]\n", name, x);
  }
  return toml + more;
}

/// How far the crate is from where it was on its cart.
double wayOfCrate(const Simulation& run, const std::string& carrier = "cart") {
  return run.body("crate").x.x() - run.body(carrier).x.x();
}

/// What stops the cart does not stop the crate: it slides on, by v² / (2 μ g) where the cart
/// stands.
TEST(JointBlow, ACrateSlidesOnWhereARopeStopsItsCart) {
  const std::string rope =
      "[[joint]]\nkind = \"distance\"\nbodies = [\"cart\"]\nat = [-1, 0.5]\nto = [-4, 0.5]\n"
      "limits = [0, 9]\n";
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    SCOPED_TRACE(name(mode));
    Simulation run(cart(3.0, rope), mode);
    run.until(1.9);
    EXPECT_EQ(run.merged("crate"), mode != Mode::Reference);
    EXPECT_NEAR(wayOfCrate(run), 0.0, 1e-3);
    run.until(4.0);
    EXPECT_NEAR(wayOfCrate(run), 3.0 * 3.0 / (2 * 0.5 * kGravity), 0.05);
  }
}

/// The rope breaks where the cart alone is too much for it, as in the reference, and not where it
/// bears the cart but would not bear the crate too. It slows the cart by as much as it bears.
TEST(JointBlow, ARopeBreaksUnderWhatItStopsAlone) {
  for (const double force : {3000.0, 8000.0, 10000.0}) {
    SCOPED_TRACE(force);
    const std::string rope = fmt::format(
        "[[joint]]\nkind = \"distance\"\nbodies = [\"cart\"]\nat = [-1, 0.5]\nto = [-4, 0.5]\n"
        "limits = [0, 9]\nbreak_force = {}\n",
        force);
    const Overrides converged = {{"solver.iterations", "100"}};
    Simulation reference(cart(3.0, rope), Mode::Reference, converged);
    Simulation run(cart(3.0, rope), Mode::Merge, converged);
    for (Simulation* one : {&reference, &run}) one->until(4.0);
    EXPECT_EQ(run.count(EventType::Break), reference.count(EventType::Break));
    EXPECT_NEAR(run.body("cart").x.x(), reference.body("cart").x.x(), 0.01);
    EXPECT_NEAR(run.body("crate").x.x(), reference.body("crate").x.x(), 0.01);
  }
}

/// A rope from a drum that spins to a sledge with a load, whichever its first body is.
TEST(JointBlow, ARopeIsTautWhicheverOfItsBodiesComesFirst) {
  for (const bool spins_first : {true, false}) {
    SCOPED_TRACE(spins_first);
    const std::string toml =
        fmt::format(R"(
format = 1
gravity = [0, 0]
[material]
friction = 0.5
[[body]]
name = "drum"
at = [0, 0]
circle = 0.3
mass = 5
spin = 900
[[body]]
name = "sledge"
at = [3, 0]
box = [1, 0.4]
mass = 10
[[body]]
name = "load"
at = [3, 0.4]
box = [0.4, 0.4]
mass = 10
[[spring]]
body = "load"
to_body = "sledge"
stiffness = 500
damping = 20
[[joint]]
kind = "distance"
bodies = [{0}]
at = {1}
to = {2}
limits = [0, 2.3]
)",
                    spins_first ? "\"drum\", \"sledge\"" : "\"sledge\", \"drum\"",
                    spins_first ? "[0.25, 0]" : "[2.5, 0]", spins_first ? "[2.5, 0]" : "[0.25, 0]");
    Simulation reference(toml, Mode::Reference), run(toml, Mode::Merge);
    for (Simulation* one : {&reference, &run}) {
      one->until(0.5);
      EXPECT_EQ(one->merged("load"), one == &run);
      one->kick("drum", {-40.0, 0.0});
      one->until(1.5);
    }
    const auto off = [&](const std::string& body) {
      return (run.body(body).x - reference.body(body).x).norm();
    };
    EXPECT_LT(off("sledge"), 0.02);
    EXPECT_LT(off("load"), 0.02);
  }
}

/// A motor that starts is a blow as strong as it is.
TEST(JointBlow, ACrateSlidesOnATrayThatAMotorJerks) {
  const std::string toml = kGround + R"([material]
friction = 0.5
[[body]]
name = "tray"
at = [0, 2]
box = [3, 0.2]
mass = 20
[[body]]
name = "crate"
at = [0, 2.35]
box = [0.5, 0.5]
mass = 20
[[body]]
name = "hammer"
at = [-3, 2]
box = [0.2, 0.2]
mass = 20
velocity = [2, 0]
pinned_until = 3
[[joint]]
kind = "prismatic"
bodies = ["tray"]
at = [0, 2]
axis = [1, 0]
[[joint]]
kind = "prismatic"
bodies = ["hammer", "tray"]
at = [-3, 2]
axis = [1, 0]
motor = { speed = 0, force = 100000 }
)";
  Simulation reference(toml, Mode::Reference), run(toml, Mode::Merge);
  for (Simulation* one : {&reference, &run}) one->until(3.5);
  const auto off = [&](const std::string& body) {
    return (run.body(body).x - reference.body(body).x).norm();
  };
  EXPECT_LT(wayOfCrate(reference, "tray"), -0.05);
  EXPECT_LT(off("crate"), 0.02);
  EXPECT_LT(off("tray"), 0.02);
}

/// A crate slides on as well where a curb stops a wheel of its cart; the cart springs back a
/// little.
TEST(JointBlow, ACrateSlidesOnWhereACurbStopsAWheelOfItsCart) {
  const std::string curb =
      "[[body]]\nname = \"curb\"\nmotion = \"pinned\"\nat = [6.2, 0.1]\nbox = [0.4, 0.2]\n";
  Simulation reference(cart(3.0, curb), Mode::Reference), run(cart(3.0, curb), Mode::Merge);
  run.until(1.6);
  ASSERT_TRUE(run.merged("crate"));
  run.until(4.0);
  reference.until(4.0);
  EXPECT_NEAR(wayOfCrate(run), wayOfCrate(reference), 0.05);
  EXPECT_GT(wayOfCrate(run), 0.5);
}

/// A kick on a wheel moves the cart below its crate.
TEST(JointBlow, ACrateStaysBehindWhereAWheelOfItsCartIsKicked) {
  Simulation reference(cart(0.0, ""), Mode::Reference), run(cart(0.0, ""), Mode::Merge);
  for (Simulation* one : {&reference, &run}) {
    one->until(2.0);
    one->kick("rear", {60.0, 0.0});
    one->until(5.0);
  }
  EXPECT_LT(wayOfCrate(reference), -0.15);
  EXPECT_NEAR(wayOfCrate(run), wayOfCrate(reference), 0.02);
}

/// A limit stops a tray that swings to and fro, and its crate slides off: also while impulses are
/// sought for a load that changes in each step.
TEST(JointBlow, ACrateSlidesOnWhereALimitStopsItsTray) {
  const std::string toml = R"(
format = 1
[material]
friction = 0.5
[[body]]
name = "tray"
at = [0, -2]
shapes = [{ box = [0.1, 2], at = [0, 1] }, { box = [2, 0.2] }]
spin = 60
velocity = [2.0943951, 0]
mass = 10
[[body]]
name = "crate"
at = [0.4, -1.65]
box = [0.5, 0.5]
spin = 60
velocity = [1.727876, 0.418879]
mass = 10
[[joint]]
kind = "revolute"
bodies = ["tray"]
at = [0, 0]
limits = [-60, 10]
)";
  Simulation reference(toml, Mode::Reference), run(toml, Mode::Merge);
  run.until(0.15);
  ASSERT_TRUE(run.merged("crate"));
  reference.until(0.15);
  for (int step = 0; step < 100; ++step) {
    reference.steps(1);
    run.steps(1);
    const Vec2 off = run.body("crate").x - reference.body("crate").x;
    ASSERT_LT(off.norm(), 0.02) << step;
  }
}

/// A load that joints and contacts can pass on parts nothing: a crate on a tray that swings stays
/// merged.
TEST(JointBlow, ACrateStaysOnATrayThatSwings) {
  Simulation run(R"(
format = 1
[[body]]
name = "tray"
at = [0, -2]
shapes = [{ box = [0.1, 2], at = [0, 1] }, { box = [2, 0.2] }]
spin = 30
velocity = [1.0471976, 0]
[[body]]
name = "crate"
at = [0.4, -1.65]
box = [0.5, 0.5]
spin = 30
velocity = [0.8639380, 0.2094395]
[[joint]]
kind = "revolute"
bodies = ["tray"]
at = [0, 0]
)",
                 Mode::Merge);
  run.until(1.0);
  ASSERT_TRUE(run.merged("crate"));
  const int before = run.count(EventType::Unmerge);
  run.until(6.0);
  EXPECT_EQ(run.count(EventType::Unmerge), before);
}

}  // namespace
}  // namespace merge2d
