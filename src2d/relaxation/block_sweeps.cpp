#include "src2d/relaxation/block_sweeps.h"

#include <algorithm>

#include "src2d/dynamics/joint_system.h"
#include "src2d/dynamics/nncg.h"
#include "src2d/dynamics/wide_blocks.h"

namespace merge2d {

/// `store` writes the impulses into the blocks.
template <class ImpulsesAt, class Sweep, class Store>
int BlockSweeps::iterate(int most, std::span<const std::uint32_t> blocks,
                         std::span<const BodyId> bodies, NncgBuffers& buffers, bool resumes,
                         ImpulsesAt impulses, Sweep sweep, Store store) {
  Nncg iteration(
      blocks.size(), impulses, bodies.size(),
      [&](std::size_t i) -> SolverVelocity& { return u_[index(bodies[i])]; }, sweep, buffers);
  int done = 0;
  const auto enough = [&] {
    if (++done % kLookEvery != 0) return false;
    store();
    return std::ranges::all_of(blocks, [&](std::uint32_t i) { return residual(i) <= tolerance; });
  };
  if (resumes) {
    iteration.resume(most, enough);
  } else {
    iteration.run(most, c_.joints.empty(), enough);
  }
  return iteration.done();
}

int BlockSweeps::runOneByOne(int most, std::span<const std::uint32_t> blocks,
                             std::span<const BodyId> bodies, NncgBuffers& buffers, bool resumes) {
  const auto sweep = [&] {
    for (JointBlock& k : c_.joints) solveJoint(k, {}, u_[k.a], u_[k.b]);
    for (const std::uint32_t i : blocks) {
      ContactBlock& k = c_.blocks[i];
      solveBlock(k, k.nx, k.ny, u_[k.a], u_[k.b]);
    }
  };
  return iterate(
      most, blocks, bodies, buffers, resumes,
      [&](std::size_t i) -> Impulses& { return c_.blocks[blocks[i]].lambda; }, sweep, [] {});
}

int BlockSweeps::runWide(int most, std::span<const std::uint32_t> blocks,
                         std::span<const BodyId> bodies, NncgBuffers& buffers, bool resumes) {
  WideBlocks& wide = tools_.memory.wide;
  u_.back() = {};
  wide.packChosen(c_.blocks, blocks, u_, static_cast<std::uint32_t>(u_.size() - 1));
  const auto store = [&] { wide.storeImpulses(c_.blocks, blocks); };
  const int done = iterate(
      most, blocks, bodies, buffers, resumes,
      [&](std::size_t i) -> Impulses& { return wide.impulses()[blocks[i]]; },
      [&] { wide.sweep(c_.blocks, u_, tools_.path, tools_.tasks); }, store);
  store();
  return done;
}

int BlockSweeps::run(int most, std::span<const std::uint32_t> blocks,
                     std::span<const BodyId> bodies, NncgBuffers& buffers, bool resumes) {
  constexpr std::size_t kLeastWide = 8;  // blocks
  const bool wide =
      c_.joints.empty() && blocks.size() >= kLeastWide && tools_.path != SweepPath::OneByOne;
  const int done = wide ? runWide(most, blocks, bodies, buffers, resumes)
                        : runOneByOne(most, blocks, bodies, buffers, resumes);
  settleJoints(c_, {}, u_, tolerance);
  return done;
}

}  // namespace merge2d
