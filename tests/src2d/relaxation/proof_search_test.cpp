#include "src2d/relaxation/proof_search.h"

#include "src2d/dynamics/newton.h"
#include "src2d/state_file.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// A wall on ground that turns until it falls: searches that sweeps do not end.
const std::string kTiltingWall = R"(
format = 1
[material]
friction = 0.8
[[body]]
name = "ground"
motion = "scripted"
at = [0, -0.5]
box = [30, 1]
script = { velocity = [0, 0], spin = 2 }
[[body]]
at = [-5.5, 0.5]
box = [1, 1]
repeat = { count = [12, 48], spacing = [1, 1], stagger = 0.5 }
)";

World tiltingWall() {
  return World(parseScene(kTiltingWall, "wall.toml"), {.mode = Mode::Merge, .timings = false});
}

/// The state of a world, to look into.
struct StateOf {
  explicit StateOf(const World& world) {
    setUp(world.scene(), Mode::Merge, setup);
    restoreState(world.save(), "world", world.scene(), setup);
  }
  /// The collection in which a direct solve is under way, or none.
  Collection* suspended() {
    for (Collection& c : setup.state.collections) {
      for (const LoadCertificate& proof : c.certificate) {
        if (proof.search.isSuspended()) return &c;
      }
    }
    return nullptr;
  }
  merge2d::Setup setup;
};

/// Goes on until a direct solve is under way.
void stepUntilSuspended(World& world) {
  while (!StateOf(world).suspended()) {
    ASSERT_LT(world.time(), 20.0) << "sweeps have ended all searches";
    world.step();
  }
}

TEST(ProofSearch, AWorldSavedInTheMiddleOfADirectSolveGoesOnWithTheSameBytes) {
  World straight = tiltingWall();
  ASSERT_NO_FATAL_FAILURE(stepUntilSuspended(straight));
  for (int i = 0; i < 10; ++i) {
    World restored(straight.scene(), {.mode = Mode::Merge, .timings = false});
    restored.restore(straight.save(), "test");
    straight.step(), restored.step();
    ASSERT_EQ(straight.save(), restored.save()) << i;
  }
}

TEST(ProofSearch, ADirectSolveInPartsIsThatInOne) {
  World world = tiltingWall();
  ASSERT_NO_FATAL_FAILURE(stepUntilSuspended(world));
  StateOf inside(world);
  const State& state = inside.setup.state;
  const Collection& c = *inside.suspended();
  std::vector<std::uint32_t> bodies;
  std::vector<SolverVelocity> free(state.bodies.size() + 1);
  for (std::uint32_t m = 0; m < c.members.size(); ++m) {
    const BodyId b = c.members[m];
    const Twist& u = c.certificate.front().search.start[m];
    free[index(b)] = {u.vx, u.vy, u.omega, 1.0 / state[b].mass, 1.0 / state[b].inertia};
    bodies.push_back(static_cast<std::uint32_t>(index(b)));
  }
  const auto solve = [&](int steps, bool keeps) {
    std::vector<ContactBlock> blocks = c.blocks;
    std::vector<SolverVelocity> u = free;
    NewtonIterate iterate;
    NewtonWorkspace workspace;
    int parts = 1;
    while (!continueByNewton(blocks, {}, bodies, u, 1e-6, iterate, steps, workspace)) {
      ++parts;
      if (!keeps) workspace = {};
    }
    std::vector<Impulses> lambda;
    for (const ContactBlock& k : blocks) lambda.push_back(k.lambda);
    return std::pair(parts, lambda);
  };
  const auto [one, whole] = solve(50, true);
  EXPECT_EQ(one, 1);
  for (const bool keeps : {true, false}) {
    const auto [parts, lambda] = solve(2, keeps);
    EXPECT_GT(parts, 2);
    EXPECT_EQ(lambda, whole);
  }
}

/// Without weight nothing has loaded the magnet and its neighbours before they are hit, but for
/// rounding, and their contacts may be pressed against each other.
TEST(ProofSearch, LoadsOfNothingButRoundingForetellNothing) {
  World world(parseScene(R"(
format = 1
gravity = [0, 0]
[material]
friction = 0.1
[[body]]
name = "k0"
at = [0, 0]
box = [0.8160, 0.5457]
density = 10
[[body]]
name = "k1"
at = [0.40801, 0.54575]
box = [0.8160, 0.5457]
[[body]]
name = "k2"
at = [0.81603, 0]
box = [0.8160, 0.5457]
[[body]]
name = "k4"
at = [1.63205, 0]
box = [0.8160, 0.5457]
density = 0.1
[[body]]
name = "k5"
at = [2.04007, 0.54575]
box = [0.8160, 0.5457]
[[magnet]]
body = "k0"
[[body]]
name = "striker"
at = [2.03699, -4.94583]
shapes = [{ box = [0.947, 0.284] }, { box = [0.284, 0.947], at = [0.331, 0.379] }]
velocity = [-0.0896, 9.9996]
angle = 25
)",
                         "test.toml"),
              inMode(Mode::Merge));
  const double begin = world.capture().stats.kinetic_energy;
  for (int i = 0; i < 120; ++i) {
    world.step();
    ASSERT_LT(world.capture().stats.kinetic_energy, (1.0 + 1e-9) * begin) << "in step " << i;
  }
  EXPECT_LT(world.capture().stats.kinetic_energy, 0.7 * begin) << "nothing was hit";
}

}  // namespace
}  // namespace merge2d
