#pragma once
/// All joints of an island solved together, where sweeps take one after the other.
///
/// Rows that hold in both directions are linear equations in their impulses:
///   (J M⁻¹ Jᵀ + C) Δλ = −(w + bias + C λ),
/// solved by a sparse L D Lᵀ in blocks of one joint. Chains and trees of n joints take O(n), as in
/// Baraff, "Linear-Time Dynamics using Lagrange Multipliers" (1996); loops fill in a few blocks.
/// Motors and limits are such rows while they are inside their bounds. Letters: joint_block.h.
///
/// Where joints of a loop say the same, some rows depend on others and get a little softness. If
/// some rows are weak too, which say little beyond the others, the order of elimination would
/// decide which of them depend: a weak row must not stand for a strong one that comes later, as it
/// would turn its small error into a large motion. Then weak rows are solved after all others, by
/// their Schur complement S = D − Bᵀ A⁻¹ B, the strongest first. A row that depends on others may
/// have an error that contradicts theirs, of a loop that was closed with it: then it goes by
/// theirs. Deviation: the paper sweeps joints as it does contacts; a chain then stretches the more,
/// the heavier its end is. Guarded by Chain.HangsAsLongAsItIs.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src2d/dynamics/joint_block.h"
#include "src2d/dynamics/joint_matrix.h"
#include "src2d/dynamics/joint_pattern.h"

namespace merge2d {

/// The rows of a joint that are solved together.
struct JointColumn {
  JointBlock* joint = nullptr;
  int rows = 0;
  std::array<std::uint8_t, 3> row{};
};

/// A row that is solved after all others, and its coupling with them.
struct WeakRow {
  std::uint32_t column = 0;
  std::size_t row = 0;               ///< of the column
  double own = 0.0;                  ///< its own K + C
  std::vector<JointVector> coupled;  ///< its column of B
  std::vector<JointVector> solved;   ///< its column of A⁻¹ B
};

/// A row that depends on others and was made softer by `more`.
struct SoftenedRow {
  std::uint32_t column = 0;
  std::size_t row = 0;  ///< of the column
  double more = 0.0;
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
  std::vector<SoftenedRow> softened;
  std::vector<WeakRow> weak;
  std::vector<double> schur;        ///< S, then its inverse, row by row
  std::vector<double> weak_change;  ///< per weak row
};

/// The direct solver of one island's joints, whose impulses and velocities it changes in place.
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
  void factoriseColumns();
  void eliminate(std::uint32_t column);
  void factoriseWeakRows();
  void invertSchur();
  void soften(std::uint32_t column, std::size_t row, double more);
  JointRow& rowAt(std::uint32_t column, std::size_t row);
  void reconcile();
  void solve(std::vector<JointVector>& x);
  JointMatrix& blockAt(std::uint32_t row, std::uint32_t column);
  JointMatrix diagonalOf(const JointColumn& c) const;
  JointMatrix coupling(const JointColumn& x, const JointColumn& y) const;
  JointMatrix inverseOf(JointMatrix k, std::uint32_t column);
  void findChange();
  void substitute(std::vector<JointVector>& x) const;
  void addWeakRows(std::vector<JointVector>& x);
  bool dropWhatIsBeyondItsBounds();
  void applyChange();
  bool solvesBound(const JointBlock& k, std::size_t row) const;

  std::span<JointBlock> joints_;
  std::vector<SolverVelocity>& u_;
  JointMemory& m_;
  const JointPattern& pattern_;
  bool defers_ = false;  ///< weak rows are solved last
  bool has_weak_ = false, has_dependent_ = false;
};

}  // namespace merge2d
