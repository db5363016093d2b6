#pragma once
/// The engine's own block sweeps inside the conjugate gradient (dynamics/nncg.h), over chosen rows
/// inside one collection, with the velocities in SweepMemory::trial_u.

#include <algorithm>
#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Gauss-Seidel sweeps over some or all contact blocks inside a collection, with the velocities of
/// its members in SweepMemory::trial_u.
class BlockSweeps {
 public:
  static constexpr int kLookEvery = 5;  ///< sweeps after which the residual is looked at

  BlockSweeps(const SweepTools& tools, Collection& c, double tolerance_of_rows)
      : tolerance(tolerance_of_rows), tools_(tools), c_(c), u_(tools.memory.trial_u) {}

  /// The largest change that one more solve of a block would make [m/s].
  double residual(std::uint32_t block) const {
    const ContactBlock& k = c_.blocks[block];
    return residualOf(k, k.nx, k.ny, u_[k.a], u_[k.b]);
  }

  /// Over all blocks [m/s].
  double largestResidual() const {
    double most = 0.0;
    for (std::uint32_t i = 0; i < c_.blocks.size(); ++i) most = std::max(most, residual(i));
    return most;
  }

  /// At most so many sweeps over `blocks`, ascending, at the members `bodies`; fewer where all of
  /// them are below the tolerance before. `resumes`: the last ones over them go on. Returns how
  /// many.
  int run(int most, std::span<const std::uint32_t> blocks, std::span<const BodyId> bodies,
          NncgBuffers& buffers, bool resumes);

  double tolerance;  ///< of the rows' residuals [m/s]

 private:
  int runOneByOne(int most, std::span<const std::uint32_t> blocks, std::span<const BodyId> bodies,
                  NncgBuffers& buffers, bool resumes);
  int runWide(int most, std::span<const std::uint32_t> blocks, std::span<const BodyId> bodies,
              NncgBuffers& buffers, bool resumes);
  template <class ImpulsesAt, class Sweep, class Store>
  int iterate(int most, std::span<const std::uint32_t> blocks, std::span<const BodyId> bodies,
              NncgBuffers& buffers, bool resumes, ImpulsesAt impulses, Sweep sweep, Store store);

  SweepTools tools_;
  Collection& c_;
  std::vector<SolverVelocity>& u_;
};

}  // namespace merge2d
