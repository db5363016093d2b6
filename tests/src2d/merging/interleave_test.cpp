/// The order in which many sweeps take their items.

#include "src2d/merging/interleave.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "src2d/merging/refine.h"

namespace merge2d {
namespace {

constexpr std::uint32_t kBodies = 40, kFloor = kBodies;  // the floor does not respond

/// Contacts of a heap: of random pairs, every fifth with the floor, body after body, as a walk
/// meets them.
class Interleave : public testing::Test {
 protected:
  Interleave() : u_(kBodies + 1) {
    std::mt19937 random(3);
    for (std::uint32_t b = 0; b < kBodies; ++b) {
      u_[b] = {.vx = 0.1 * b, .vy = -0.2 * (b % 7), .omega = 0.3 * (b % 3)};
      u_[b].inv_mass = 1.0 + b % 4;
      u_[b].inv_inertia = 5.0;
    }
    for (std::uint32_t b = 0; b < kBodies; ++b) {
      for (int i = 0; i < 4; ++i)
        add(random, b, blocks_.size() % 5 == 0 ? kFloor : otherThan(b, random));
    }
    for (ContactBlock& k : blocks_) items_.emplace_back(k);
  }

  static std::uint32_t place(std::uint32_t body) {
    return body == kFloor ? Interleaving::kFixed : body;
  }
  static bool share(const SweepItem& p, const SweepItem& q) {
    for (const std::uint32_t b : {p.a(), p.b()}) {
      if (b != kFloor && (b == q.a() || b == q.b())) return true;
    }
    return false;
  }
  static std::size_t neighboursThatShare(std::span<const SweepItem> items) {
    std::size_t count = 0;
    for (std::size_t i = 1; i < items.size(); ++i) count += share(items[i - 1], items[i]) ? 1 : 0;
    return count;
  }

  std::vector<SolverVelocity> u_;
  std::vector<ContactBlock> blocks_;
  std::vector<SweepItem> items_;

 private:
  static std::uint32_t otherThan(std::uint32_t b, std::mt19937& random) {
    return (b + 1 + static_cast<std::uint32_t>(random() % (kBodies - 1))) % kBodies;
  }

  void add(std::mt19937& random, std::uint32_t a, std::uint32_t b) {
    const double angle = 0.01 * static_cast<double>(random() % 628);
    BlockGeometry at{.normal = {std::cos(angle), std::sin(angle)}, .count = 2};
    const Vec2 side = perpendicular(at.normal);
    for (int i = 0; i < 2; ++i) {
      at.arm_a[i] = 0.5 * at.normal + (i - 0.4) * side;
      at.arm_b[i] = -0.5 * at.normal + (i - 0.6) * side;
    }
    ContactBlock k;
    k.a = a;
    k.b = b;
    k.mu = 0.5;
    prepareBlock(k, at, u_[a], u_[b]);
    blocks_.push_back(k);
  }
};

TEST_F(Interleave, ChangesNoNumber) {
  auto as_given = u_, in_turns = u_;
  const auto before = blocks_;
  Interleaving interleaving;
  const auto sweep = [](std::span<const SweepItem> items, std::vector<SolverVelocity>& u) {
    for (int s = 0; s < 5; ++s) {
      for (const SweepItem& item : items) sweepItem(item, u, SolverMethod::Nncg);
    }
  };
  sweep(items_, as_given);
  std::vector<Impulses> impulses;
  for (const SweepItem& item : items_) impulses.push_back(item.impulses());
  std::copy(before.begin(), before.end(), blocks_.begin());
  sweep(interleaving.of(items_, kBodies, place), in_turns);
  for (std::size_t i = 0; i < items_.size(); ++i) EXPECT_EQ(items_[i].impulses(), impulses[i]);
  for (std::size_t b = 0; b < u_.size(); ++b) {
    EXPECT_EQ(as_given[b].vx, in_turns[b].vx);
    EXPECT_EQ(as_given[b].vy, in_turns[b].vy);
    EXPECT_EQ(as_given[b].omega, in_turns[b].omega);
  }
  EXPECT_NE(as_given[0].vx, u_[0].vx);
}

TEST_F(Interleave, PutsApartWhatSharesABody) {
  Interleaving interleaving;
  const auto in_turns = interleaving.of(items_, kBodies, place);
  ASSERT_EQ(in_turns.size(), items_.size());
  EXPECT_GT(neighboursThatShare(items_), items_.size() / 2);
  EXPECT_LT(neighboursThatShare(in_turns), items_.size() / 8);
}

TEST_F(Interleave, LetsWhatDoesNotRespondBeShared) {
  std::vector<SweepItem> on_floor;
  for (std::uint32_t i = 0; i < kBodies; ++i) {
    blocks_[i].a = i;
    blocks_[i].b = kFloor;
    on_floor.emplace_back(blocks_[i]);
  }
  Interleaving interleaving;
  const auto in_turns = interleaving.of(on_floor, kBodies, place);
  for (std::size_t i = 0; i < on_floor.size(); ++i) EXPECT_EQ(in_turns[i].block, on_floor[i].block);
}

TEST_F(Interleave, OfNothingIsNothing) {
  Interleaving interleaving;
  EXPECT_TRUE(interleaving.of({}, kBodies, place).empty());
}

}  // namespace
}  // namespace merge2d
