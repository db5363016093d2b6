#pragma once
/// The motion of the bodies of welds against each other in a solution for the inside of a
/// collection.

#include <cstdint>
#include <vector>

#include "src2d/dynamics/state.h"
#include "src2d/merging/metric.h"
#include "src2d/proofs/decided_settings.h"

namespace merge2d {

/// How fast the two bodies of a weld move against each other at the corners of their boxes: of the
/// box where this is most, and of the one where it is least [m/s].
struct WeldMotion {
  double most = 0.0, least = 0.0;
};

/// The welds of one collection, with the velocities `u` of its members, seen from its frame.
class WeldMotions {
 public:
  WeldMotions(const State& state, const Collection& c, const std::vector<SolverVelocity>& u)
      : state_(state), c_(c), u_(u) {}

  /// The speed at which the bodies of a weld part [m/s].
  double limitOf(const Weld& weld) const { return cutSpeed(state_, c_, weld); }

  /// Zero where a bound tells that nothing is faster than `ignored`.
  WeldMotion of(const Weld& weld, double ignored) const;

  /// The bodies of a weld part, and move by more than `noise` at either box: a beam that begins to
  /// tip about its pivot hardly moves there.
  bool turns(const Weld& weld, double noise) const;

 private:
  bool isMember(BodyId b) const { return state_[b].rigid == c_.rigid; }
  VelocityField field(BodyId b, const Vec2& origin) const;
  OrientedBox boxOf(BodyId b, const Vec2& origin) const;
  double reachFrom(const Vec2& x, const Weld& weld) const;

  const State& state_;
  const Collection& c_;
  const std::vector<SolverVelocity>& u_;
};

/// How fast the members move in a search, at contacts and at the corners of welds [m/s]. A weld of
/// which one box hardly moves is left out: its motion may be that of the residual.
double fastestOf(const State& state, const SweepMemory& memory, const Collection& c);

/// Per weld: whether its bodies move in a search.
std::vector<std::uint8_t> moversOf(const State& state, const SweepMemory& memory,
                                   const Collection& c);

}  // namespace merge2d
