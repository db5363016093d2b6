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

}  // namespace
}  // namespace merge2d
