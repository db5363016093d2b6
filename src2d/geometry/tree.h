#pragma once
/// A tree of bounding boxes, for what is near what.
///
/// A binary tree of boxes around boxes, balanced by rotations as in Box2D 2.4 (b2_dynamic_tree.h,
/// after N. Presson's btDbvt): a leaf enters beside the box that grows least. Deviations: leaves
/// that have left their boxes are collected, and where they are many the boxes above all leaves are
/// made anew in one pass instead; and all pairs of leaves that meet are found by one descent of the
/// tree against itself. Answers depend on the leaves' boxes alone, not on the shape of the tree.
/// Guarded by tests/src2d/geometry/tree_test.cpp.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src2d/geometry/box.h"

namespace merge2d {

/// Leaves hold a number and a fat box: the given one grown by 0.1 m, so that small motions cost
/// nothing. Boxes are kept in float; the fat margin covers the rounding up to 10^6 m.
class AabbTree {
 public:
  int insert(const Aabb& box, std::uint32_t value);
  /// A leaf with this very fat box, which another tree's `fatBox` gave: a tree that is built anew
  /// answers as the old one did.
  int insertFat(const Aabb& fat, std::uint32_t value);
  void remove(int leaf);

  /// True when the box left its fat box, or the fat box is too large for it: the leaf gets a new
  /// one with room ahead along `displacement` [m]. `settle` must follow before anything is asked.
  bool move(int leaf, const Aabb& box, const Vec2& displacement);
  void settle();

  bool overlap(int leaf, int other) const { return meet(boxOf(~leaf), boxOf(~other)); }
  Aabb fatBox(int leaf) const;

  /// Calls visit(value) for each leaf whose fat box meets `box`.
  template <class Visit>
  void query(const Aabb& box, Visit&& visit) const {
    query(toFloats(box), visit);
  }
  template <class Visit>
  void queryLeaf(int leaf, Visit&& visit) const {
    query(boxOf(~leaf), visit);
  }
  /// Calls visit(value, value) once for each two leaves whose fat boxes meet.
  template <class Visit>
  void forEachPair(Visit&& visit) const {
    if (root_ >= 0) pairsWithin(root_, visit);
  }

  std::size_t size() const { return leaf_count_; }
  /// Boxes from the root to the deepest leaf.
  int height() const { return root_ == kNoNode ? 0 : heightOf(root_) + 1; }
  std::size_t memoryBytes() const;

  /// Holds a small part of the leaves that it once had.
  bool sparse() const { return leaves_.size() > 64 && 4 * leaf_count_ < leaves_.size(); }
  void clear() { *this = {}; }

 private:
  /// A node or a leaf: its place in nodes_, or the complement of that in leaves_.
  using Ref = std::int32_t;
  static constexpr Ref kNoNode = -2147483647 - 1;

  struct Box {
    float lower_x = 0.0F, lower_y = 0.0F, upper_x = 0.0F, upper_y = 0.0F;
  };
  struct Leaf {
    Box box;
    Ref parent = kNoNode;  ///< kNoNode: the root; of a leaf that is not in use, the next such one
    std::uint32_t value = 0;
  };
  struct Node {
    Box box;
    std::array<Ref, 2> child{kNoNode, kNoNode};
    Ref parent = kNoNode;  ///< as in Leaf
    std::int32_t height = 1;
  };

  /// Perimeters of all boxes [m].
  struct Cost {
    double nodes = 0.0, leaves = 0.0;
  };

  static bool meet(const Box& a, const Box& b) {
    return (static_cast<int>(a.lower_x <= b.upper_x) & static_cast<int>(b.lower_x <= a.upper_x) &
            static_cast<int>(a.lower_y <= b.upper_y) & static_cast<int>(b.lower_y <= a.upper_y)) !=
           0;
  }
  static Box toFloats(const Aabb& box);
  static Box around(const Box& a, const Box& b);
  static bool contains(const Box& outer, const Box& inner);
  static float perimeter(const Box& box);
  static Vec2 middleOf(const Box& box);

  static std::size_t leafPlace(Ref ref) {
    const Ref place = ~ref;
    return static_cast<std::size_t>(place);
  }
  Leaf& leaf(Ref ref) { return leaves_[leafPlace(ref)]; }
  const Leaf& leaf(Ref ref) const { return leaves_[leafPlace(ref)]; }
  Node& node(Ref ref) { return nodes_[static_cast<std::size_t>(ref)]; }
  const Node& node(Ref ref) const { return nodes_[static_cast<std::size_t>(ref)]; }
  const Box& boxOf(Ref ref) const { return ref < 0 ? leaf(ref).box : node(ref).box; }
  int heightOf(Ref ref) const { return ref < 0 ? 0 : node(ref).height; }
  Ref& parentOf(Ref ref) { return ref < 0 ? leaf(ref).parent : node(ref).parent; }

  Ref newLeaf(const Box& box, std::uint32_t value);
  Ref newNode();
  void freeNode(Ref ref);
  void replaceChild(Ref parent, Ref child, Ref by);
  Ref bestSibling(const Box& box) const;
  void link(Ref ref);
  void unlink(Ref ref);
  void climb(Ref ref);
  void refresh(Node& of) const;
  Ref balanced(Ref ref);
  void fit(Ref ref, Cost& cost);
  void refit();
  void rebuild();
  Ref build(std::vector<Ref>& order, std::size_t begin, std::size_t end);

  template <class Visit>
  void query(const Box& box, Visit& visit) const {
    if (root_ == kNoNode) return;
    std::array<Ref, kMostWaiting> waiting;
    std::size_t count = 0;
    waiting[count++] = root_;
    while (count > 0) {
      const Ref ref = waiting[--count];
      if (!meet(boxOf(ref), box)) continue;
      if (ref < 0) {
        visit(leaf(ref).value);
      } else {
        waiting[count++] = node(ref).child[0];
        waiting[count++] = node(ref).child[1];
      }
    }
  }

  template <class Visit>
  void pairsWithin(Ref ref, Visit& visit) const {
    const auto [a, b] = node(ref).child;
    if (a >= 0) pairsWithin(a, visit);
    if (b >= 0) pairsWithin(b, visit);
    pairsBetween(a, b, visit);
  }
  template <class Visit>
  void pairsBetween(Ref a, Ref b, Visit& visit) const {
    if (!meet(boxOf(a), boxOf(b))) return;
    if (heightOf(a) < heightOf(b)) std::swap(a, b);
    if (a < 0) return visit(leaf(a).value, leaf(b).value);
    pairsBetween(node(a).child[0], b, visit);
    pairsBetween(node(a).child[1], b, visit);
  }

  /// A balanced tree of as many nodes as there are numbers is less high.
  static constexpr std::size_t kMostWaiting = 64;

  std::vector<Leaf> leaves_;
  std::vector<Node> nodes_;
  std::vector<Ref> moved_;  ///< leaves with new boxes, before `settle`
  std::size_t leaf_count_ = 0;
  Ref root_ = kNoNode;
  Ref free_leaf_ = kNoNode, free_node_ = kNoNode;
  double built_cost_ = 0.0;  ///< perimeters of the nodes per leaf's when it was last built at once
};

}  // namespace merge2d
