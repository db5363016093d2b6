/// Parts of a collection, each taken as one body.

#include "src2d/merging/rigid_parts.h"

#include <fmt/format.h>

#include <functional>

#include "tests/src2d/merging/merging_testing.h"

namespace merge2d {
namespace {

/// Calls back after the sweep of one step, with a scratch of its own.
class AfterSweep : public Observer {
 public:
  using Look = std::function<void(const State&, Scratch&, const Collection&)>;
  explicit AfterSweep(Look look) : look_(std::move(look)) {}

  void afterStage(Stage stage, const State& state, const Scratch& scratch) override {
    if (stage != Stage::SingleIterationPGS) return;
    Scratch own = scratch;
    for (const Collection& c : state.collections) {
      if (c.id != kNoCollection) look_(state, own, c), ++seen;
    }
  }
  int seen = 0;

 private:
  Look look_;
};

void lookAt(const std::string& toml, const AfterSweep::Look& look) {
  Simulation run(toml, Mode::Merge);
  run.steps(400);
  AfterSweep watch(look);
  run.world().observe(&watch);
  run.steps(1);
  run.world().observe(nullptr);
  EXPECT_EQ(watch.seen, 1);
}

/// A column of boxes of 1 m and 1 kg, merged with the ground.
void lookAtColumn(int boxes, const AfterSweep::Look& look) {
  lookAt(kGround + fmt::format("[[body]]\nname = \"box\"\nat = [0, 0.5]\nbox = [1, 1]\n"
                               "repeat = {{ count = [1, {}], spacing = [0, 1] }}\n",
                               boxes),
         look);
}

/// Two boxes on a slab, merged with the ground, and a plank of 2 kg that was just laid across them.
void lookUnderPlank(const AfterSweep::Look& look) {
  lookAt(kGround + R"(
[[body]]
name = "slab"
at = [0, 0.5]
box = [4, 1]
[[body]]
name = "box"
at = [-0.6, 1.5]
box = [1, 1]
repeat = { count = [2, 1], spacing = [1.2, 1] }
[[emitter]]
name = "plank"
at = [0, 2.1]
box = [2, 0.2]
mass = 2
every = 1
count = 1
start = 3.98
)",
         look);
}

bool joinsAll(const Weld&) { return true; }
bool joinsNone(const Weld&) { return false; }

TEST(RigidParts, WhatIsJoinedIsOneOnTheFrame) {
  lookAtColumn(3, [](const State& state, Scratch& scratch, const Collection& c) {
    ASSERT_TRUE(formParts(state, scratch, c, joinsAll));
    const RigidParts& p = scratch.rigid_parts;
    EXPECT_EQ(p.of, std::vector<std::uint32_t>({0, 0, 0, 1}));
    EXPECT_NEAR(p.parts[0].mass, 3.0, 1e-12);
    EXPECT_NEAR(p.parts[0].inertia, 3.0 * (1.0 + 9.0) / 12.0, 1e-3);  // a box of 1 m by 3 m
    EXPECT_NEAR(p.parts[0].x.y(), 1.5, 1e-2);
    EXPECT_EQ(p.rows.size(), 1u);
    EXPECT_EQ(p.u[1].inv_mass, 0.0);
  });
}

TEST(RigidParts, TheyHaveTheMomentumOfTheirMembers) {
  lookAtColumn(3, [](const State& state, Scratch& scratch, const Collection& c) {
    for (std::size_t i = 0; i < 3; ++i)
      scratch.sweep_u[index(c.members[i])].vx = 1.0 + 2.0 * double(i);
    ASSERT_TRUE(formParts(state, scratch, c, joinsAll));
    EXPECT_NEAR(scratch.rigid_parts.u[0].vx, 3.0, 1e-12);
    EXPECT_NEAR(scratch.rigid_parts.u[0].omega, -4.0 / 2.5, 1e-2);  // moment -4 N m s
  });
}

TEST(RigidParts, AColumnSettlesAndAPushedOneDoesNot) {
  lookAtColumn(3, [](const State& state, Scratch& scratch, const Collection& c) {
    ASSERT_TRUE(formParts(state, scratch, c, joinsNone));
    EXPECT_EQ(scratch.rigid_parts.rows.size(), 3u);
    EXPECT_LT(settleParts(state, scratch, c, 1e-6), 1e-6);
    EXPECT_TRUE(weldsFasterThan(state, scratch, c, 1e-6).empty());

    scratch.sweep_u[index(c.members[1])].vx = 1.0;  // friction stops 0.18 m/s in a step
    ASSERT_TRUE(formParts(state, scratch, c, joinsNone));
    EXPECT_GT(settleParts(state, scratch, c, 1e-6), 0.5);
    const auto welds = weldsFasterThan(state, scratch, c, 0.5);
    ASSERT_EQ(welds.size(), 2u) << "below and above it";
    for (const std::uint32_t w : welds) {
      EXPECT_TRUE(c.welds[w].a == c.members[1] || c.welds[w].b == c.members[1]);
    }
  });
}

TEST(RigidParts, WhatRestsOnThemBearsAnyLoad) {
  lookUnderPlank([](const State& state, Scratch& scratch, const Collection& c) {
    for (SolverVelocity& u : scratch.sweep_u) u.vx = u.vy = u.omega = 0.0;
    ASSERT_TRUE(formParts(state, scratch, c, joinsAll));
    const RigidParts& p = scratch.rigid_parts;
    ASSERT_EQ(p.outside.size(), 2u) << "the frame, and the plank once";
    EXPECT_EQ(p.rows.size(), 3u);
    EXPECT_EQ(p.u.back().inv_mass, 0.0);
  });
}

TEST(RigidParts, WhatMovesAgainstThemPushesWithItsOwnMass) {
  lookUnderPlank([](const State& state, Scratch& scratch, const Collection& c) {
    for (SolverVelocity& u : scratch.sweep_u) u.vx = u.vy = u.omega = 0.0;
    const std::size_t plank = state.bodies.size() - 1;
    scratch.sweep_u[plank].vx = 0.01;
    ASSERT_TRUE(formParts(state, scratch, c, joinsAll));
    const RigidParts& p = scratch.rigid_parts;
    ASSERT_EQ(p.outside.size(), 2u);
    EXPECT_EQ(p.outside.back(), state[BodyId{static_cast<std::uint32_t>(plank)}].rigid);
    EXPECT_EQ(p.u.back().vx, 0.01);
    EXPECT_EQ(p.u.back().inv_mass, 0.5);
    EXPECT_GT(p.u.back().inv_inertia, 0.0);
    EXPECT_EQ(p.u[p.of.back()].inv_mass, 0.0) << "the frame";
  });
}

TEST(RigidParts, MoreThanAFewAreNotFormed) {
  lookAtColumn(40, [](const State& state, Scratch& scratch, const Collection& c) {
    EXPECT_FALSE(formParts(state, scratch, c, joinsNone));
    EXPECT_TRUE(formParts(state, scratch, c, joinsAll));
  });
}

}  // namespace
}  // namespace merge2d
