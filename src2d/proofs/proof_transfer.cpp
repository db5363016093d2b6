#include "src2d/proofs/proof_transfer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "src2d/core/memory.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/new_contacts.h"
#include "src2d/proofs/proof_columns.h"

namespace merge2d {
namespace {

constexpr std::uint32_t kLeft = ~0u;  ///< no contact refers to the block any more

}  // namespace

void releaseFromProofs(const State& state, Collection& c) {
  if (!hasProofs(c)) return;
  LoadCertificate& proof = c.certificate.front();
  const bool has_joints = proof.witnesses.front().lambda.size() != c.blocks.size();
  if (has_joints) return forgetProofs(c);
  std::vector<std::uint32_t> place(c.blocks.size(), kLeft);
  for (const InternalContact& inner : c.contacts) {
    if (inner.block != InternalContact::kNoBlock) place[inner.block] = 0;
  }
  for (std::uint32_t i = 0; i < c.blocks.size(); ++i) {
    if (place[i] == kLeft) addToColumns(state, c, i, 1.0);
  }
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < c.blocks.size(); ++i) {
    if (place[i] == kLeft) continue;
    place[i] = kept;
    c.blocks[kept] = c.blocks[i];
    for (Witness& witness : proof.witnesses) witness.lambda[kept] = witness.lambda[i];
    ++kept;
  }
  c.blocks.resize(kept);
  for (Witness& witness : proof.witnesses) witness.lambda.resize(kept);
  for (InternalContact& inner : c.contacts) {
    if (inner.block != InternalContact::kNoBlock) inner.block = place[inner.block];
  }
}

void admitToProofs(const State& state, Collection& c, std::span<const BodyId> bodies) {
  if (!hasProofs(c)) return;
  LoadCertificate& proof = c.certificate.front();
  if (!isSmallPart(proof.columns.size() + bodies.size(), c.members.size())) return forgetProofs(c);
  for (const BodyId b : bodies) {
    const std::size_t column = columnOf(proof, b);
    for (Witness& witness : proof.witnesses) {
      const Twist u = velocityAt(state, c, witness.frame, state[b].local);
      witness.outer[column] = {-u.vx, -u.vy, -u.omega * sizeOf(state, c)};
    }
  }
}

ProofTransfer::ProofTransfer(const State& state, Collection& c)
    : state_(state),
      c_(c),
      middle_(state.extent(c.rigid).box.frame.position),
      size_(sizeOf(state, c)) {}

void ProofTransfer::noteBlocks() {
  if (!hasProofs(c_)) return;
  before_.reserve(c_.contacts.size());
  for (const InternalContact& inner : c_.contacts) before_.push_back(inner.block);
}

bool ProofTransfer::changedMuch() const {
  return !isSmallPart(c_.certificate.front().columns.size(), c_.members.size());
}

bool ProofTransfer::survive(std::size_t kept) const {
  if (!hasProofs(c_) || !c_.joints.empty()) return false;
  const LoadCertificate& proof = c_.certificate.front();
  return proof.witnesses.front().lambda.size() == kept && proof.heaviest == heaviestOf(state_, c_);
}

/// Those of bodies that have left, and those that are zero in all proofs.
void ProofTransfer::dropColumns() {
  LoadCertificate& proof = c_.certificate.front();
  const auto isZero = [](const Twist& u) { return u.vx == 0.0 && u.vy == 0.0 && u.omega == 0.0; };
  std::size_t kept = 0;
  for (std::size_t k = 0; k < proof.columns.size(); ++k) {
    if (state_[proof.columns[k]].rigid != c_.rigid) continue;
    if (std::ranges::all_of(proof.witnesses, [&](const auto& w) { return isZero(w.outer[k]); })) {
      continue;
    }
    proof.columns[kept] = proof.columns[k];
    for (Witness& witness : proof.witnesses) witness.outer[kept] = witness.outer[k];
    ++kept;
  }
  proof.columns.resize(kept);
  for (Witness& witness : proof.witnesses) witness.outer.resize(kept);
}

/// The load of a witness seen from the new box, and the impulses of new contacts.
void ProofTransfer::express(Witness& witness) const {
  const double size = sizeOf(state_, c_), scale = size / size_;
  const Vec2 way = state_.extent(c_.rigid).box.frame.position - middle_;
  FrameLoad& load = witness.frame;
  const double along = load[2] / size_, across = load[3] / size_;
  load[0] += along * way.x() - across * way.y();
  load[1] += along * way.y() + across * way.x();
  for (std::size_t i = 2; i < load.size(); ++i) load[i] *= scale;
  for (Twist& outer : witness.outer) outer.omega *= scale;
  for (const std::uint32_t i : fresh_) witness.lambda[i] = c_.blocks[i].lambda;
}

/// New contacts take over forces from outside: few of them as large a part as they can, in each
/// proof anew; many of them their impulses of now.
void ProofTransfer::holdNewContacts() {
  LoadCertificate& proof = c_.certificate.front();
  for (const std::uint32_t i : fresh_) {
    for (const std::uint32_t body : {c_.blocks[i].a, c_.blocks[i].b}) {
      if (hasColumn(state_, c_, body)) columnOf(proof, BodyId{body});
    }
  }
  const NewContacts contacts(state_, c_, fresh_);
  if (contacts.areFew()) {
    for (Witness& witness : proof.witnesses) {
      for (const std::uint32_t i : fresh_) witness.lambda[i] = {};
      contacts.takeOver(proof, witness);
    }
  }
  for (const std::uint32_t i : fresh_) addToColumns(state_, c_, i, -1.0);
}

/// The blocks at members that have a new contact.
std::vector<std::uint32_t> ProofTransfer::blocksNearBy() const {
  std::vector<std::uint32_t> near;
  for (const std::uint32_t i : fresh_) {
    for (const std::uint32_t body : {c_.blocks[i].a, c_.blocks[i].b}) {
      const bool member = body < state_.bodies.size() && state_[BodyId{body}].rigid == c_.rigid;
      if (member) near.push_back(body);
    }
  }
  std::ranges::sort(near);
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::vector<std::uint32_t> blocks;
  const auto isNear = [&](BodyId b) {
    return std::ranges::binary_search(near, static_cast<std::uint32_t>(b));
  };
  for (const Weld& weld : c_.welds) {
    if (!isNear(weld.a) && !isNear(weld.b)) continue;
    for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
      blocks.push_back(c_.contacts[i].block);
    }
  }
  std::ranges::sort(blocks);
  return blocks;
}

/// How fast the members move in a proof, at the new contacts at least.
double ProofTransfer::motionOf(const Witness& witness,
                               const std::vector<std::uint32_t>& blocks) const {
  std::map<std::uint32_t, SolverVelocity> u;
  const auto start = [&](std::uint32_t body) {
    if (!hasColumn(state_, c_, body)) return;
    const BodyId b{body};
    const Twist load = loadOnMember(state_, c_, witness, state_[rigidOf(b)].member);
    u.insert_or_assign(body, memberVelocity(state_, b, load));
  };
  for (const std::uint32_t i : fresh_) start(c_.blocks[i].a), start(c_.blocks[i].b);
  SolverVelocity still;
  const auto velocity = [&](std::uint32_t body) -> SolverVelocity& {
    const auto found = u.find(body);
    return found == u.end() ? still : found->second;
  };
  for (const std::uint32_t i : blocks) {
    ContactBlock k = c_.blocks[i];
    k.lambda = witness.lambda[i];
    applyImpulses(k, velocity(k.a), velocity(k.b));
  }
  double most = witness.motion;
  for (const std::uint32_t i : fresh_) {
    const ContactBlock& k = c_.blocks[i];
    for (int p = 0; p < k.count; ++p) {
      const ContactVelocity w = contactVelocity(k, p, k.nx, k.ny, velocity(k.a), velocity(k.b));
      most = std::max({most, std::abs(w.n), std::abs(w.t)});
    }
  }
  return most;
}

void ProofTransfer::finish() {
  const auto kept = std::ranges::count_if(before_, [](auto block) { return block != kNew; });
  if (!survive(static_cast<std::size_t>(kept))) return c_.certificate.clear();
  std::vector<std::uint32_t> from;
  from.reserve(c_.blocks.size());
  for (std::uint32_t i = 0; i < c_.blocks.size(); ++i) {
    from.push_back(before_[c_.block_contact[i]]);
    if (from.back() == kNew) fresh_.push_back(i);
  }
  const Regrouping blocks(std::move(from));
  for (Witness& witness : c_.certificate.front().witnesses) {
    reserveTightly(witness.lambda, c_.blocks.size());
    blocks.apply(witness.lambda);
  }
  conclude();
}

void ProofTransfer::finishGrowth(std::uint32_t first) {
  if (!survive(first)) return c_.certificate.clear();
  for (std::uint32_t i = first; i < c_.blocks.size(); ++i) fresh_.push_back(i);
  for (Witness& witness : c_.certificate.front().witnesses) {
    resizeTightly(witness.lambda, c_.blocks.size());
  }
  conclude();
}

/// Drops the proofs that no longer hold, once their impulses are in the new order.
void ProofTransfer::conclude() {
  LoadCertificate& proof = c_.certificate.front();
  dropColumns();
  for (Witness& witness : proof.witnesses) express(witness);
  holdNewContacts();
  const std::vector<std::uint32_t> near_by = blocksNearBy();
  for (Witness& witness : proof.witnesses) witness.motion = motionOf(witness, near_by);
  const auto isProof = [&](const Witness& w) { return w.motion <= cutSpeed(state_); };
  const auto found = proof.witnesses.begin() + static_cast<std::ptrdiff_t>(proof.inherited);
  const auto old = std::count_if(proof.witnesses.begin(), found, isProof);
  std::erase_if(proof.witnesses, [&](const Witness& w) { return !isProof(w); });
  dropColumns();
  if (changedMuch()) {  // perhaps long ago
    proof.witnesses.erase(proof.witnesses.begin(), proof.witnesses.begin() + old);
    dropColumns();
  }
  if (proof.witnesses.empty() || changedMuch()) {
    c_.certificate.clear();
  } else {
    restart(state_, proof);
  }
}

}  // namespace merge2d
