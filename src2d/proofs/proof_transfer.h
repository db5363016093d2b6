#pragma once
/// Proofs outlive a layout: the impulses of a witness go on to carry their load when a body joins a
/// collection or leaves it. When a body leaves, its impulses on the others become loads from
/// outside; when one joins, such loads become impulses inside.

#include "src2d/core/regrouping.h"
#include "src2d/proofs/load_certificate.h"

namespace merge2d {

/// Contacts have left a collection, and their blocks leave it now: in all proofs their impulses
/// become loads from outside.
void releaseFromProofs(const State& state, Collection& collection);

/// Bodies join a collection that has not been laid out anew yet: in the proofs they are held by
/// forces from outside.
void admitToProofs(const State& state, Collection& collection, std::span<const BodyId> bodies);

/// Carries the proofs of a collection over to its new layout, or drops them where much has changed.
class ProofTransfer {
 public:
  /// Before the layout.
  ProofTransfer(const State& state, Collection& collection);
  /// Likewise, where it is made anew, with the contacts in order.
  void noteBlocks();
  /// After a new layout.
  void finish();
  /// After one that went on: blocks from this one on are new.
  void finishGrowth(std::uint32_t first);

 private:
  static constexpr std::uint32_t kNew = Regrouping::kNew;

  bool survive(std::size_t kept) const;
  bool changedMuch() const;
  void dropColumns();
  void express(Witness& witness) const;
  void holdNewContacts();
  void conclude();
  std::vector<std::uint32_t> blocksNearBy() const;
  double motionOf(const Witness& witness, const std::vector<std::uint32_t>& blocks) const;

  const State& state_;
  Collection& c_;
  std::vector<std::uint32_t> before_;  ///< per contact: its block, or kNew
  std::vector<std::uint32_t> fresh_;   ///< blocks that are new
  Vec2 middle_;                        ///< of the members' box, before
  double size_;                        ///< before
};

}  // namespace merge2d
