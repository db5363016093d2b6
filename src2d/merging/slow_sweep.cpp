#include "src2d/merging/slow_sweep.h"

#include <algorithm>
#include <cmath>

#include "src2d/dynamics/nncg.h"
#include "src2d/merging/limits.h"
#include "src2d/merging/refine.h"

namespace merge2d {
namespace {

/// The largest motion that is left in contacts that hold [m/s].
double leftInside(const State& state, const Collection& c, const Scratch& scratch) {
  const Rotation turn = state[c.rigid].rotation;
  double left = 0.0;
  for (std::uint32_t b = 0; b < c.active_blocks; ++b) {
    const ContactBlock& k = c.blocks[b];
    const double nx = turn.c * k.nx - turn.s * k.ny, ny = turn.s * k.nx + turn.c * k.ny;
    for (int i = 0; i < k.count; ++i) {
      if (broken(k, i)) continue;
      const ContactVelocity w =
          contactVelocity(k, i, nx, ny, scratch.sweep_u[k.a], scratch.sweep_u[k.b]);
      left = std::max(left, std::abs(w.n + k.bias[i]));
      if (!onEdge(k, i)) left = std::max(left, std::abs(w.t));
    }
  }
  return left;
}

void sweepManyTimes(const State& state, Collection& c, Scratch& scratch, int sweeps) {
  const Rotation turn = state[c.rigid].rotation;
  const SolverMethod method = state.settings.solver.method;
  auto& u = scratch.sweep_u;
  Nncg iteration(
      c.active_blocks, [&](std::size_t i) -> Impulses& { return c.blocks[i].lambda; },
      c.members.size(), [&](std::size_t i) -> SolverVelocity& { return u[index(c.members[i])]; },
      [&] {
        for (std::uint32_t b = 0; b < c.active_blocks; ++b) {
          sweepBlock(c.blocks[b], turn, u, method);
        }
      },
      scratch.nncg);
  iteration.run(sweeps, isAccelerated(method));
}

}  // namespace

bool hastenSweeps(const State& state, Collection& c, Scratch& scratch) {
  constexpr std::int16_t kFirst = 4, kMost = 512;  // steps
  constexpr double kMuch = 5.0;                    // times residualVelocity()
  constexpr int kMostPoints = 200, kSweeps = 100;
  if (c.points > kMostPoints || !c.joints.empty()) return false;  // joints have their own way
  if (scratch.disturbed[index(c.rigid) - state.bodies.size()]) {  // more sweeps follow anyway
    c.hastened_in = c.hastened_every = kFirst;
    return false;
  }
  if (--c.hastened_in > 0) return false;
  c.hastened_every = std::clamp<std::int16_t>(2 * c.hastened_every, kFirst, kMost);
  c.hastened_in = c.hastened_every;
  if (leftInside(state, c, scratch) <= kMuch * residualVelocity(state)) return false;
  sweepManyTimes(state, c, scratch, kSweeps);
  return true;
}

}  // namespace merge2d
