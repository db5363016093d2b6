#pragma once
/// Sweeps over contact blocks, four at a time.
///
/// Blocks of one colour share no body that moves: solved side by side they change the same bodies
/// by the same amounts as one after the other, and the results are the same bits as those of
/// `solveBlock` on every processor (dynamics/wide_block.h). Points of magnets, rolling discs and
/// the rest of a colour are solved one by one.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src2d/dynamics/wide_block.h"

namespace merge2d {

struct BlockOrder;
class TaskPool;

/// The kinds of blocks. Only the places of plain ones are taken when they are packed: their rows
/// and impulses are filled in later.
enum class PackedAs : std::uint8_t { PlainPair, Pair, PlainSingle, Single, Alone };

inline bool isPlain(PackedAs kind) {
  return kind == PackedAs::PlainPair || kind == PackedAs::PlainSingle;
}

/// Of a block whose rows are there. Those of magnets and of rolling discs are solved alone.
inline PackedAs packedAs(const ContactBlock& k) {
  if (k.bilateral || k.rolls()) return PackedAs::Alone;
  return k.count == 2 ? PackedAs::Pair : PackedAs::Single;
}

/// Blocks packed by fours, colour by colour, and their sweeps.
class WideBlocks {
 public:
  /// Takes the blocks of an island, whose order is `order`; `idle` is the index of a velocity that
  /// never responds. Blocks and velocities must outlive the sweeps.
  void pack(std::span<const ContactBlock> blocks, std::span<const PackedAs> kinds,
            std::span<const BlockOrder> order, std::uint32_t idle);

  /// The same for `chosen` ones in any order: neighbours in it that share no moving body are solved
  /// side by side.
  void packChosen(std::span<const ContactBlock> blocks, std::span<const std::uint32_t> chosen,
                  const std::vector<SolverVelocity>& u, std::uint32_t idle);

  /// Those that are solved side by side, and those that are solved one by one.
  std::span<WideBlock> groups() { return {wide_.data(), groups_}; }
  std::span<const WideBlock> groups() const { return {wide_.data(), groups_}; }
  std::span<const std::uint32_t> alone() const { return alone_; }
  /// True for a lane that has a block.
  bool isUsed(const WideBlock& group, std::size_t lane) const {
    return group.block[lane] < blocks_;
  }
  bool isFull(const WideBlock& group) const { return isUsed(group, 3); }

  /// Lanes of `group` without a block shall do nothing.
  void clearUnused(WideBlock& group) const;
  /// The block of that lane is solved alone from now on.
  void takeOut(std::size_t group, std::size_t lane, const ContactBlock& block);

  /// Per block; then one for each group that has lanes without a block, which write to it.
  std::vector<Impulses>& impulses() { return impulses_; }

  /// Adds the impulses that the blocks begin with.
  void warmStart(std::span<const ContactBlock> blocks, std::vector<SolverVelocity>& u,
                 SweepPath path, TaskPool* tasks = nullptr);

  /// Solves every block once. The threads of `tasks`, where there are some, share large colours.
  void sweep(std::span<ContactBlock> blocks, std::vector<SolverVelocity>& u, SweepPath path,
             TaskPool* tasks = nullptr);

  /// Hands the impulses back, and the rows of plain blocks.
  void unpack(std::span<ContactBlock> blocks) const;
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

  void begin(std::size_t blocks, std::size_t chosen, std::uint32_t idle);
  void packChosenColour(std::span<const ContactBlock> blocks);
  template <class At, class KindAt>
  void packColour(std::size_t size, At&& at, KindAt&& kind_at,
                  std::span<const ContactBlock> blocks);
  void packGroup(std::span<const std::uint32_t> chosen, PackedAs kind,
                 std::span<const ContactBlock> blocks);
  std::uint32_t addUnused();
  template <class One>
  void forEachColour(WideKernels::OnImpulses wide, std::vector<SolverVelocity>& u, TaskPool* tasks,
                     One&& one);

  std::vector<WideBlock> wide_;  ///< of which the first groups_ are in use
  std::uint32_t groups_ = 0;
  std::vector<std::uint32_t> alone_;  ///< blocks that are solved one by one
  std::vector<Colour> colours_;
  std::vector<Impulses> impulses_;
  std::uint32_t blocks_ = 0;  ///< also of those that are not chosen
  std::uint32_t idle_ = 0;
  std::vector<std::uint32_t> colour_;  ///< chosen blocks of the colour that is packed
  std::vector<std::uint64_t> taken_;   ///< per body: the colour that it is in
  std::uint64_t colours_so_far_ = 0;   ///< of all packings
};

}  // namespace merge2d
