#pragma once
/// A spring as it can be seen, as plain data.

#include <cstdint>

#include "src2d/core/ids.h"
#include "src2d/core/vec.h"

namespace merge2d {

struct SpringView {
  std::uint32_t number = 0;  ///< as the world counts them
  BodyId body{}, other{};
  bool to_world = true;      ///< there is no `other`
  Vec2 from = Vec2::Zero();  ///< world point on the body
  Vec2 to = Vec2::Zero();    ///< world point of the other end
  double force = 0.0;        ///< pulling positive [N]
};

}  // namespace merge2d
