#include "src2d/proofs/load_certificate.h"

#include <bit>

#include "src2d/collections/collection.h"
#include "src2d/proofs/coverage.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/state_file.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// On a cart that swings stand boxes, and discs in the gaps between them, with rolling resistance.
const std::string kSwingingCart = R"(
format = 1
[material]
friction = 0.8
rolling = 0.05
)" + kCartOnSprings + R"(
[[body]]
name = "box"
at = [-1.65, 0.75]
box = [0.8, 0.5]
repeat = { count = [4, 1], spacing = [1.1, 1] }
[[body]]
name = "disc"
at = [-1.1, 1.26]
circle = 0.3
repeat = { count = [3, 1], spacing = [1.1, 1] }
)";

/// A world that has been at it for so long that nothing is sought inside the cart's collection, and
/// its blocks are away.
World quietCart() {
  World world(parseScene(kSwingingCart, "cart.toml"), {.mode = Mode::Merge, .timings = false});
  while (world.time() < 40.0) world.step();
  return world;
}

/// The state of a world, to look into.
struct Inside {
  explicit Inside(const World& world) {
    setUp(world.scene(), Mode::Merge, setup);
    restoreState(world.save(), "world", world.scene(), setup);
  }
  Collection& cart() {
    for (Collection& c : setup.state.collections) {
      if (c.id != kNoCollection && c.members.size() > 5) return c;
    }
    throw std::logic_error("the cart and its load have not merged");
  }
  merge2d::Setup setup;
};

/// Of each contact, in their order, wherever its impulses are.
std::vector<Impulses> impulsesOf(const Collection& c) {
  std::vector<Impulses> all;
  for (const InternalContact& inner : c.contacts) {
    if (inner.block == InternalContact::kNoBlock) {
      all.push_back({inner.points[0].lambda_n, inner.points[1].lambda_n, inner.points[0].lambda_t,
                     inner.points[1].lambda_t});
    } else {
      all.push_back(c.blocks[inner.block].lambda);
    }
  }
  return all;
}

/// Contacts whose rolling resistance carries a moment.
int momentsHeld(const Collection& c) {
  return static_cast<int>(std::ranges::count_if(c.contacts, [](const InternalContact& inner) {
    return inner.count == 1 && inner.points[1].lambda_t != 0.0;
  }));
}

/// The impulse of all contacts on one body [N s].
Vec2 impulseOn(const Snapshot& seen, BodyId body) {
  Vec2 sum = Vec2::Zero();
  for (const ContactView& c : seen.contacts) {
    const Vec2 impulse = c.lambda_n * c.normal + c.lambda_t * perpendicular(c.normal);
    if (c.b == body) sum += impulse;
    if (c.a == body) sum -= impulse;
  }
  return sum;
}

TEST(LoadCertificate, ForcesFollowTheLoadWhileTheBlocksAreAway) {
  World world = quietCart();
  const BodyId disc = idOf(world, "disc[1,0]");
  const double mass = world.bodies()[index(disc)].mass, h = world.scene().step;
  double largest = 0.0, off = 0.0;
  for (int step = 0; step < 600; ++step) {
    const Vec2 before = see(world, disc).v;
    world.step();
    Inside inside(world);
    ASSERT_TRUE(areBlocksAway(inside.cart())) << step;
    EXPECT_GT(momentsHeld(inside.cart()), 0) << step;
    const Vec2 wanted = mass * (see(world, disc).v - before + Vec2(0.0, h * kGravity));
    largest = std::max(largest, std::abs(wanted.x()));
    off = std::max(off, (impulseOn(world.capture(), disc) - wanted).norm());
  }
  EXPECT_GT(largest, 0.1 * mass * h) << "the cart swings";
  EXPECT_LT(off, 0.05 * largest);
}

TEST(LoadCertificate, WritesTheSameImpulsesIntoContactsAsIntoBlocks) {
  const World world = quietCart();
  Inside away(world), there(world);
  bringBlocksBack(there.setup.state, there.cart());
  ASSERT_FALSE(areBlocksAway(there.cart()));
  const std::vector<Impulses> before = impulsesOf(away.cart());
  for (Inside* inside : {&away, &there}) {
    LoadCertificate& proof = inside->cart().certificate.front();
    ASSERT_FALSE(proof.witnesses.empty());
    proof.weights = {};
    proof.weights[0] = 0.7;
    proof.lambda_stale = true;
    writeImpulses(inside->cart());
  }
  ASSERT_TRUE(areBlocksAway(away.cart()));
  EXPECT_NE(impulsesOf(away.cart()), before);
  EXPECT_EQ(impulsesOf(away.cart()), impulsesOf(there.cart()));
  bringBlocksBack(away.setup.state, away.cart());
  EXPECT_EQ(impulsesOf(away.cart()), impulsesOf(there.cart())) << "and the blocks have them";
  EXPECT_TRUE(std::ranges::any_of(away.cart().blocks,
                                  [](const ContactBlock& k) { return k.lambda_r() != 0.0; }));
}

/// The moments against rolling as well: they are parts of the solution.
TEST(LoadCertificate, PredictsTheImpulsesOfALoadThatItKnows) {
  const World world = quietCart();
  Inside inside(world);
  Collection& cart = inside.cart();
  bringBlocksBack(inside.setup.state, cart);
  for (const Witness& witness : cart.certificate.front().witnesses) {
    Witness load{witness.frame, witness.outer, {}};
    predictImpulses(inside.setup.state, cart, load);
    double largest = 0.0, moment = 0.0;
    for (std::size_t b = 0; b < cart.blocks.size(); ++b) {
      for (std::size_t r = 0; r < 4; ++r) {
        largest = std::max(largest, std::abs(witness.lambda[b][r]));
        EXPECT_NEAR(load.lambda[b][r], witness.lambda[b][r], 1e-3 * largest) << b << ", " << r;
      }
      if (cart.blocks[b].rolls()) moment = std::max(moment, std::abs(witness.lambda[b][3]));
    }
    EXPECT_GT(moment, 0.0);
  }
}

/// The load of a proof, times a factor. On a cart with springs nothing but the cart itself, the
/// heaviest member, is loaded from outside.
CollectionLoad timesTheLoadOf(const Witness& witness, double factor) {
  CollectionLoad load;
  load.frame = witness.frame;
  double square = 0.0;
  for (double& q : load.frame) {
    q *= factor;
    square += q * q;
  }
  load.norm = std::sqrt(square);
  return load;
}

TEST(LoadCertificate, WeightsStayWhileTheyCoverTheLoad) {
  const World world = quietCart();
  Inside inside(world);
  Collection& cart = inside.cart();
  LoadCertificate& proof = cart.certificate.front();
  const auto isCovered = [&](double factor) {
    proof.lambda_stale = false;
    const CollectionLoad load = timesTheLoadOf(proof.witnesses.front(), factor);
    const Coverage coverage = coverageOf(inside.setup.state, cart, load);
    if (coverage.carried.holds) carryBy(cart, coverage.weights);
    return coverage.carried.holds;
  };
  ASSERT_TRUE(isCovered(0.8));
  const LoadCertificate::Weights weights = proof.weights;
  EXPECT_TRUE(isCovered(0.8 * (1.0 + 0.5 * kDecided.left_over)));
  EXPECT_EQ(proof.weights, weights);
  EXPECT_FALSE(proof.lambda_stale) << "nothing is to be written";
  EXPECT_TRUE(isCovered(0.8 * (1.0 + 2.0 * kDecided.left_over)));
  EXPECT_NE(proof.weights, weights);
  EXPECT_TRUE(proof.lambda_stale);
  EXPECT_FALSE(isCovered(-0.8)) << "not in the cone of what was carried";
}

/// Brought back by a blow that comes later, the blocks are those that the straight run has.
TEST(LoadCertificate, AWorldSavedWhileTheBlocksAreAwayGoesOnWithTheSameBytes) {
  World straight = quietCart();
  ASSERT_TRUE(areBlocksAway(Inside(straight).cart()));
  World restored(straight.scene(), {.mode = Mode::Merge, .timings = false});
  restored.restore(straight.save(), "test");
  for (int step = 0; step < 200; ++step) {
    for (World* world : {&straight, &restored}) {
      if (step == 50) world->applyImpulse(idOf(*world, "cart"), {0.0, 0.0}, {30.0, 0.0});
      world->step();
    }
    if (step == 50) {
      ASSERT_FALSE(areBlocksAway(Inside(straight).cart()));
    }
    ASSERT_EQ(straight.save(), restored.save()) << "step " << step;
  }
}

}  // namespace
}  // namespace merge2d
