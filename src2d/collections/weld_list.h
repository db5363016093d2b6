#pragma once
/// The welds of a collection by pair.

#include <utility>

#include "src2d/dynamics/state.h"

namespace merge2d {

inline std::pair<BodyId, BodyId> pairOf(const Weld& weld) { return {weld.a, weld.b}; }

/// The weld of two bodies, the lower one first; null where there is none.
const Weld* findWeld(const Collection& collection, BodyId a, BodyId b);

/// Brings all welds into the order of their pairs. Contacts refer to their places, and must be laid
/// out anew.
void sortWelds(Collection& collection);

}  // namespace merge2d
