/// What a collection keeps of its layout when members and contacts come and go.

#include <algorithm>
#include <tuple>

#include "src2d/collections/collection.h"
#include "src2d/state_file.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// Boxes that fall on a heap.
const std::string kRain = kGround + R"(
[[emitter]]
name = "rain"
at = [0, 6]
spread = [1.5, 0.5]
every = 0.1
count = 60
angle = 20
spin = 30
box = [0.5, 0.4]
)";

bool same(const ContactBlock& x, const ContactBlock& y) {
  const auto numbers = [](const ContactBlock& k) {
    return std::tuple(k.a, k.b, k.count, k.bilateral, k.nx, k.ny, k.k11, k.k12, k.k22, k.inv_det,
                      k.softness, k.mu);
  };
  return numbers(x) == numbers(y) && x.lambda == y.lambda && std::ranges::equal(x.bias, y.bias) &&
         std::ranges::equal(x.arm_an, y.arm_an) && std::ranges::equal(x.arm_bn, y.arm_bn) &&
         std::ranges::equal(x.arm_at, y.arm_at) && std::ranges::equal(x.arm_bt, y.arm_bt) &&
         std::ranges::equal(x.inv_kt, y.inv_kt);
}

/// As if nothing were known of how the collection was laid out.
void layOutFromNothing(State& state) {
  for (Collection& c : state.collections) {
    for (InternalContact& inner : c.contacts) dropBlock(c, inner);
    c.welds.clear();
    c.block_contact.clear();
    c.laid_out = {};
    c.stale = true;
  }
  layOutCollections(state);
}

/// Otherwise later contacts stand behind the others (growth_test.cpp).
bool isInOrder(const Collection& c) { return c.laid_out.sorted_welds == c.welds.size(); }

/// A contact that carried nothing when its collection was laid out, and carries a force since:
/// single sweeps take it in when the collection is laid out the next time.
bool hasWoken(const Collection& c) {
  if (!isInOrder(c)) return false;
  for (std::uint32_t i = c.laid_out.active_blocks; i < c.blocks.size(); ++i) {
    const InternalContact& inner = c.contacts[c.block_contact[i]];
    if (inner.watch[0].active || inner.watch[1].active) return true;
  }
  return false;
}

/// The same contacts with the same rows, in whatever order.
void expectTheSamePairs(const Collection& kept, const Collection& fresh, int step) {
  ASSERT_EQ(kept.contacts.size(), fresh.contacts.size()) << step;
  for (const InternalContact& inner : kept.contacts) {
    const auto at = std::ranges::lower_bound(fresh.contacts, inner.key, {}, &InternalContact::key);
    ASSERT_TRUE(at != fresh.contacts.end() && at->key == inner.key) << step;
    if (!areBlocksAway(kept)) {
      EXPECT_TRUE(same(kept.blocks[inner.block], fresh.blocks[at->block])) << "step " << step;
    }
    const Weld &one = kept.welds[inner.weld], &other = fresh.welds[at->weld];
    EXPECT_EQ(std::tuple(one.a, one.b, one.count, one.joints, one.expected),
              std::tuple(other.a, other.b, other.count, other.joints, other.expected));
    EXPECT_LT(&inner - kept.contacts.data() - one.first, one.count) << "a weld has its own";
  }
  ASSERT_EQ(kept.welds.size(), fresh.welds.size()) << step;
}

void expectTheSameLayout(const Collection& kept, const Collection& fresh, int step) {
  if (!isInOrder(kept)) return expectTheSamePairs(kept, fresh, step);
  ASSERT_EQ(kept.block_contact, fresh.block_contact) << step;
  EXPECT_EQ(kept.laid_out.active_blocks, fresh.laid_out.active_blocks) << step;
  for (std::size_t i = 0; i < kept.blocks.size(); ++i) {
    EXPECT_TRUE(same(kept.blocks[i], fresh.blocks[i])) << "block " << i << ", step " << step;
  }
  ASSERT_EQ(kept.welds.size(), fresh.welds.size()) << step;
}

/// After a step of the rain: each collection, as it was kept and as it would be made anew.
template <class Visit>
void forEachCollection(World& world, Visit&& visit) {
  merge2d::Setup kept, fresh;
  for (merge2d::Setup* setup : {&kept, &fresh}) {
    setUp(world.scene(), Mode::Merge, *setup);
    restoreState(world.save(), "world", world.scene(), *setup);
  }
  layOutFromNothing(fresh.state);
  for (std::size_t slot = 0; slot < kept.state.collections.size(); ++slot) {
    if (kept.state.collections[slot].id == kNoCollection) continue;
    visit(kept.state.collections[slot], fresh.state.collections[slot]);
  }
}

TEST(Layout, WhatIsKeptIsWhatWouldBeMadeAnew) {
  World world(parseScene(kRain, "rain.toml"), {.mode = Mode::Merge, .timings = false});
  int compared = 0, in_order = 0;
  for (int step = 0; step < 1500; ++step) {
    world.step();
    const bool changed = std::ranges::any_of(world.events(), [](const Event& e) {
      return e.type == EventType::Merge || e.type == EventType::Unmerge;
    });
    if (!changed) continue;
    forEachCollection(world, [&](const Collection& kept, const Collection& fresh) {
      expectTheSameLayout(kept, fresh, step);
      ++compared;
      in_order += isInOrder(kept) ? 1 : 0;
    });
  }
  EXPECT_GT(compared, 300);
  EXPECT_GT(in_order, compared / 2) << "and in the same order";
}

TEST(Layout, IsKeptInEachStepWhereNothingHasWoken) {
  World world(parseScene(kRain, "rain.toml"), {.mode = Mode::Merge, .timings = false});
  int compared = 0, woken = 0;
  for (int step = 0; step < 2000; ++step) {
    world.step();
    forEachCollection(world, [&](const Collection& kept, const Collection& fresh) {
      if (!hasWoken(kept)) expectTheSameLayout(kept, fresh, step);
      ++(hasWoken(kept) ? woken : compared);
    });
  }
  EXPECT_GT(compared, 3000);
  EXPECT_LT(woken, 30);
}

TEST(Layout, BlocksThatWerePutAwayComeBackAsTheyWere) {
  World world(parseScene(kRain, "rain.toml"), {.mode = Mode::Merge, .timings = false});
  int compared = 0;
  for (int step = 0; step < 1000; ++step) {
    world.step();
    if (step % 50 != 0) continue;
    merge2d::Setup setup;
    setUp(world.scene(), Mode::Merge, setup);
    restoreState(world.save(), "world", world.scene(), setup);
    for (Collection& c : setup.state.collections) {
      if (c.id == kNoCollection || c.blocks.empty()) continue;
      const std::vector<ContactBlock> before = c.blocks;
      putBlocksAway(c);
      EXPECT_TRUE(areBlocksAway(c));
      bringBlocksBack(setup.state, c);
      ASSERT_EQ(c.blocks.size(), before.size()) << step;
      for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_TRUE(same(c.blocks[i], before[i])) << "block " << i << ", step " << step;
        EXPECT_EQ(c.contacts[c.block_contact[i]].block, i) << step;
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

}  // namespace
}  // namespace merge2d
