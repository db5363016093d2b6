#pragma once
/// A sorted list whose changes are applied together.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace merge2d {

/// Ascending ids. A step may insert and erase thousands, and looks at the list only before and
/// afterwards: changes are noted, and applied at the next look, in time linear in both.
template <class Id>
class SortedList {
 public:
  /// `id` must not be in the list.
  void insert(Id id) { changes_.push_back(id); }
  /// `id` must be in the list.
  void erase(Id id) { changes_.push_back(id); }

  /// The list itself, up to date.
  const std::vector<Id>& ids() const {
    if (!changes_.empty()) apply();
    return ids_;
  }
  std::vector<Id>& ids() {
    if (!changes_.empty()) apply();
    return ids_;
  }

  auto begin() const { return ids().begin(); }
  auto end() const { return ids().end(); }
  std::size_t size() const { return ids().size(); }
  Id operator[](std::size_t i) const { return ids()[i]; }
  std::size_t memoryBytes() const { return (ids_.capacity() + changes_.capacity()) * sizeof(Id); }

 private:
  void apply() const {
    constexpr std::size_t kFew = 8;
    if (changes_.size() <= kFew) {
      for (const Id id : changes_) toggle(id);
    } else {
      toggleAll();
    }
    changes_.clear();
    if (changes_.capacity() > kFew) changes_.shrink_to_fit();
  }

  void toggle(Id id) const {
    const auto at = std::lower_bound(ids_.begin(), ids_.end(), id);
    if (at != ids_.end() && *at == id) {
      ids_.erase(at);
    } else {
      ids_.insert(at, id);
    }
  }

  /// Of an id that was changed several times the last state counts: an even number leaves it as is.
  void toggleAll() const {
    std::sort(changes_.begin(), changes_.end());
    std::vector<Id> odd;
    for (auto first = changes_.begin(); first != changes_.end();) {
      const auto last = std::upper_bound(first, changes_.end(), *first);
      if ((last - first) % 2 != 0) odd.push_back(*first);
      first = last;
    }
    std::vector<Id> now;
    now.reserve(std::max(ids_.capacity(), ids_.size() + odd.size()));
    std::set_symmetric_difference(ids_.begin(), ids_.end(), odd.begin(), odd.end(),
                                  std::back_inserter(now));
    ids_ = std::move(now);
  }

  mutable std::vector<Id> ids_;
  mutable std::vector<Id> changes_;  ///< each inserts its id, or erases it
};

}  // namespace merge2d
