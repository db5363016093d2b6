#include "src2d/collections/momentum.h"

namespace merge2d {

VelocityField sweptField(const State& state, const Scratch& scratch, const Collection& c) {
  return momentumField(
      state, c, [&](BodyId b) -> const SolverVelocity& { return scratch.sweep_u[index(b)]; });
}

}  // namespace merge2d
