#pragma once
/// Which collection has which colour, for life.

#include <cstddef>
#include <utility>
#include <vector>

#include "src2d/trace/snapshot.h"

namespace merge2d {

/// Colour slots (indices into Theme::collections) of the collections of one snapshot, by id.
using CollectionSlots = std::vector<std::pair<CollectionId, std::size_t>>;

/// The slot of a collection; 0 for one that is not in the list.
std::size_t slotOf(const CollectionSlots& slots, CollectionId id);

/// Gives each new collection the colour that is farthest from it in the scene. Fed with the frames
/// of a run in order, it gives the same colours whoever draws them.
class CollectionColors {
 public:
  CollectionSlots update(const Snapshot& snapshot);

 private:
  std::size_t choose(const Snapshot& snapshot, const CollectionView& added,
                     const CollectionSlots& alive);

  CollectionSlots known_;              ///< of all collections ever seen, ascending ids
  std::vector<std::size_t> last_use_;  ///< per slot: how many choices had been made
  std::size_t choices_ = 0;
};

}  // namespace merge2d
