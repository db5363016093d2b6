#pragma once
/// The grip of each weld: how many contacts it still holds by, which press or have not opened
/// since, and its joints.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Contacts of a weld that have carried a force and have not opened since, and the contacts that
/// its joints count as.
int activeContacts(const Collection& c, const Weld& weld);

/// Points of this collection nearer than this count as one [m].
double resolutionOf(const State& state, const Collection& c);

/// Finds the grip of one weld, and of all that are unknown. To be called whenever a contact of it
/// has become active, was lost or presses again, and whenever its joints hold more or less.
void updateGrip(const State& state, Collection& c, std::uint32_t weld);
void findGrips(const State& state, Collection& c);

/// Fewer than two contacts hold, and there was one: only such a weld can turn in 2D.
inline bool isPivot(Grip grip) { return grip == Grip::Lost || grip == Grip::Pivot; }

/// At least one contact holds, or a joint.
inline bool holds(Grip grip) { return grip != Grip::None && grip != Grip::Lost; }

/// Lists the welds that are pivots.
void listPivots(const State& state, Collection& c);

/// Calls `visit(point)` for the contacts of a weld that hold.
template <class Visit>
void forEachHeld(const Collection& c, const Weld& weld, Visit&& visit) {
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const InternalContact& inner = c.contacts[i];
    for (std::size_t p = 0; p < static_cast<std::size_t>(inner.count); ++p) {
      if (inner.watch[p].holds()) visit(inner.points[p]);
    }
  }
}

}  // namespace merge2d
