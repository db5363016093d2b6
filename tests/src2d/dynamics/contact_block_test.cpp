/// The kernel of a sweep against the conditions that define its result.

#include "src2d/dynamics/contact_block.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/random.h"

namespace merge2d {
namespace {

SolverVelocity anyBody() {
  return {uniform(-2, 2), uniform(-2, 2), uniform(-2, 2), uniform(0.01, 2), uniform(0.01, 2)};
}

/// Two points of a face, at least 0.2 m apart.
BlockGeometry anyGeometry(int count) {
  BlockGeometry g;
  g.normal = Rotation::of(uniform(-3.1, 3.1)) * Vec2(1, 0);
  g.count = count;
  g.softness = uniform(0, 0.1);
  const Vec2 a = anyVec(1), b = anyVec(1);
  const Vec2 along = uniform(0.2, 1.0) * perpendicular(g.normal);
  g.arm_a[0] = a, g.arm_a[1] = a + along;
  g.arm_b[0] = b, g.arm_b[1] = b + along;
  return g;
}

RC_GTEST_PROP(ContactBlock, TheNormalsSolveTheirComplementarityProblem, (bool pair)) {
  SolverVelocity a = anyBody(), b = anyBody();
  ContactBlock k;
  prepareBlock(k, anyGeometry(pair ? 2 : 1), a, b);
  k.mu = 0.0;
  for (int i = 0; i < k.count; ++i) {
    k.lambda_n(i) = uniform(0, 1);
    k.bias[i] = uniform(-0.5, 0.5);
  }
  solveBlock(k, k.nx, k.ny, a, b);
  for (int i = 0; i < k.count; ++i) {
    const double w =
        contactVelocity(k, i, k.nx, k.ny, a, b).n + k.bias[i] + k.softness * k.lambda_n(i);
    RC_ASSERT(k.lambda_n(i) >= 0.0);
    RC_ASSERT(w >= -1e-9);
    RC_ASSERT(std::abs(w * k.lambda_n(i)) < 1e-9);
  }
}

/// One point bears all and the other just touches: each case of the solution may then fail by a
/// rounding error, and what rests was let go.
RC_GTEST_PROP(ContactBlock, StaysWhereOnlyRoundingTellsWhatPresses, (bool first)) {
  SolverVelocity a = anyBody(), b = anyBody();
  a.vx = a.vy = a.omega = b.vx = b.vy = b.omega = 0.0;
  ContactBlock k;
  prepareBlock(k, anyGeometry(2), a, b);
  const int bears = first ? 0 : 1;
  k.lambda_n(bears) = uniform(0.1, 1);
  for (int i = 0; i < 2; ++i) {
    k.bias[i] = 1e-18 * uniform(-10, 10) - k.softness * k.lambda_n(i);
  }
  const double before = k.lambda_n(bears);
  solveBlock(k, k.nx, k.ny, a, b);
  RC_ASSERT(std::abs(k.lambda_n(bears) - before) < 1e-12);
  RC_ASSERT(k.lambda_n(1 - bears) < 1e-12);
}

RC_GTEST_PROP(ContactBlock, FrictionOpposesSlipAndStaysInItsCone, ()) {
  SolverVelocity a = anyBody(), b = anyBody();
  ContactBlock k;
  prepareBlock(k, anyGeometry(1), a, b);
  k.mu = uniform(0, 1);
  k.lambda_n(0) = uniform(0, 1);
  solveBlock(k, k.nx, k.ny, a, b);
  const double limit = k.mu * k.lambda_n(0);
  const double slip = contactVelocity(k, 0, k.nx, k.ny, a, b).t;
  RC_ASSERT(std::abs(k.lambda_t(0)) <= limit);
  if (std::abs(slip) > 1e-9) RC_ASSERT(std::abs(k.lambda_t(0) + std::copysign(limit, slip)) < 1e-9);
}

RC_GTEST_PROP(ContactBlock, ASweepKeepsMomentum, (bool rows)) {
  const SolverVelocity before_a = anyBody(), before_b = anyBody();
  SolverVelocity a = before_a, b = before_b;
  BlockGeometry g = anyGeometry(2);
  const Vec2 offset = g.arm_a[0] - g.arm_b[0];  // of b's centre from a's
  ContactBlock k;
  prepareBlock(k, g, a, b);
  k.mu = 0.5;
  k.bias[0] = uniform(-1, 1);
  (rows ? solveRows : solveBlock)(k, k.nx, k.ny, a, b);
  const Vec2 pa((a.vx - before_a.vx) / a.inv_mass, (a.vy - before_a.vy) / a.inv_mass);
  const Vec2 pb((b.vx - before_b.vx) / b.inv_mass, (b.vy - before_b.vy) / b.inv_mass);
  const double la = (a.omega - before_a.omega) / a.inv_inertia;
  const double lb = (b.omega - before_b.omega) / b.inv_inertia;
  RC_ASSERT((pa + pb).norm() < 1e-10);
  RC_ASSERT(std::abs(la + lb + cross(offset, pb)) < 1e-10);
}

RC_GTEST_PROP(ContactBlock, WhatIsSolvedIsNotChangedBySolvingItAgain, ()) {
  SolverVelocity a = anyBody(), b = anyBody();
  ContactBlock k;
  prepareBlock(k, anyGeometry(2), a, b);
  k.mu = 0.0;
  solveBlock(k, k.nx, k.ny, a, b);
  const double first = k.lambda_n(0), second = k.lambda_n(1);
  solveBlock(k, k.nx, k.ny, a, b);
  RC_ASSERT(std::abs(k.lambda_n(0) - first) < 1e-10);
  RC_ASSERT(std::abs(k.lambda_n(1) - second) < 1e-10);
}

/// The two corners of a unit box on the ground.
BlockGeometry boxOnGround() {
  BlockGeometry g;
  g.normal = {0, 1};
  g.count = 2;
  g.arm_a[0] = {-0.5, 0}, g.arm_a[1] = {0.5, 0};
  g.arm_b[0] = {-0.5, -0.5}, g.arm_b[1] = {0.5, -0.5};
  return g;
}

TEST(ContactBlock, AMagnetPullsAndHoldsSideways) {
  SolverVelocity a;  // fixed
  SolverVelocity b{.vx = 1.0, .vy = 1.0, .inv_mass = 1.0, .inv_inertia = 6.0};
  ContactBlock k;
  prepareBlock(k, boxOnGround(), a, b);
  k.bilateral = true;
  k.mu = 0.1;
  for (int i = 0; i < 100; ++i) solveBlock(k, k.nx, k.ny, a, b);
  EXPECT_NEAR(b.vx, 0.0, 1e-12);
  EXPECT_NEAR(b.vy, 0.0, 1e-12);
  EXPECT_NEAR(b.omega, 0.0, 1e-12);
  EXPECT_LT(k.lambda_n(0) + k.lambda_n(1), 0.0);
}

/// A box on the ground that is pushed along it at 0.1 m/s; one corner presses more.
ContactBlock pushedBox(SolverVelocity& a, SolverVelocity& b) {
  b = {.vx = 0.1, .vy = -1.0, .omega = 0.5, .inv_mass = 1.0, .inv_inertia = 6.0};
  ContactBlock k;
  prepareBlock(k, boxOnGround(), a, b);
  k.mu = 0.8;
  return k;
}

TEST(ContactBlock, FrictionAsOneRowHoldsAsTwoRowsDo) {
  SolverVelocity a, b;
  ContactBlock k = pushedBox(a, b);
  for (int i = 0; i < 50; ++i) solveBlock(k, k.nx, k.ny, a, b);
  SolverVelocity a_turn, b_turn;
  ContactBlock in_turn = pushedBox(a_turn, b_turn);
  for (int i = 0; i < 50; ++i) solveBlock(in_turn, k.nx, k.ny, a_turn, b_turn);
  EXPECT_NEAR(b.vx, 0.0, 1e-12);
  EXPECT_NEAR(b.omega, b_turn.omega, 1e-12);
  EXPECT_NEAR(k.lambda_t(0) + k.lambda_t(1), in_turn.lambda_t(0) + in_turn.lambda_t(1), 1e-12);
}

TEST(ContactBlock, FrictionAsOneRowIsSharedByPressure) {
  SolverVelocity a, b;
  ContactBlock k = pushedBox(a, b);
  solveBlock(k, k.nx, k.ny, a, b);
  ASSERT_GT(k.lambda_n(0), 0.0);
  ASSERT_GT(k.lambda_n(0), k.lambda_n(1));
  ASSERT_GT(k.lambda_n(1), 0.0);
  EXPECT_NEAR(k.lambda_t(0) / k.lambda_t(1), k.lambda_n(0) / k.lambda_n(1), 1e-12);
}

TEST(ContactBlock, TwoPointsInOnePlaceAreTreatedAsOne) {
  SolverVelocity a, b{.vy = -1.0, .inv_mass = 1.0, .inv_inertia = 6.0};
  BlockGeometry g;
  g.normal = {0, 1};
  g.count = 2;
  g.arm_b[0] = {0, -0.5}, g.arm_b[1] = {1e-9, -0.5};
  ContactBlock k;
  prepareBlock(k, g, a, b);
  EXPECT_EQ(k.count, 1);
  solveBlock(k, k.nx, k.ny, a, b);
  EXPECT_NEAR(b.vy, 0.0, 1e-12);
}

}  // namespace
}  // namespace merge2d
