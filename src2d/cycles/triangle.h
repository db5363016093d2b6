#pragma once
/// The criterion of Section 8.2: a cycle of three bodies with one contact between each is stable,
/// and bodies with two contacts between them count as one.

#include <span>

#include "src2d/cycles/contraction.h"
#include "src2d/cycles/pins.h"

namespace merge2d {

struct TriangleGroups {
  Groups groups;
  std::vector<CycleOfThree>
      cycles;  ///< of groups that were joined by a cycle, in the order of joining
};

/// Contracts pairs with two or more contacts, and cycles of three, until nothing contracts. Where
/// the contacts are does not matter.
TriangleGroups triangleGroups(std::uint32_t nodes, std::span<const Pin> pins);

}  // namespace merge2d
