#pragma once
/// All joints of an island solved together, where sweeps take one after the other.
///
/// Rows that hold in both directions are linear equations in their impulses:
///   (J M⁻¹ Jᵀ + C) Δλ = −(w + bias + C λ),
/// solved by a sparse L D Lᵀ in blocks of one joint. Chains and trees of n joints take O(n), as in
/// Baraff, "Linear-Time Dynamics using Lagrange Multipliers" (1996); loops fill in a few blocks.
/// Motors and limits are such rows while they are inside their bounds. Letters: joint_block.h.
/// Deviation: the paper sweeps joints as it does contacts; a chain then stretches the more, the
/// heavier its end is. Guarded by Chain.HangsAsLongAsItIs.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src2d/dynamics/joint_block.h"
#include "src2d/dynamics/joint_pattern.h"

namespace merge2d {

/// Three rows of one joint against three of another; a joint with fewer has rows of zeros.
using JointMatrix = std::array<std::array<double, 3>, 3>;
using JointVector = std::array<double, 3>;

/// The rows of a joint that are solved together.
struct JointColumn {
  JointBlock* joint = nullptr;
  int rows = 0;
  std::array<std::uint8_t, 3> row{};
};

/// The patterns that the solvers of the islands keep from step to step, and their memory.
struct JointMemory {
  std::vector<JointPattern> patterns;  ///< in the order in which they were used
  std::size_t next = 0;                ///< which one comes next
  std::vector<JointEnds> ends;
  std::vector<JointColumn> columns;
  std::vector<std::int8_t> bound_row;  ///< per joint: its motor or limit among the rows, or −1
  std::vector<JointMatrix> inverse;    ///< D⁻¹, per column
  std::vector<JointMatrix> lower;      ///< L, per block below the diagonal
  std::vector<JointVector> change;     ///< per column
};

class JointSolver {
 public:
  /// The rows of the joints may be made a little soft, where joints of a loop say the same.
  JointSolver(std::span<JointBlock> joints, std::vector<SolverVelocity>& u, JointMemory& memory);

  /// Solves every joint once.
  void sweep();
  /// Adds the motion by which the errors of the joints are taken back, and no other.
  void correct();
  /// True when a sweep solves all of them for good, unless something else changes velocities.
  bool isExact() const;

 private:
  const JointPattern& patternOf();
  void chooseRows();
  void factorise();
  void eliminate(std::uint32_t column);
  JointMatrix& blockAt(std::uint32_t row, std::uint32_t column);
  JointMatrix diagonalOf(const JointColumn& c) const;
  JointMatrix coupling(const JointColumn& x, const JointColumn& y) const;
  JointMatrix inverseOf(JointMatrix k, JointColumn& c) const;
  void findChange();
  bool dropWhatIsBeyondItsBounds();
  void applyChange();
  bool solvesBound(const JointBlock& k, std::size_t row) const;

  std::span<JointBlock> joints_;
  std::vector<SolverVelocity>& u_;
  JointMemory& m_;
  const JointPattern& pattern_;
};

}  // namespace merge2d
