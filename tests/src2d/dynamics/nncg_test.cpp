#include "src2d/dynamics/nncg.h"

#include <gtest/gtest.h>

namespace merge2d {
namespace {

/// A row of bodies that are pushed together, each pair by one contact point.
struct Row {
  std::vector<SolverVelocity> u;
  std::vector<ContactBlock> blocks;
  NncgBuffers buffers;

  explicit Row(std::uint32_t count) : u(count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      u[i] = {i == 0 ? 1.0 : 0.0, 0.0, 0.0, 1.0 / (1.0 + i), 1.0};
    }
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      ContactBlock k;
      k.a = i;
      k.b = i + 1;
      BlockGeometry g;
      g.count = 1;
      g.arm_a[0] = Vec2(0.5, 0.1);
      g.arm_b[0] = Vec2(-0.5, 0.1);
      prepareBlock(k, g, u[i], u[i + 1]);
      k.mu = 0.5;
      blocks.push_back(k);
    }
  }

  auto iteration() {
    return Nncg(
        blocks.size(), [this](std::size_t i) -> Impulses& { return blocks[i].lambda; }, u.size(),
        [this](std::size_t i) -> SolverVelocity& { return u[i]; },
        [this] {
          for (ContactBlock& k : blocks) solveBlock(k, k.nx, k.ny, u[k.a], u[k.b]);
        },
        buffers);
  }
  static bool never() { return false; }
};

TEST(Nncg, GoesOnAfterAPauseAsIfThereHadBeenNone) {
  Row whole(12), paused(12);
  whole.iteration().run(30, true);
  paused.iteration().run(13, true);
  paused.iteration().resume(17, Row::never);
  for (std::size_t i = 0; i < whole.blocks.size(); ++i) {
    EXPECT_EQ(whole.blocks[i].lambda, paused.blocks[i].lambda) << i;
  }
}

TEST(Nncg, ConvergesFasterThanPlainSweeps) {
  Row converged(12), accelerated(12), plain(12);
  converged.iteration().run(2000, true);
  accelerated.iteration().run(30, true);
  plain.iteration().run(30, false);
  const auto off = [&](const Row& row) {
    double most = 0.0;
    for (std::size_t i = 0; i < row.u.size(); ++i) {
      most = std::max(most, std::abs(row.u[i].vx - converged.u[i].vx));
    }
    return most;
  };
  EXPECT_LT(off(accelerated), 0.1 * off(plain));
}

}  // namespace
}  // namespace merge2d
