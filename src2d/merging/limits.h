#pragma once
/// When the impulses of a contact inside a collection are at their limits (Sections 6.3 and 6.4).

#include <cmath>

#include "src2d/dynamics/collections.h"

namespace merge2d {

/// A tangential impulse this near to its limit is on the edge of the cone, Eq. (20).
inline constexpr double kWeldOnEdge = 1.0 - 1e-9;

inline bool broken(const ContactBlock& k, int i) { return k.lambda_n(i) <= 0.0 && !k.bilateral; }
inline bool onEdge(const ContactBlock& k, int i) {
  return !k.bilateral && std::abs(k.lambda_t(i)) >= kWeldOnEdge * k.mu * k.lambda_n(i);
}

/// True when some point of the block that has carried a force carries none any more, or one carries
/// its first, or is on the edge of its cone.
inline bool asksForTest(const ContactBlock& k, const BlockWatch& watch) {
  for (int i = 0; i < k.count; ++i) {
    const bool active = watch.active(i);
    if (broken(k, i) ? active : !active || onEdge(k, i)) return true;
  }
  return false;
}

/// After the sweeps of a step over a block.
inline void watchLimits(const ContactBlock& k, BlockWatch& watch) {
  if (asksForTest(k, watch)) watch.watch(true);
}

}  // namespace merge2d
