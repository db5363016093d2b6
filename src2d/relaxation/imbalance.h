#pragma once
/// The velocities that the impulses inside a collection leave of the load on its members.

#include <vector>

#include "src2d/dynamics/state.h"
#include "src2d/proofs/collection_load.h"

namespace merge2d {

/// A velocity that something gives to a member.
struct MemberLoad {
  std::uint32_t member = 0;
  Twist gain;
};

/// As long as impulses and the motion of the frame stay, only members are looked at on which
/// something acts from outside, or which did not keep still before.
class Imbalance {
 public:
  /// For a load of this step, which must outlive this.
  Imbalance(const State& state, Collection& c, const CollectionLoad& load);

  /// The velocity that is left of a member's load.
  Twist of(std::uint32_t member) const;

  /// The members of which a corner may move faster than the tolerated residual, with these
  /// velocities; ascending.
  std::vector<MemberLoad> unbalanced() const;

  /// No other member moves faster [m/s].
  double fastestOfOthers() const { return c_.push.fastest; }

 private:
  void look();
  Twist ofFrame(std::uint32_t member) const;

  const State& state_;
  Collection& c_;
  const CollectionLoad& load_;
};

}  // namespace merge2d
