#include "src2d/geometry/tree.h"

#include "src2d/core/memory.h"

namespace merge2d {
namespace {

/// By how much a fat box is larger than the given one on each side [m].
constexpr float kRoom = 0.1F;
/// The room ahead, in displacements …
constexpr float kAhead = 4.0F;
/// … and at most [m]: faster leaves leave their boxes at once, and a long box meets many others.
constexpr float kFarthestAhead = 4.0F * kRoom;
/// A fat box that is larger than a new one would be by more than this on any side is too large [m].
constexpr float kTooMuch = 4.0F * kRoom;
/// Where at least one leaf of so many has moved, all boxes are made anew …
constexpr std::size_t kMany = 16;
/// … and the whole tree, once its boxes have grown by this factor beside the leaves' since it was
/// built.
constexpr double kWorn = 1.3;

}  // namespace

AabbTree::Box AabbTree::toFloats(const Aabb& box) {
  return {static_cast<float>(box.lower.x()), static_cast<float>(box.lower.y()),
          static_cast<float>(box.upper.x()), static_cast<float>(box.upper.y())};
}

AabbTree::Box AabbTree::around(const Box& a, const Box& b) {
  return {std::min(a.lower_x, b.lower_x), std::min(a.lower_y, b.lower_y),
          std::max(a.upper_x, b.upper_x), std::max(a.upper_y, b.upper_y)};
}

bool AabbTree::contains(const Box& outer, const Box& inner) {
  return outer.lower_x <= inner.lower_x && outer.lower_y <= inner.lower_y &&
         inner.upper_x <= outer.upper_x && inner.upper_y <= outer.upper_y;
}

float AabbTree::perimeter(const Box& box) {
  return 2.0F * ((box.upper_x - box.lower_x) + (box.upper_y - box.lower_y));
}

/// Twice the middle, for comparisons.
Vec2 AabbTree::middleOf(const Box& box) {
  return {box.lower_x + box.upper_x, box.lower_y + box.upper_y};
}

namespace {

template <class Box>
Box grown(const Box& box, float by) {
  return {box.lower_x - by, box.lower_y - by, box.upper_x + by, box.upper_y + by};
}

float roomAhead(double displacement) {
  return std::clamp(kAhead * static_cast<float>(displacement), -kFarthestAhead, kFarthestAhead);
}

}  // namespace

// Leaves

int AabbTree::insert(const Aabb& box, std::uint32_t value) {
  const Ref ref = newLeaf(grown(toFloats(box), kRoom), value);
  link(ref);
  return ~ref;
}

int AabbTree::insertFat(const Aabb& fat, std::uint32_t value) {
  const Ref ref = newLeaf(toFloats(fat), value);
  link(ref);
  return ~ref;
}

void AabbTree::remove(int leaf_index) {
  const Ref ref = ~leaf_index;
  unlink(ref);
  leaf(ref).parent = free_leaf_;
  free_leaf_ = ref;
  --leaf_count_;
}

bool AabbTree::move(int leaf_index, const Aabb& box, const Vec2& displacement) {
  const Box tight = toFloats(box);
  Box fat = grown(tight, kRoom);
  const float ahead_x = roomAhead(displacement.x()), ahead_y = roomAhead(displacement.y());
  (ahead_x < 0.0F ? fat.lower_x : fat.upper_x) += ahead_x;
  (ahead_y < 0.0F ? fat.lower_y : fat.upper_y) += ahead_y;
  Box& now = leaves_[static_cast<std::size_t>(leaf_index)].box;
  if (contains(now, tight) && contains(grown(fat, kTooMuch), now)) return false;
  now = fat;
  appendTightly(moved_);
  moved_.back() = ~leaf_index;
  return true;
}

void AabbTree::settle() {
  if (kMany * moved_.size() < leaf_count_) {
    for (const Ref ref : moved_) {
      unlink(ref);
      link(ref);
    }
  } else if (!moved_.empty()) {
    refit();
  }
  moved_.clear();
}

Aabb AabbTree::fatBox(int leaf_index) const {
  const Box& box = boxOf(~leaf_index);
  return {{box.lower_x, box.lower_y}, {box.upper_x, box.upper_y}};
}

std::size_t AabbTree::memoryBytes() const { return bytesOf(leaves_, nodes_, moved_); }

// The tree

AabbTree::Ref AabbTree::newLeaf(const Box& box, std::uint32_t value) {
  Ref ref = free_leaf_;
  if (ref == kNoNode) {
    appendTightly(leaves_);
    ref = ~static_cast<Ref>(leaves_.size() - 1);
  } else {
    free_leaf_ = leaf(ref).parent;
  }
  leaf(ref) = {box, kNoNode, value};
  ++leaf_count_;
  return ref;
}

AabbTree::Ref AabbTree::newNode() {
  const Ref ref = free_node_;
  if (ref == kNoNode) {
    appendTightly(nodes_);
    return static_cast<Ref>(nodes_.size() - 1);
  }
  free_node_ = node(ref).parent;
  return ref;
}

void AabbTree::freeNode(Ref ref) {
  node(ref).parent = free_node_;
  free_node_ = ref;
}

void AabbTree::replaceChild(Ref parent, Ref child, Ref by) {
  parentOf(by) = parent;
  if (parent == kNoNode) {
    root_ = by;
  } else {
    auto& children = node(parent).child;
    (children[0] == child ? children[0] : children[1]) = by;
  }
}

/// The node or leaf beside which `box` makes the boxes grow least: to put it here costs the box
/// around both, to go on costs what this box and the next one grow by.
AabbTree::Ref AabbTree::bestSibling(const Box& box) const {
  Ref ref = root_;
  while (ref >= 0) {
    const float here = perimeter(around(boxOf(ref), box));
    const float passed = here - perimeter(boxOf(ref));
    const auto costOf = [&](Ref child) {
      const float both = perimeter(around(boxOf(child), box));
      return passed + (child < 0 ? both : both - perimeter(boxOf(child)));
    };
    const auto [a, b] = node(ref).child;
    const float cost_a = costOf(a), cost_b = costOf(b);
    if (here < cost_a && here < cost_b) break;
    ref = cost_a < cost_b ? a : b;
  }
  return ref;
}

/// Puts a leaf into the tree, or takes it out.
void AabbTree::link(Ref ref) {
  if (root_ == kNoNode) {
    root_ = ref;
    return;
  }
  const Ref sibling = bestSibling(leaf(ref).box);
  const Ref parent = parentOf(sibling), between = newNode();
  node(between).child = {sibling, ref};
  replaceChild(parent, sibling, between);
  parentOf(sibling) = parentOf(ref) = between;
  climb(between);
}

void AabbTree::unlink(Ref ref) {
  const Ref parent = leaf(ref).parent;
  leaf(ref).parent = kNoNode;
  if (parent == kNoNode) {
    root_ = kNoNode;
    return;
  }
  const auto [a, b] = node(parent).child;
  const Ref above = node(parent).parent;
  replaceChild(above, parent, a == ref ? b : a);
  freeNode(parent);
  climb(above);
}

/// Brings boxes and heights up to date from a node to the root.
void AabbTree::climb(Ref ref) {
  while (ref != kNoNode) {
    ref = balanced(ref);
    refresh(node(ref));
    ref = node(ref).parent;
  }
}

void AabbTree::refresh(Node& of) const {
  of.box = around(boxOf(of.child[0]), boxOf(of.child[1]));
  of.height = 1 + std::max(heightOf(of.child[0]), heightOf(of.child[1]));
}

/// Where one child of `ref` is higher than the other by two, it takes its parent's place and gives
/// it the lower one of its own children: n(s, t(low, high)) becomes t(n(s, low), high). Returns
/// what stands in the place of `ref` then.
AabbTree::Ref AabbTree::balanced(Ref ref) {
  Node& n = node(ref);
  const int lean = heightOf(n.child[1]) - heightOf(n.child[0]);
  if (lean >= -1 && lean <= 1) return ref;
  Ref& slot = n.child[lean > 0 ? 1 : 0];
  const Ref top = slot;
  Node& t = node(top);
  const bool first_is_high = heightOf(t.child[0]) > heightOf(t.child[1]);
  const Ref high = t.child[first_is_high ? 0 : 1], low = t.child[first_is_high ? 1 : 0];
  replaceChild(n.parent, ref, top);
  slot = low;
  parentOf(low) = ref;
  t.child = {ref, high};
  n.parent = top;
  refresh(n);
  return top;
}

/// Fits the boxes of all nodes below `ref` to those of the leaves; adds up their perimeters.
void AabbTree::fit(Ref ref, Cost& cost) {
  if (ref < 0) {
    cost.leaves += perimeter(leaf(ref).box);
    return;
  }
  Node& n = node(ref);
  for (const Ref child : n.child) fit(child, cost);
  n.box = around(boxOf(n.child[0]), boxOf(n.child[1]));
  cost.nodes += perimeter(n.box);
}

/// The same for the whole tree, which is built anew when it is worn.
void AabbTree::refit() {
  Cost cost;
  fit(root_, cost);
  if (cost.nodes <= kWorn * built_cost_ * cost.leaves) return;
  rebuild();
  Cost built;
  fit(root_, built);
  built_cost_ = built.nodes / built.leaves;
}

/// Builds the tree anew from the middles of the leaves, its nodes in the order of a descent.
void AabbTree::rebuild() {
  std::vector<Ref> order;
  order.reserve(leaf_count_);
  const auto list = [&](const auto& self, Ref ref) -> void {
    if (ref < 0) return order.push_back(ref);
    for (const Ref child : node(ref).child) self(self, child);
  };
  list(list, root_);
  nodes_.clear();
  free_node_ = kNoNode;
  root_ = build(order, 0, order.size());
  parentOf(root_) = kNoNode;
}

AabbTree::Ref AabbTree::build(std::vector<Ref>& order, std::size_t begin, std::size_t end) {
  if (end - begin == 1) return order[begin];
  Vec2 least = middleOf(leaf(order[begin]).box), most = least;
  for (std::size_t i = begin; i < end; ++i) {
    const Vec2 middle = middleOf(leaf(order[i]).box);
    least = least.cwiseMin(middle);
    most = most.cwiseMax(middle);
  }
  const int axis = most.x() - least.x() < most.y() - least.y() ? 1 : 0;
  const std::size_t half = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end), [&](Ref a, Ref b) {
    return middleOf(leaf(a).box)[axis] < middleOf(leaf(b).box)[axis];
  });
  const Ref ref = newNode();
  const Ref a = build(order, begin, half), b = build(order, half, end);
  Node& n = node(ref);
  n.child = {a, b};
  parentOf(a) = parentOf(b) = ref;
  refresh(n);
  return ref;
}

}  // namespace merge2d
