#pragma once
/// Splits collections at their cut welds (Section 6.3): the part of Unmerge that all rules share.

#include <string_view>

#include "src2d/collections/parts.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// True when the two bodies of a weld are still one rigid thing, or on one frame.
bool stillTogether(const State& state, BodyId a, BodyId b);

/// Takes a collection apart into `parts`, and reports each weld that ends.
void splitAtCuts(State& state, Scratch& scratch, RigidId id, const Parts& parts);

/// Breaks the joints inside that bear too much, and splits the collection where nothing else holds
/// it together. Of joints the paper does not speak. Returns false when there are none.
bool breakJointsInside(State& state, Scratch& scratch, Collection& collection);

/// The decisions about one collection: a run of those noted in this step.
struct Noted {
  Notes* notes;  ///< null: nobody asks
  std::size_t first = 0, last = 0;

  explicit Noted(Notes* all) : notes(all) {
    if (notes) first = last = notes->decisions.size();
  }
  /// Ends the run at the last decision so far.
  void close() {
    if (notes) last = notes->decisions.size();
  }
};

/// A weld that a test wants to unmerge may stay for other reasons: replaces the verdict by `to`
/// where `holds`.
template <class Holds>
void restate(const Noted& noted, std::string_view to, Holds&& holds) {
  for (std::size_t i = noted.first; i < noted.last; ++i) {
    Decision& d = noted.notes->decisions[i];
    if (d.verdict == "unmerge" && holds(d)) d.verdict = to;
  }
}

/// The same where the pair stayed together.
inline void restate(const State& state, const Noted& noted, std::string_view to) {
  restate(noted, to, [&](const Decision& d) { return stillTogether(state, d.a, d.b); });
}

}  // namespace merge2d
