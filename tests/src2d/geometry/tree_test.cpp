#include "src2d/geometry/tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace merge2d {
namespace {

class RandomBoxes {
 public:
  double between(double least, double most) {
    return least + (most - least) * static_cast<double>(engine_()) / 4294967295.0;
  }
  Vec2 place() { return {between(0, 40), between(0, 40)}; }
  std::size_t below(std::size_t n) { return engine_() % n; }

 private:
  std::mt19937 engine_{7};
};

Aabb boxAt(const Vec2& place) { return {place - Vec2::Constant(0.5), place + Vec2::Constant(0.5)}; }

/// A tree and the leaves that it ought to hold; the value of a leaf is its place in this list, −1
/// stands for a leaf that has gone.
struct Checked {
  AabbTree tree;
  std::vector<int> leaves;

  void insert(const Vec2& at) {
    leaves.push_back(tree.insert(boxAt(at), static_cast<std::uint32_t>(leaves.size())));
  }
  void remove(std::size_t i) {
    if (leaves[i] >= 0) tree.remove(leaves[i]);
    leaves[i] = -1;
  }

  std::vector<std::uint32_t> askedAbout(const Aabb& box) const {
    std::vector<std::uint32_t> found;
    tree.query(box, [&](std::uint32_t value) { found.push_back(value); });
    std::ranges::sort(found);
    return found;
  }
  std::vector<std::uint32_t> lookedThroughFor(const Aabb& box) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
      if (leaves[i] >= 0 && tree.fatBox(leaves[i]).overlaps(box)) found.push_back(i);
    }
    return found;
  }

  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  Pairs pairs() const {
    Pairs found;
    tree.forEachPair([&](std::uint32_t a, std::uint32_t b) { found.push_back(std::minmax(a, b)); });
    std::ranges::sort(found);
    return found;
  }
  Pairs pairsOfAll() const {
    Pairs found;
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
      for (std::uint32_t j = i + 1; j < leaves.size(); ++j) {
        if (leaves[i] >= 0 && leaves[j] >= 0 && tree.overlap(leaves[i], leaves[j])) {
          found.emplace_back(i, j);
        }
      }
    }
    return found;
  }

  void expectTrue(RandomBoxes& random, const char* after) const {
    for (int i = 0; i < 20; ++i) {
      const Aabb box = boxAt(random.place()).grown(random.between(0, 3));
      EXPECT_EQ(askedAbout(box), lookedThroughFor(box)) << after;
    }
    EXPECT_EQ(pairs(), pairsOfAll()) << after;
  }
};

TEST(AabbTree, AnswersAsALookAtEveryLeafWhileLeavesComeGoAndMove) {
  RandomBoxes random;
  Checked checked;
  checked.expectTrue(random, "nothing");
  for (int i = 0; i < 200; ++i) checked.insert(random.place());
  checked.expectTrue(random, "coming");
  for (int round = 0; round < 30; ++round) {
    const std::size_t moves = round % 3 == 0 ? 200 : 5;  // nearly all, or a few
    for (std::size_t k = 0; k < moves; ++k) {
      const std::size_t i = random.below(checked.leaves.size());
      const Vec2 way(random.between(-1, 1), random.between(-1, 1));
      if (checked.leaves[i] >= 0) checked.tree.move(checked.leaves[i], boxAt(random.place()), way);
    }
    checked.tree.settle();
    checked.expectTrue(random, "moves");
    for (int k = 0; k < 4; ++k) checked.remove(random.below(checked.leaves.size()));
    for (int k = 0; k < 3; ++k) checked.insert(random.place());
    checked.expectTrue(random, "coming and going");
  }
  for (std::size_t i = 0; i < checked.leaves.size(); ++i) checked.remove(i);
  EXPECT_EQ(checked.tree.size(), 0u);
  checked.expectTrue(random, "all have gone");
}

TEST(AabbTree, StaysLowWhereLeavesComeInARow) {
  AabbTree tree;
  constexpr int kLeaves = 5000;
  for (int i = 0; i < kLeaves; ++i) tree.insert(boxAt({2.0 * i, 0.0}), 0);
  EXPECT_LE(tree.height(), 1.5 * std::log2(kLeaves) + 2.0);
}

TEST(AabbTree, StaysLowWhereAllLeavesMoveToOnePlace) {
  AabbTree tree;
  std::vector<int> leaves;
  for (int i = 0; i < 1000; ++i) leaves.push_back(tree.insert(boxAt({2.0 * i, 0.0}), 0));
  for (const int leaf : leaves) tree.move(leaf, boxAt({3.0, 1000.0}), Vec2::Zero());
  tree.settle();
  EXPECT_LE(tree.height(), 1.5 * std::log2(1000) + 2.0);
}

TEST(AabbTree, AFatBoxHasRoomAllAroundAndAhead) {
  AabbTree tree;
  const int leaf = tree.insert(boxAt({0, 0}), 0);
  EXPECT_TRUE(tree.fatBox(leaf).contains(boxAt({0, 0}).grown(0.0999)));
  EXPECT_TRUE(tree.move(leaf, boxAt({1, 0}), {0.05, 0.0}));
  const Aabb fat = tree.fatBox(leaf);
  EXPECT_NEAR(fat.lower.x(), 0.4, 1e-6);
  EXPECT_NEAR(fat.upper.x(), 1.6 + 4 * 0.05, 1e-6);
  EXPECT_NEAR(fat.lower.y(), -0.6, 1e-6);
  EXPECT_NEAR(fat.upper.y(), 0.6, 1e-6);
}

TEST(AabbTree, AFastLeafGetsNoLongBox) {
  AabbTree tree;
  const int leaf = tree.insert(boxAt({0, 0}), 0);
  tree.move(leaf, boxAt({1, 0}), {5.0, -5.0});
  EXPECT_NEAR(tree.fatBox(leaf).upper.x(), 1.6 + 0.4, 1e-6);
  EXPECT_NEAR(tree.fatBox(leaf).lower.y(), -0.6 - 0.4, 1e-6);
}

TEST(AabbTree, ALeafKeepsItsBoxUntilItsContentLeavesIt) {
  AabbTree tree;
  const int leaf = tree.insert(boxAt({0, 0}), 0);
  EXPECT_FALSE(tree.move(leaf, boxAt({0.09, -0.09}), {0.09, -0.09}));
  EXPECT_TRUE(tree.move(leaf, boxAt({0.11, 0.0}), {0.02, 0.0}));
}

TEST(AabbTree, ABoxThatIsMuchTooLargeShrinks) {
  AabbTree tree;
  const int leaf = tree.insert(boxAt({0, 0}), 0);
  tree.move(leaf, boxAt({1, 0}).grown(1.0), Vec2::Zero());
  EXPECT_TRUE(tree.move(leaf, boxAt({1, 0}), Vec2::Zero()));
  EXPECT_NEAR(tree.fatBox(leaf).upper.x(), 1.6, 1e-6);
}

TEST(AabbTree, ATreeOfTheSameFatBoxesAnswersTheSame) {
  RandomBoxes random;
  Checked checked;
  for (int i = 0; i < 100; ++i) checked.insert(random.place());
  AabbTree copy;
  for (const int leaf : checked.leaves) {
    const int same = copy.insertFat(checked.tree.fatBox(leaf), 0);
    EXPECT_EQ(copy.fatBox(same).lower, checked.tree.fatBox(leaf).lower);
    EXPECT_EQ(copy.fatBox(same).upper, checked.tree.fatBox(leaf).upper);
  }
}

}  // namespace
}  // namespace merge2d
