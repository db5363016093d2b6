#include "src2d/merging/momentum.h"

#include <algorithm>
#include <cmath>

namespace merge2d {

VelocityField sweptField(const State& state, const Scratch& scratch, const Collection& c) {
  return fieldOf(state, c,
                 [&](BodyId b) -> const SolverVelocity& { return scratch.sweep_u[index(b)]; });
}

double sway(const State& state, const Scratch& scratch, const Collection& c) {
  const VelocityField field = sweptField(state, scratch, c);
  const Pose frame = state[c.rigid].frame();
  double fastest = 0.0;
  for (const BodyId b : c.members) {
    const Vec2 x = frame * state[b].local;
    fastest = std::max(fastest, swaySquared(field, x, scratch.sweep_u[index(b)]));
  }
  return std::sqrt(fastest);
}

}  // namespace merge2d
