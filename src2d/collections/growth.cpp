#include <algorithm>
#include <span>

#include "src2d/collections/inner_push.h"
#include "src2d/collections/joint_sweep.h"
#include "src2d/collections/layout.h"
#include "src2d/core/memory.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/proof_columns.h"
#include "src2d/proofs/proof_transfer.h"

namespace merge2d {
namespace {

/// A collection, and the members and contacts that have come in since its last layout.
class Growth {
 public:
  Growth(State& state, Collection& c)
      : state_(state),
        c_(c),
        members_(c.laid_out.members),
        contacts_(static_cast<std::uint32_t>(c.block_contact.size())) {}

  bool isLittle();
  void layOut();

 private:
  std::span<const BodyId> newMembers() const { return std::span(c_.members).subspan(members_); }
  bool isNew(BodyId b) const {
    return state_[b].rigid == c_.rigid && state_[rigidOf(b)].member >= members_;
  }

  void addMass();
  void addWelds();
  void addBlocks();

  State& state_;
  Collection& c_;
  std::uint32_t members_, contacts_;  ///< before
};

bool Growth::isLittle() {
  const std::size_t sorted = c_.laid_out.sorted_welds;
  const std::size_t behind = c_.welds.size() - sorted + c_.contacts.size() - contacts_;
  if (!isSmallPart(behind, sorted)) return false;
  for (std::uint32_t m = members_; m < c_.members.size(); ++m) {
    state_[rigidOf(c_.members[m])].member = m;
  }
  // Contacts of a weld stand in a row: one between bodies that were there may belong to a weld.
  return std::ranges::all_of(std::span(c_.contacts).subspan(contacts_), [&](const auto& inner) {
    return isNew(inner.key.a) || isNew(inner.key.b);
  });
}

void Growth::layOut() {
  std::ranges::sort(std::span(c_.contacts).subspan(contacts_), {}, &InternalContact::key);
  ProofTransfer proofs(state_, c_);
  if (!state_[c_.rigid].floating()) addMass();
  fitBox(state_, c_.rigid);
  addWelds();
  addBlocks();
  proofs.finishGrowth(contacts_);
  extendPush(state_, c_, contacts_);
  c_.welds_of = {};
  c_.laid_out.members = static_cast<std::uint32_t>(c_.members.size());
}

void Growth::addMass() {
  Rigid& r = state_[c_.rigid];
  for (const BodyId b : newMembers()) {
    r.mass += state_[b].mass;
    r.inertia += state_[b].inertia + state_[b].mass * state_[b].local.squaredNorm();
    state_.extents[r.extent].bounds.include(memberBounds(state_, b));
  }
}

void Growth::addWelds() {
  const auto frame = static_cast<std::uint32_t>(c_.members.size());
  for (Weld& weld : c_.welds) {  // the frame's node is the last
    if (weld.node_a == members_) weld.node_a = frame;
    if (weld.node_b == members_) weld.node_b = frame;
  }
  const auto nodeOf = [&](BodyId b) {
    return state_[b].rigid == c_.rigid ? state_[rigidOf(b)].member : frame;
  };
  for (std::uint32_t i = contacts_; i < c_.contacts.size(); ++i) {
    InternalContact& inner = c_.contacts[i];
    const ContactKey& key = inner.key;
    const bool goes_on = i > contacts_ && c_.welds.back().a == key.a && c_.welds.back().b == key.b;
    if (!goes_on) {
      appendTightly(c_.welds);
      c_.welds.back() = {.a = key.a,
                         .b = key.b,
                         .first = i,
                         .node_a = nodeOf(key.a),
                         .node_b = nodeOf(key.b),
                         .expected = true};
    }
    Weld& weld = c_.welds.back();
    weld.expected &= inner.since == kExpected;
    ++weld.count;
    inner.weld = static_cast<std::uint32_t>(c_.welds.size() - 1);
  }
}

void Growth::addBlocks() {
  reserveTightly(c_.blocks, c_.contacts.size());
  reserveTightly(c_.block_contact, c_.contacts.size());
  for (std::uint32_t i = contacts_; i < c_.contacts.size(); ++i) {
    InternalContact& inner = c_.contacts[i];
    inner.block = i;
    c_.blocks.push_back(innerBlock(state_, c_, inner));
    c_.block_contact.push_back(i);
    inner.count = static_cast<std::int16_t>(c_.blocks.back().count);
    c_.laid_out.points += inner.count;
  }
}

}  // namespace

bool layOutGrowth(State& state, Collection& c) {
  if (!hasProofs(c) || !isLarge(state, c) || !c.joints.empty()) return false;
  if (c.laid_out.members == 0) return false;
  Growth growth(state, c);
  if (!growth.isLittle()) return false;
  growth.layOut();
  return true;
}

}  // namespace merge2d
