#pragma once
/// The rows of the full solve: from contacts to blocks, and back.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Sets up the velocities u₋ + h M⁻¹ f, and the islands of all contacts and joints in B.
void listRows(State& state, Scratch& scratch);

/// Blocks are called by their place in the order of the solve (Scratch::block_order). Each may be
/// made and stored by another thread.
class ContactRows {
 public:
  ContactRows(State& state, Scratch& scratch);

  /// The rows of one block in Scratch::blocks, with the impulses of the last step as a start.
  void make(std::uint32_t block);
  /// Hands its impulses back to the contacts, with the velocities that they leave.
  void store(std::uint32_t block);

  /// Makes the rows of a block unless it is plain, so that they can be made four at a time: a
  /// contact between two things that neither bounce, roll nor pull, and are not hit.
  PackedAs makeUnlessPlain(std::uint32_t block);
  /// Makes a group of plain blocks; `first` is the one that its island begins with.
  void makeGroup(WideBlocks& wide, WideBlock& group, std::uint32_t first, SweepPath path);
  /// Hands the impulses of a group back.
  void storeGroup(WideBlocks& wide, const WideBlock& group, std::uint32_t first, SweepPath path);

 private:
  RowSource& sourceOf(std::uint32_t block) const {
    return scratch_.row_sources[scratch_.block_order[block].source()];
  }
  bool isPlain(std::uint32_t block) const;
  void gather(std::uint32_t block, std::size_t lane, WideBlock& group, FourContacts& to,
              Impulses& impulses);

  State& state_;
  Scratch& scratch_;
  RowSettings settings_;
};

}  // namespace merge2d
