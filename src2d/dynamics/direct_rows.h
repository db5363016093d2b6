#pragma once
/// The rows of an island for a direct solve, over the bodies that respond, and the matrix of their
/// normal equations, M + Jᵀ G J.

#include <cstdint>
#include <span>
#include <vector>

#include "src2d/dynamics/body_matrix.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// w = J u + bias between two bodies.
struct DirectRow {
  static constexpr std::uint32_t kFixed = ~0u;
  std::uint32_t a = kFixed, b = kFixed;  ///< places among the bodies, or one that does not respond
  Twist j_a, j_b;                        ///< the Jacobian's parts
  double bias = 0.0;                     ///< with the velocity of a body that does not respond
  double turn_a = 0.0, turn_b = 0.0;     ///< of a body that does not respond, else 0 [rad/s]
  double k = 0.0;                        ///< J M⁻¹ Jᵀ
  std::uint32_t block_a = 0, block_b = 0, block_ab = 0;  ///< of the matrix
};

/// The symmetric G of one or two rows between the same bodies.
struct RowWeights {
  double nn = 0.0, nt = 0.0, tt = 0.0;
};

/// The rows of one island, beside the masses of its bodies and their velocities without impulses.
class DirectRows {
 public:
  /// `u` holds the velocities before any impulse, and outlives this.
  DirectRows(std::span<const std::uint32_t> bodies, const std::vector<SolverVelocity>& u);

  /// The row d·(v_b − v_a) + arm_b ω_b − arm_a ω_a + bias; returns its number.
  std::uint32_t add(std::uint32_t a, std::uint32_t b, const Vec2& d, double arm_a, double arm_b,
                    double bias);

  /// Moves the point where a row acts, a little.
  void setArms(std::uint32_t row, double arm_a, double arm_b);

  const DirectRow& operator[](std::uint32_t row) const { return rows_[row]; }
  std::size_t bodies() const { return mass_.size(); }
  const std::vector<Twist>& freeVelocities() const { return free_; }

  /// The velocity along a row that the twists of the bodies give, without its bias.
  double along(std::uint32_t row, const std::vector<Twist>& twists) const;
  /// Adds the momenta of an impulse along a row.
  void push(std::uint32_t row, double impulse, std::vector<Twist>& momenta) const;
  /// Momenta of velocities, or velocities of momenta.
  Twist momentum(std::size_t body, const Twist& velocity) const;
  Twist velocity(std::size_t body, const Twist& momentum) const;

  /// Begins H = M + Jᵀ G J anew, and adds the part of one row, or of a row and the next one.
  void beginMatrix();
  void weigh(std::uint32_t row, double g);
  void weigh(std::uint32_t row, const RowWeights& g);
  /// False where the matrix could not be factorised.
  bool factorize();
  /// The velocities H⁻¹ p of momenta.
  void solve(const std::vector<Twist>& momenta, std::vector<Twist>& velocities) const;

 private:
  void layOut();
  void fill(const DirectRow& x, const DirectRow& y, double g);

  const std::vector<SolverVelocity>& u_;
  std::vector<std::uint32_t> place_;  ///< per body of the scene
  std::vector<Twist> free_, mass_;    ///< per body: velocity without impulses; m, m, I
  std::vector<DirectRow> rows_;
  BodyMatrix hessian_;
  bool is_laid_out_ = false;
};

}  // namespace merge2d
