#pragma once
/// Box2D's dynamic tree of bounding boxes, behind the few calls that the broadphase needs.

#include <box2d/b2_dynamic_tree.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "src2d/geometry/box.h"

namespace merge2d {

/// Leaves hold a number and a fat box: the given one grown by 0.1 m, so that small motions cost
/// nothing. Box2D keeps the boxes in float; the fat margin covers the rounding up to 10^6 m.
class AabbTree {
 public:
  AabbTree() = default;
  AabbTree(const AabbTree&) = delete;
  AabbTree& operator=(const AabbTree&) = delete;

  int insert(const Aabb& box, std::uint32_t value) {
    grow();
    return tree_.CreateProxy(toB2(box), toUserData(value));
  }
  /// A leaf with this very fat box, which another tree's `fatBox` gave: a tree that is built anew
  /// answers as the old one did.
  int insertFat(const Aabb& fat, std::uint32_t value) {
    b2AABB box;
    b2Vec2 ahead(0.0F, 0.0F);
    shrink(static_cast<float>(fat.lower.x()), static_cast<float>(fat.upper.x()), box.lowerBound.x,
           box.upperBound.x, ahead.x);
    shrink(static_cast<float>(fat.lower.y()), static_cast<float>(fat.upper.y()), box.lowerBound.y,
           box.upperBound.y, ahead.y);
    // Moving a leaf from far away gives it just the box that `box` and `ahead` ask for.
    const b2Vec2 far(1e8F, 1e8F);
    grow();
    const int leaf = tree_.CreateProxy({far, far}, toUserData(value));
    tree_.MoveProxy(leaf, box, ahead);
    return leaf;
  }
  void remove(int leaf) {
    tree_.DestroyProxy(leaf);
    --leaves_;
  }

  /// True when the box left its fat box and the leaf was placed anew, with room ahead along
  /// `displacement` [m].
  bool move(int leaf, const Aabb& box, const Vec2& displacement) {
    return tree_.MoveProxy(leaf, toB2(box), toB2(displacement));
  }
  bool overlap(int leaf, int other) const {
    return b2TestOverlap(tree_.GetFatAABB(leaf), tree_.GetFatAABB(other));
  }
  Aabb fatBox(int leaf) const {
    const b2AABB& box = tree_.GetFatAABB(leaf);
    return {{box.lowerBound.x, box.lowerBound.y}, {box.upperBound.x, box.upperBound.y}};
  }

  /// Calls visit(value) for each leaf whose fat box meets `box`.
  template <class Visit>
  void query(const Aabb& box, Visit&& visit) const {
    Callback<Visit> callback{&tree_, &visit};
    tree_.Query(&callback, toB2(box));
  }
  template <class Visit>
  void queryLeaf(int leaf, Visit&& visit) const {
    Callback<Visit> callback{&tree_, &visit};
    tree_.Query(&callback, tree_.GetFatAABB(leaf));
  }

  /// Box2D keeps its nodes, twice as many as leaves, in an array that doubles from sixteen.
  std::size_t memoryBytes() const {
    const std::size_t nodes = 2 * most_leaves_;
    return std::bit_ceil(std::max<std::size_t>(nodes, 16)) * sizeof(b2TreeNode);
  }

  /// Holds a small part of the leaves that it once had.
  bool sparse() const { return most_leaves_ > 64 && 4 * leaves_ < most_leaves_; }
  void clear() {
    std::destroy_at(&tree_);
    std::construct_at(&tree_);
    leaves_ = most_leaves_ = 0;
  }

 private:
  void grow() { most_leaves_ = std::max(most_leaves_, ++leaves_); }

  /// Bounds that Box2D grows to [lower, upper] exactly. Growing rounds, so that not every number
  /// can be reached from one side; `ahead`, which only moves one bound outwards, gives the rest. As
  /// fat boxes are wider than twice their margin, at most one side needs it.
  static void shrink(float lower, float upper, float& from, float& to, float& ahead) {
    constexpr float kUp = std::numeric_limits<float>::infinity();
    from = lower + b2_aabbExtension;
    while (from - b2_aabbExtension > lower) from = std::nextafter(from, -kUp);
    while (from - b2_aabbExtension < lower) from = std::nextafter(from, kUp);
    to = upper - b2_aabbExtension;
    while (to + b2_aabbExtension < upper) to = std::nextafter(to, kUp);
    while (to + b2_aabbExtension > upper) to = std::nextafter(to, -kUp);
    const float below = lower - (from - b2_aabbExtension);  // at most 0
    const float above = upper - (to + b2_aabbExtension);    // at least 0
    ahead = (below < 0.0F ? below : above) / b2_aabbMultiplier;
  }

  template <class Visit>
  struct Callback {
    const b2DynamicTree* tree;
    Visit* visit;
    bool QueryCallback(int32 leaf) {
      (*visit)(toValue(tree->GetUserData(leaf)));
      return true;
    }
  };

  static b2Vec2 toB2(const Vec2& a) {
    return {static_cast<float>(a.x()), static_cast<float>(a.y())};
  }
  static b2AABB toB2(const Aabb& box) {
    b2AABB result;
    result.lowerBound = toB2(box.lower);
    result.upperBound = toB2(box.upper);
    return result;
  }
  static void* toUserData(std::uint32_t value) {
    return reinterpret_cast<void*>(static_cast<std::uintptr_t>(value));
  }
  static std::uint32_t toValue(void* data) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(data));
  }

  b2DynamicTree tree_;
  std::size_t leaves_ = 0, most_leaves_ = 0;
};

}  // namespace merge2d
