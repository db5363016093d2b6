#pragma once
/// All collections of a world, by slot.

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "src2d/core/memory.h"
#include "src2d/dynamics/collections.h"
#include "src2d/dynamics/sorted_list.h"

namespace merge2d {

/// Slots that stay in place; a free one has the id kNoCollection. A loop over the table visits all
/// but those that are parked (dynamics/parked.h).
class CollectionTable {
 public:
  std::size_t size() const { return slots_.size(); }
  bool empty() const { return slots_.empty(); }
  Collection& operator[](std::size_t slot) { return slots_[slot]; }
  const Collection& operator[](std::size_t slot) const { return slots_[slot]; }
  Collection& front() { return slots_.front(); }
  const Collection& front() const { return slots_.front(); }
  /// The slot of a collection of this table.
  std::size_t slotOf(const Collection& c) const {
    return static_cast<std::size_t>(&c - slots_.data());
  }

  /// Every slot, whether it is parked or not.
  const std::vector<Collection>& all() const { return slots_; }
  /// For whoever reads a saved state; `relist` must follow.
  std::vector<Collection>& all() { return slots_; }

  /// The slots that a loop visits, ascending.
  const std::vector<std::uint32_t>& active() const { return active_.ids(); }
  void setAside(std::size_t slot) { active_.erase(static_cast<std::uint32_t>(slot)); }
  void bringBack(std::size_t slot) { active_.insert(static_cast<std::uint32_t>(slot)); }

  /// One more slot at the end.
  void append() {
    bringBack(slots_.size());
    appendTightly(slots_);
  }
  void reserve(std::size_t slots) { reserveTightly(slots_, slots); }
  /// Drops the last `count` slots, which must not be parked.
  void dropLast(std::size_t count) {
    for (std::size_t i = slots_.size() - count; i < slots_.size(); ++i) setAside(i);
    slots_.resize(slots_.size() - count);
    if (slots_.capacity() - slots_.size() > slots_.size() / 32) slots_.shrink_to_fit();
  }
  /// All slots are there anew, and none of them is parked.
  void relist() {
    active_ = {};
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) bringBack(slot);
  }

  template <class Slot>
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Collection;
    using difference_type = std::ptrdiff_t;
    using pointer = Slot*;
    using reference = Slot&;

    Iterator() = default;
    Iterator(Slot* slots, const std::uint32_t* at) : slots_(slots), at_(at) {}
    Slot& operator*() const { return slots_[*at_]; }
    Slot* operator->() const { return slots_ + *at_; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++at_;
      return before;
    }
    bool operator==(const Iterator& o) const { return at_ == o.at_; }

   private:
    Slot* slots_ = nullptr;
    const std::uint32_t* at_ = nullptr;
  };
  auto begin() { return Iterator<Collection>(slots_.data(), active().data()); }
  auto end() { return Iterator<Collection>(slots_.data(), active().data() + active().size()); }
  auto begin() const { return Iterator<const Collection>(slots_.data(), active().data()); }
  auto end() const {
    return Iterator<const Collection>(slots_.data(), active().data() + active().size());
  }

  std::size_t memoryBytes() const { return bytesOf(slots_) + active_.memoryBytes(); }

 private:
  std::vector<Collection> slots_;
  SortedList<std::uint32_t> active_;
};

}  // namespace merge2d
