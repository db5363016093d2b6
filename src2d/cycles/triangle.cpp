#include "src2d/cycles/triangle.h"

namespace merge2d {
namespace {

/// Contacts are counted, wherever they are.
struct Counted {
  static bool distinct(const Pin& /*p*/, const Pin& /*q*/) { return true; }
  static bool closes(const Pin& /*p*/, const Pin& /*q*/, const Pin& /*r*/) { return true; }
};

}  // namespace

TriangleGroups triangleGroups(std::uint32_t nodes, std::span<const Pin> pins) {
  Contraction contraction(nodes, pins, Counted{});
  contraction.run();
  return {contraction.groups(), contraction.cycles()};
}

}  // namespace merge2d
