#pragma once
/// The quick part of every criterion: a body with two pins on one group belongs to it, and so do
/// two bodies that are linked to it and to each other. In a pile that leaves little to the theory.

#include <cstdint>
#include <span>
#include <vector>

#include "src2d/cycles/pins.h"

namespace merge2d {

/// Which pins count: all for the triangles, those in different places for the rigid groups.
struct PinRule {
  double resolution = -1.0;  ///< pins nearer than this are one; negative: places do not count [m]

  /// Two pins hold a pair.
  bool distinct(const Pin& p, const Pin& q) const { return (p.at - q.at).norm() > resolution; }
  /// Three pins hold three bodies unless they lie on a line.
  bool closes(const Pin& p, const Pin& q, const Pin& r) const;
};

/// Grows a group from the node with the most pins. Per node: 1 when it is inside. Linear in the
/// pins.
std::vector<std::uint8_t> grownGroup(std::uint32_t nodes, std::span<const Pin> pins,
                                     const PinRule& rule);

}  // namespace merge2d
