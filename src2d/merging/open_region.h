#pragma once
/// The part of an open collection that a hit reaches. Its members take part in the full solve on
/// their own. The rest stays one body that moves with its frame; the contacts between the two push
/// with the impulses that they hold. After a solve the region is widened beyond each of them that
/// has a residual: no momentum ends at its border.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The velocity of a body in the full solve.
SolverVelocity solvedVelocity(const State& state, const Scratch& scratch, BodyId b);

class OpenRegion {
 public:
  /// The members that something outside touches, and those that the impulses inside do not keep at
  /// rest; all of them where `c` floats or was opened by a search.
  OpenRegion(const State& state, const Scratch& scratch, Collection& c);

  /// Adds the members and rows of the region to those of the full solve.
  void list(State& state, Scratch& scratch) const;
  /// After the solve: true where a contact at the border had a residual.
  bool widen(const State& state, const Scratch& scratch);

 private:
  bool isWhole() const { return next_.empty(); }
  void addTouched(const State& state, const Scratch& scratch);
  void addUnbalanced(const State& state, const Scratch& scratch);
  void findNeighbours();
  void addAround(std::vector<std::uint32_t> members);
  template <class Visit>
  void forEachBlock(const Weld& weld, Visit&& visit) const;
  template <class Visit>
  void forEachHeld(Visit&& visit) const;

  Collection* c_;
  std::vector<std::uint8_t> inside_;  ///< per member; the frame counts as inside
  /// Per member: the velocity that the impulses inside leave of its load, too slow for a hit to
  /// see.
  std::vector<Twist> left_;
  std::vector<std::uint32_t> first_, next_;  ///< per member: its run of neighbours
  double noise_ = 0.0;                       ///< slower is no motion in a hit [m/s]
  int rings_ = 2;                            ///< that are added next; twice as many each time
};

}  // namespace merge2d
