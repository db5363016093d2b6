#pragma once
/// How far two things can come towards each other in this step: contacts are looked for that far
/// ahead, so that nothing passes through anything.

#include "src2d/dynamics/free_motion.h"

namespace merge2d {

/// How far things can come towards each other in a step by the motion with which it begins, without
/// contacts and forces. The kicks must have been ordered.
class Approaches {
 public:
  /// Its memory is `scratch.start_motions`.
  Approaches(const State& state, Scratch& scratch);

  /// An upper bound of the way [m] that a point of the first can go against one of the second.
  double between(RigidId a, RigidId b) const;
  /// The same for two bodies, wherever their rigid things have their centres.
  double between(BodyId a, BodyId b) const;
  /// The same for any two things.
  double farthest() const { return farthest_; }
  /// How far the turn of a thing can carry any of its points: at most to the other side [m].
  double byTurning(RigidId id) const;

 private:
  using Motion = StartedMotion;
  double between(const Motion& a, const Motion& b) const {
    return state_.h * ((b.v - a.v).norm() + a.turning + b.turning);
  }
  std::size_t placeOf(RigidId id) const;
  Motion of(RigidId id) const;
  Motion of(BodyId body) const;

  const State& state_;
  double farthest_ = 0.0;
  const std::vector<RigidId>& present_;  ///< ascending; nothing comes or goes while they are asked
  std::vector<Motion>& motions_;         ///< of each of these
};

}  // namespace merge2d
