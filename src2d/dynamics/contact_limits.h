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

}  // namespace merge2d
