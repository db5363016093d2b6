#pragma once
/// Four contact blocks side by side, and the functions that work on them.
///
/// Each lane gets the operations of one block alone, in the same order: results are the same bits
/// as those of contact_block.h and rows.cpp, on every processor.

#include <array>
#include <cstddef>
#include <cstdint>

#include "src2d/core/sweep_path.h"
#include "src2d/dynamics/collections.h"
#include "src2d/dynamics/contact_block.h"

namespace merge2d {

/// Four numbers side by side, one for each of four blocks.
using Four = double __attribute__((vector_size(32), aligned(32)));

/// The rows of four blocks, by rows. A lane without a block has bodies that do not respond.
struct alignas(32) WideBlock {
  Four nx, ny;
  Four arm_an[2], arm_bn[2], arm_at[2], arm_bt[2];
  Four k11, k12, k22, inv_det;
  Four inv_kt[2];
  Four softness;
  Four bias[2];
  Four mu;
  std::array<std::uint32_t, 4> a{}, b{};  ///< indices into the velocities
  std::array<std::uint32_t, 4> block{};   ///< indices into the impulses
  std::int16_t points = 0;                ///< of each block
  bool plain = false;                     ///< made four at a time
  std::uint8_t too_close = 0;             ///< bit: the two points of that lane count as one
};

/// The source of the rows of four blocks.
struct FourContacts {
  Four nx, ny;                                      ///< normals, in the frames of the bodies a
  Four x, y, c, s;                                  ///< poses of these
  Four px[2], py[2];                                ///< points, in their frames [m]
  Four gap[2];                                      ///< [m]
  Four center_ax, center_ay, center_bx, center_by;  ///< of the rigid things [m]
  Four mass_a, mass_b;  ///< of the bodies; infinite where they do not respond [kg]
  Four size;            ///< of the smaller body [m]
};

/// The numbers of a step that its rows are made with.
struct RowSettings {
  double h = 0.0;  ///< [s]
  double erp = 0.0;
  double max_correction = 0.0;  ///< [m/s]
  double margin = 0.0;          ///< [m]
  double compliance = 0.0;      ///< [1]
  double fall = 0.0;            ///< in a step [m]
};

/// Relative velocities of four blocks at both points, along the normal and the tangent [m/s].
struct FourContactVelocities {
  Four n[2], t[2];
};

/// The change of all impulses in the last sweep, squared, beside the impulses themselves [N² s²].
struct SweepChange {
  double squared = 0.0;
  double total = 0.0;
};

/// Impulses of all blocks as vectors of the conjugate gradient (dynamics/nncg.h).
struct ImpulseVectors {
  Impulses *now = nullptr, *before = nullptr, *direction = nullptr;
  std::size_t size = 0;  ///< blocks
};

/// One set of instructions.
struct WideKernels {
  /// Runs of blocks with two points, then with one, that share no moving body.
  using OnImpulses = void (*)(const WideBlock* first, const WideBlock* end_of_pairs,
                              const WideBlock* last, Impulses* impulses, SolverVelocity* u);
  OnImpulses warm_start;
  OnImpulses sweep;
  /// Fills all but friction and indices, which must be there.
  void (*make_rows)(const FourContacts& of, const RowSettings& settings, const SolverVelocity* u,
                    WideBlock& to);
  void (*velocities)(const WideBlock& of, const SolverVelocity* u, FourContactVelocities& to);
  SweepChange (*change)(const ImpulseVectors& of);
  void (*step)(const ImpulseVectors& of, double rho, double keep);
};

/// Of the fastest instructions of `path` that the processor has.
const WideKernels& wideKernels(SweepPath path);

}  // namespace merge2d
