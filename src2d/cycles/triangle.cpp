#include "src2d/cycles/triangle.h"

#include "src2d/cycles/growth.h"

namespace merge2d {
TriangleGroups triangleGroups(std::uint32_t nodes, std::span<const Pin> pins) {
  Contraction contraction(nodes, pins, PinRule{});
  contraction.run();
  return {contraction.groups(), contraction.cycles()};
}

}  // namespace merge2d
