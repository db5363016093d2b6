#pragma once
/// Memory of the corrections of joints in an island (solver.cpp), which is kept from step to step.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "src2d/dynamics/contact_block.h"
#include "src2d/dynamics/joint.h"
#include "src2d/dynamics/joint_block.h"

namespace merge2d {

/// The velocities of the two bodies of a joint.
struct JointMotion {
  SolverVelocity a, b;
};

/// The solution of an island, to go back to.
class IslandSolution {
 public:
  void keep(std::span<const ContactBlock> blocks, std::span<const JointBlock> joints,
            std::span<const std::uint32_t> bodies, const std::vector<SolverVelocity>& u) {
    u_.clear();
    impulses_.clear();
    for (const std::uint32_t b : bodies) u_.push_back(u[b]);
    for (const ContactBlock& k : blocks) impulses_.push_back(k.lambda);
    joints_.assign(joints.begin(), joints.end());
  }
  void restore(std::span<ContactBlock> blocks, std::span<JointBlock> joints,
               std::span<const std::uint32_t> bodies, std::vector<SolverVelocity>& u) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) u[bodies[i]] = u_[i];
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].lambda = impulses_[i];
    std::ranges::copy(joints_, joints.begin());
  }

 private:
  std::vector<SolverVelocity> u_;
  std::vector<Impulses> impulses_;
  std::vector<JointBlock> joints_;
};

/// Islands with joints are solved in turn, and share it.
struct CorrectionMemory {
  std::vector<JointErrors> bends;
  std::vector<JointMotion> before;
  IslandSolution uncorrected;
};

}  // namespace merge2d
