#pragma once
/// What a snapshot tells of a body's collection.

#include <algorithm>

#include "src2d/trace/snapshot.h"

namespace merge2d {

/// Whether a body is welded to what is pinned or scripted.
inline bool isAnchored(const Snapshot& seen, const BodyState& body) {
  const auto at = std::ranges::find(seen.collections, body.collection, &CollectionView::id);
  return at != seen.collections.end() && at->anchored;
}

}  // namespace merge2d
