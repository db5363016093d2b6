#pragma once
/// Newton's law at one hit (dynamics/hits.h).

#include <span>
#include <vector>

#include "src2d/dynamics/hit_points.h"

namespace merge2d {

/// Solves the hits of an island that meet at one time, with the contacts and joints around them.
class HitSolver {
 public:
  explicit HitSolver(const HitIsland& island) : island_(island) {}

  /// Changes the velocities of the island at one time: w becomes the target at the points that
  /// meet, with all those around them that this makes give way. Adds the impulses to
  /// ContactPoint::struck.
  void solve(std::span<HitPoint> points);

 private:
  void returnToStart();
  void listStruck();
  void collectRows(std::span<HitPoint> points);
  ContactBlock rowsOf(std::uint32_t block) const;
  bool addThoseThatGiveWay(std::span<HitPoint> points, bool all) const;
  void solveRows(std::span<const HitPoint> points);
  double impulseOf(const HitPoint& p) const;
  /// Of impulses [J]: with the velocities before them, and with the mean of those and the ones
  /// after.
  struct Work {
    double along = 0.0, change = 0.0;

    void add(double impulse, double was, double now) {
      along += impulse * was;
      change += 0.5 * impulse * (was + now);
    }
    void add(const Work& other) {
      along += other.along;
      change += other.change;
    }
  };
  double energyBefore() const;
  Work workOfContacts() const;
  Work workOfJoints(bool of_limits) const;
  double weaken(std::span<const HitPoint> points);
  const SolverVelocity& before(std::uint32_t rigid) const;

  const HitIsland& island_;
  std::vector<ContactBlock> rows_;
  std::vector<JointBlock> joints_;
  std::vector<std::uint32_t> struck_;
  std::vector<SolverVelocity> start_;  ///< per body of the island
};

}  // namespace merge2d
