#pragma once
/// Rigid things that are parked: asleep, and in no list that a stage goes through.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src2d/core/memory.h"
#include "src2d/dynamics/rigid.h"

namespace merge2d {

/// Pairs of which at least one is parked, found by either.
template <class Pair>
class ParkedPairs {
 public:
  static constexpr RigidId kNobody{~0u};  ///< an end that never is parked

  bool empty() const { return size_ == 0; }
  std::size_t memoryBytes() const { return bytesOf(nodes_, free_, heads_); }

  void add(const Pair& pair, RigidId a, RigidId b) {
    ++size_;
    std::uint32_t node = 0;
    if (free_.empty()) {
      node = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
    } else {
      node = free_.back();
      free_.pop_back();
    }
    nodes_[node].pair = pair;
    nodes_[node].ends = {a, b};
    link(2 * node);
    link(2 * node + 1);
  }

  /// Takes out all pairs of `id` and calls `visit(pair, other)` for each: whom it is a pair with.
  template <class Visit>
  void take(RigidId id, Visit&& visit) {
    if (index(id) >= heads_.size()) return;
    while (heads_[index(id)] != kNone) {
      const std::uint32_t half = heads_[index(id)];
      unlink(half);
      unlink(half ^ 1);
      free_.push_back(half / 2);
      --size_;
      visit(nodes_[half / 2].pair, endOf(half ^ 1));
    }
    if (size_ > 0) return;
    std::vector<Node>().swap(nodes_);
    std::vector<std::uint32_t>().swap(free_);
    std::vector<std::uint32_t>().swap(heads_);
  }

  /// Calls `visit(pair)` for all of them.
  template <class Visit>
  void forEach(Visit&& visit) {
    visitAll(*this, visit);
  }
  template <class Visit>
  void forEach(Visit&& visit) const {
    visitAll(*this, visit);
  }

 private:
  /// A pair, in the lists of both its ends. Half 2i + k is that of end k of node i.
  struct Node {
    Pair pair{};
    std::array<RigidId, 2> ends{};
    std::array<std::uint32_t, 2> next{}, previous{};
  };

  template <class Self, class Visit>
  static void visitAll(Self& self, Visit& visit) {
    for (std::uint32_t i = 0; i < self.heads_.size(); ++i) {
      for (std::uint32_t half = self.heads_[i]; half != kNone; half = self.nextOf(half)) {
        const RigidId other = self.endOf(half ^ 1);
        if (other == kNobody || RigidId{i} < other) visit(self.nodes_[half / 2].pair);
      }
    }
  }

  RigidId endOf(std::uint32_t half) const { return nodes_[half / 2].ends[half % 2]; }
  std::uint32_t nextOf(std::uint32_t half) const { return nodes_[half / 2].next[half % 2]; }
  std::uint32_t& nextOf(std::uint32_t half) { return nodes_[half / 2].next[half % 2]; }
  std::uint32_t& previousOf(std::uint32_t half) { return nodes_[half / 2].previous[half % 2]; }

  void link(std::uint32_t half) {
    const RigidId id = endOf(half);
    if (id == kNobody) return;
    if (heads_.size() <= index(id)) heads_.resize(index(id) + 1, kNone);
    std::uint32_t& head = heads_[index(id)];
    nextOf(half) = head;
    previousOf(half) = kNone;
    if (head != kNone) previousOf(head) = half;
    head = half;
  }
  void unlink(std::uint32_t half) {
    const RigidId id = endOf(half);
    if (id == kNobody) return;
    const std::uint32_t next = nextOf(half), previous = previousOf(half);
    (previous == kNone ? heads_[index(id)] : nextOf(previous)) = next;
    if (next != kNone) previousOf(next) = previous;
  }

  std::size_t size_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> free_;   ///< nodes
  std::vector<std::uint32_t> heads_;  ///< per rigid: its first half
};

/// Which rigid things are parked; their pairs stand beside the lists that they were taken from.
/// contact/parking.h says when something becomes so, and when no more.
struct Parked {
  static constexpr std::uint8_t kHeld = 255;

  /// Per rigid, may be shorter: kHeld, or for how many steps it has slept, up to a limit.
  std::vector<std::uint8_t> slept;
  std::size_t count = 0;
  int bodies = 0, collections = 0;  ///< floating bodies, and members; collections

  bool holds(RigidId id) const { return index(id) < slept.size() && slept[index(id)] == kHeld; }
};

}  // namespace merge2d
