#pragma once
/// Sweeps over contact blocks, four at a time.
///
/// Blocks of one colour share no body that moves: solved side by side they change the same bodies
/// by the same amounts as one after the other, and the results are the same bits as those of
/// `solveBlock` on every processor (dynamics/wide_kernel.h). Points of magnets, rolling discs and
/// the rest of a colour are solved one by one.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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
  Four inv_inertia_a, inv_inertia_b, surface_a, surface_b;
  std::array<std::uint32_t, 4> a{}, b{};  ///< indices into the velocities
  std::array<std::uint32_t, 4> block{};   ///< indices into the impulses
};

struct BlockOrder;
class TaskPool;

class WideBlocks {
 public:
  /// Takes the blocks of an island, whose order is `order`; `idle` is the index of a velocity that
  /// never responds. Blocks and velocities must outlive the sweeps.
  void pack(std::span<const ContactBlock> blocks, std::span<const BlockOrder> order,
            const std::vector<SolverVelocity>& u, std::uint32_t idle);

  /// The same for `chosen` ones in any order: neighbours in it that share no moving body are solved
  /// side by side.
  void packChosen(std::span<const ContactBlock> blocks, std::span<const std::uint32_t> chosen,
                  const std::vector<SolverVelocity>& u, std::uint32_t idle);

  /// Per block; two more for lanes without a block.
  std::vector<Impulses>& impulses() { return impulses_; }

  /// Solves every block once. The threads of `tasks`, where there are some, share large colours.
  void sweep(std::span<ContactBlock> blocks, std::vector<SolverVelocity>& u, SweepPath path,
             TaskPool* tasks = nullptr);

  void storeImpulses(std::span<ContactBlock> blocks) const;
  void storeImpulses(std::span<ContactBlock> blocks, std::span<const std::uint32_t> chosen) const;

  std::size_t memoryBytes() const;
  /// Gives its memory back; no sweep may follow before blocks are packed again.
  void release() { *this = {}; }

 private:
  /// Groups that may be solved in any order, then blocks that may.
  struct Colour {
    std::uint32_t last_pair = 0, last_single = 0;  ///< of wide_
    std::uint32_t last_alone = 0;                  ///< of alone_
  };

  void begin(std::size_t blocks, std::size_t chosen);
  void packColour(std::span<const ContactBlock> blocks, const std::vector<SolverVelocity>& u,
                  std::uint32_t idle);
  void packGroups(std::span<const ContactBlock> blocks, const std::vector<SolverVelocity>& u,
                  const std::vector<std::uint32_t>& chosen, std::uint32_t idle,
                  std::size_t idle_impulses);

  std::vector<WideBlock> wide_;
  std::vector<std::uint32_t> alone_;  ///< blocks that are solved one by one
  std::vector<Colour> colours_;
  std::vector<Impulses> impulses_;
  std::vector<std::uint32_t> colour_, pairs_, singles_;  ///< blocks of the colour that is packed
  std::vector<std::uint64_t> taken_;                     ///< per body: the colour that it is in
  std::uint64_t colours_so_far_ = 0;                     ///< of all packings
};

}  // namespace merge2d
