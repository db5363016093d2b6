#include "src2d/merging/momentum.h"

#include <algorithm>
#include <cmath>

namespace merge2d {

double sway(const State& state, const Scratch& scratch, const Collection& c) {
  const auto velocityOf = [&](BodyId b) -> const SolverVelocity& {
    return scratch.sweep_u[index(b)];
  };
  const VelocityField field = fieldOf(state, c, velocityOf);
  const Pose frame = state[c.rigid].frame();
  double fastest = 0.0;
  for (const BodyId b : c.members) {
    const SolverVelocity& u = velocityOf(b);
    const Vec2 v = field.at(frame * state[b].local);
    fastest = std::max(fastest, (Vec2(u.vx, u.vy) - v).squaredNorm());
  }
  return std::sqrt(fastest);
}

}  // namespace merge2d
