#include "src2d/dynamics/wide_blocks.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "src2d/dynamics/scratch.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

constexpr std::size_t kBodies = 60;

/// Blocks in colours, as an island has them; body 0 is fixed, the last velocity is the world's.
struct RandomIsland {
  std::vector<SolverVelocity> u{kBodies + 1};
  std::vector<ContactBlock> blocks;
  std::vector<BlockOrder> order;
};

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint32_t seed) : engine_(seed) {}
  double between(double least, double most) {
    return least + (most - least) * static_cast<double>(engine_()) / 4294967295.0;
  }
  bool oneIn(std::uint32_t n) { return engine_() % n == 0; }

 private:
  std::mt19937 engine_;
};

ContactBlock randomBlock(RandomNumbers& random, const RandomIsland& island, std::uint32_t a,
                         std::uint32_t b) {
  ContactBlock k;
  k.a = a;
  k.b = b;
  const double angle = random.between(-3, 3);
  BlockGeometry g;
  g.normal = {std::cos(angle), std::sin(angle)};
  g.count = random.oneIn(3) ? 1 : 2;
  for (std::size_t i = 0; i < 2; ++i) {
    g.arm_a[i] = {random.between(-1, 1), random.between(-1, 1)};
    g.arm_b[i] = {random.between(-1, 1), random.between(-1, 1)};
    k.bias[i] = random.between(-1, 1);
  }
  g.softness = random.oneIn(2) ? 0.0 : 0.01;
  prepareBlock(k, g, island.u[a], island.u[b]);
  if (k.count == 1) k.bias[1] = 0.0;
  k.mu = random.oneIn(5) ? 0.0 : random.between(0, 1);
  k.bilateral = random.oneIn(20);
  for (int i = 0; i < k.count; ++i) {
    k.lambda_n(i) = random.oneIn(3) ? 0.0 : random.between(0, 2);
    k.lambda_t(i) = k.mu * k.lambda_n(i) * random.between(-1, 1);
  }
  if (k.count == 1 && random.oneIn(3)) k.setRolling(0.05, random.between(-1, 1));
  return k;
}

RandomIsland randomIsland(std::uint32_t seed) {
  RandomNumbers random(seed);
  RandomIsland island;
  for (std::size_t i = 1; i < kBodies; ++i) {
    SolverVelocity& u = island.u[i];
    u.vx = random.between(-2, 2);
    u.vy = random.between(-2, 2);
    u.omega = random.between(-2, 2);
    u.inv_mass = random.between(0.1, 2);
    u.inv_inertia = random.between(0.1, 20);
    if (random.oneIn(4)) u.surface = random.between(-1, 1);
  }
  for (std::uint32_t colour = 0; colour < 6; ++colour) {
    // Neighbours, of which some stand on the fixed body. In the last colour they share bodies.
    const bool mixed = colour == 5;
    for (std::uint32_t i = 1; i + 1 < kBodies; i += mixed ? 1 : 2 + colour) {
      if (random.oneIn(4)) continue;
      island.blocks.push_back(randomBlock(random, island, random.oneIn(5) ? 0 : i, i + 1));
      island.order.push_back(BlockOrder::of(1, mixed ? 63 : colour, 0));
    }
  }
  return island;
}

void sweepOneByOne(RandomIsland& island) {
  for (ContactBlock& k : island.blocks) {
    solveBlock(k, k.nx, k.ny, island.u[k.a], island.u[k.b]);
  }
}

bool sameBits(const RandomIsland& x, const RandomIsland& y) {
  for (std::size_t i = 0; i < x.u.size(); ++i) {
    if (std::memcmp(&x.u[i].vx, &y.u[i].vx, 3 * sizeof(double)) != 0) return false;
  }
  for (std::size_t i = 0; i < x.blocks.size(); ++i) {
    if (std::memcmp(&x.blocks[i].lambda, &y.blocks[i].lambda, sizeof(Impulses)) != 0) return false;
  }
  return true;
}

TEST(WideBlocks, GiveTheSameBitsAsOneBlockAfterTheOther) {
  for (const SweepPath path : {SweepPath::Avx2, SweepPath::Portable}) {
    for (std::uint32_t seed = 1; seed <= 200; ++seed) {
      RandomIsland expected = randomIsland(seed), island = expected;
      std::vector<PackedAs> kinds;
      for (const ContactBlock& k : island.blocks) kinds.push_back(packedAs(k));
      WideBlocks wide;
      wide.pack(island.blocks, kinds, island.order, kBodies);
      for (int sweep = 1; sweep <= 4; ++sweep) {
        sweepOneByOne(expected);
        wide.sweep(island.blocks, island.u, path);
        RandomIsland now = island;
        wide.unpack(now.blocks);
        ASSERT_TRUE(sameBits(now, expected)) << "seed " << seed << ", sweep " << sweep;
      }
    }
  }
}

/// More bodies on one board than there are colours, faces that overlap by a hair, discs that bounce
/// or resist rolling, and a bullet: all kinds of rows in one island.
Scene allKindsOfRows() {
  Scene scene = onGround();
  add(scene, box(10, 0.2, {0, 0.1}));
  for (int i = 0; i < 80; ++i) add(scene, box(0.1, 0.1, {-4.8 + 0.12 * i, 0.25}));
  for (int i = 0; i < 30; ++i) add(scene, box(0.1, 0.1, {-4.8 + 0.24 * i + 0.1 - 1e-7, 0.35}));
  for (int i = 0; i < 6; ++i) {
    BodyDesc ball = disc(0.05, {3.0 + 0.12 * i, 0.36});
    (i % 2 == 0 ? ball.rolling : ball.restitution) = i % 2 == 0 ? 0.01 : 0.5;
    add(scene, ball);
  }
  BodyDesc bullet = box(0.1, 0.1, {-8, 0.28});
  bullet.velocity = {120, 0};
  add(scene, bullet);
  return scene;
}

/// The bytes that a run on a path ends with.
std::string endBy(SweepPath path, const Scene& scene, Mode mode) {
  World world(scene, {.mode = mode, .timings = false, .sweep_path = path});
  for (int i = 0; i < 150; ++i) world.step();
  return world.save();
}

TEST(WideBlocks, RowsOfAllKindsAreTheSameBytesOnEveryPath) {
  const Scene scene = allKindsOfRows();
  for (const Mode mode : {Mode::Reference, Mode::Merge}) {
    const std::string expected = endBy(SweepPath::OneByOne, scene, mode);
    EXPECT_TRUE(endBy(SweepPath::Portable, scene, mode) == expected);
    EXPECT_TRUE(endBy(SweepPath::Avx2, scene, mode) == expected);
  }
}

TEST(WideBlocks, RunsOfScenesEndWithTheSameBytesOnEveryPath) {
  for (const char* of : {"tower-impulse", "pile", "conveyor", "ship-crane", "wagon"}) {
    const Scene scene = loadScene(of);
    for (const Mode mode : {Mode::Reference, Mode::Merge}) {
      const std::string expected = endBy(SweepPath::OneByOne, scene, mode);
      EXPECT_TRUE(endBy(SweepPath::Portable, scene, mode) == expected) << of;
      EXPECT_TRUE(endBy(SweepPath::Avx2, scene, mode) == expected) << of;
    }
  }
}

}  // namespace
}  // namespace merge2d
