#pragma once
/// The rigid things that are simulated: a sorted list whose changes are applied together.

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "src2d/dynamics/rigid.h"

namespace merge2d {

/// Ascending ids. A step may insert and erase thousands, and looks at the list only before and
/// afterwards: changes are noted, and applied at the next look, in time linear in both.
class PresentList {
 public:
  /// `id` must not be in the list.
  void insert(RigidId id) { changes_.push_back(id); }
  /// `id` must be in the list.
  void erase(RigidId id) { changes_.push_back(id); }

  /// The list itself, up to date.
  const std::vector<RigidId>& ids() const {
    if (!changes_.empty()) apply();
    return ids_;
  }
  std::vector<RigidId>& ids() {
    if (!changes_.empty()) apply();
    return ids_;
  }

  auto begin() const { return ids().begin(); }
  auto end() const { return ids().end(); }
  std::size_t size() const { return ids().size(); }
  RigidId operator[](std::size_t i) const { return ids()[i]; }
  std::size_t memoryBytes() const {
    return (ids_.capacity() + changes_.capacity()) * sizeof(RigidId);
  }

 private:
  void apply() const {
    constexpr std::size_t kFew = 8;
    if (changes_.size() <= kFew) {
      for (const RigidId id : changes_) toggle(id);
    } else {
      toggleAll();
    }
    changes_.clear();
    if (changes_.capacity() > kFew) changes_.shrink_to_fit();
  }

  void toggle(RigidId id) const {
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
    std::vector<RigidId> odd;
    for (auto first = changes_.begin(); first != changes_.end();) {
      const auto last = std::upper_bound(first, changes_.end(), *first);
      if ((last - first) % 2 != 0) odd.push_back(*first);
      first = last;
    }
    std::vector<RigidId> now;
    now.reserve(std::max(ids_.capacity(), ids_.size() + odd.size()));
    std::set_symmetric_difference(ids_.begin(), ids_.end(), odd.begin(), odd.end(),
                                  std::back_inserter(now));
    ids_ = std::move(now);
  }

  mutable std::vector<RigidId> ids_;
  mutable std::vector<RigidId> changes_;  ///< each inserts its id, or erases it
};

}  // namespace merge2d
