/// The rows of a direct solve.

#include "src2d/dynamics/direct_rows.h"

#include <gtest/gtest.h>

#include <array>

namespace merge2d {
namespace {

/// The row of a crate on a turntable, which is told how to turn.
TEST(DirectRows, ARowWhosePointMovesEqualsOneThatIsMadeThere) {
  const SolverVelocity turntable{.vx = 0.2, .vy = -0.1, .omega = 3.0};
  const SolverVelocity crate{
      .vx = 1.0, .vy = 0.5, .omega = -2.0, .inv_mass = 0.5, .inv_inertia = 4.0};
  const std::vector<SolverVelocity> u{turntable, crate};
  constexpr std::array<std::uint32_t, 1> kResponds{1};
  const Vec2 d(0.6, 0.8);
  for (const bool crate_first : {false, true}) {
    const std::uint32_t a = crate_first ? 1 : 0, b = 1 - a;
    DirectRows rows(kResponds, u);
    const std::uint32_t moved = rows.add(a, b, d, 0.3, 0.2, 0.01);
    rows.setArms(moved, 0.5, -0.4);
    const std::uint32_t made = rows.add(a, b, d, 0.5, -0.4, 0.01);
    EXPECT_NEAR(rows[moved].bias, rows[made].bias, 1e-15);
    EXPECT_EQ(rows.along(moved, rows.freeVelocities()), rows.along(made, rows.freeVelocities()));
  }
}

}  // namespace
}  // namespace merge2d
