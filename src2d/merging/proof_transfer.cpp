#include "src2d/merging/proof_transfer.h"

#include <algorithm>

#include "src2d/core/nonnegative_fit.h"
#include "src2d/merging/decided_settings.h"

namespace merge2d {
namespace {

/// Where more than one member in so many is loaded from outside, proofs are dropped.
constexpr std::size_t kFewest = 8;

constexpr std::uint32_t kLeft = ~0u;  ///< no contact refers to the block any more

SolverVelocity atRest(const State& state, BodyId b) {
  return {.inv_mass = 1.0 / state[b].mass, .inv_inertia = 1.0 / state[b].inertia};
}

/// The velocities that the impulses of a block give its two bodies.
struct Gains {
  SolverVelocity a, b;
};

Gains gainsOf(const State& state, const ContactBlock& block, const Impulses& lambda,
              std::size_t bodies) {
  Gains gains;
  if (block.a < bodies) gains.a = atRest(state, BodyId{block.a});
  if (block.b < bodies) gains.b = atRest(state, BodyId{block.b});
  ContactBlock k = block;
  k.lambda = lambda;
  applyImpulses(k, gains.a, gains.b);
  return gains;
}

/// The place of a body's column, which is made if there is none.
std::size_t columnOf(LoadCertificate& proof, BodyId b) {
  const auto at = std::ranges::lower_bound(proof.columns, b) - proof.columns.begin();
  const auto place = static_cast<std::size_t>(at);
  if (place < proof.columns.size() && proof.columns[place] == b) return place;
  proof.columns.insert(proof.columns.begin() + at, b);
  for (Witness& witness : proof.witnesses)
    witness.outer.insert(witness.outer.begin() + at, Twist{});
  return place;
}

void add(Twist& to, const SolverVelocity& gain, double sign, double size) {
  to.vx += sign * gain.vx;
  to.vy += sign * gain.vy;
  to.omega += sign * gain.omega * size;
}

/// Adds the impulses of a block to the load from outside on one of its bodies, in all proofs.
void addToColumn(const State& state, LoadCertificate& proof, const ContactBlock& k, BodyId b,
                 double sign, double size, auto&& lambdaOf) {
  const std::size_t column = columnOf(proof, b);
  for (Witness& witness : proof.witnesses) {
    const Gains gains = gainsOf(state, k, lambdaOf(witness), state.bodies.size());
    add(witness.outer[column], BodyId{k.a} == b ? gains.a : gains.b, sign, size);
  }
}

/// A member whose load from outside counts.
bool isHeld(const State& state, const Collection& c, std::uint32_t body) {
  if (body >= state.bodies.size()) return false;
  const BodyId b{body};
  return state[b].rigid == c.rigid && b != c.certificate.front().heaviest;
}

bool hasProofs(const Collection& c) {
  return !c.certificate.empty() && !c.certificate.front().witnesses.empty();
}

}  // namespace

void releaseFromProofs(const State& state, Collection& c, const std::vector<std::uint8_t>& stays) {
  if (!hasProofs(c)) return;
  LoadCertificate& proof = c.certificate.front();
  const double size = sizeOf(state, c);
  const auto staysHeld = [&](std::uint32_t body) {
    return isHeld(state, c, body) && stays[state[rigidOf(BodyId{body})].member];
  };
  std::vector<std::uint32_t> place(c.blocks.size(), kLeft);
  for (const InternalContact& inner : c.contacts) {
    if (inner.block != InternalContact::kNoBlock) place[inner.block] = 0;
  }
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < c.blocks.size(); ++i) {
    const ContactBlock k = c.blocks[i];
    if (place[i] == kLeft) {
      const auto lambdaOf = [&](const Witness& w) -> const Impulses& { return w.lambda[i]; };
      for (const std::uint32_t body : {k.a, k.b}) {
        if (staysHeld(body)) addToColumn(state, proof, k, BodyId{body}, 1.0, size, lambdaOf);
      }
      continue;
    }
    place[i] = kept;
    c.blocks[kept] = k;
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
  if (kFewest * (proof.columns.size() + bodies.size()) > c.members.size()) return forgetProofs(c);
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
      size_(sizeOf(state, c)) {
  if (!hasProofs(c)) return;
  for (const InternalContact& inner : c.contacts) before_.push_back(inner.block);
}

bool ProofTransfer::changedMuch() const {
  return kFewest * c_.certificate.front().columns.size() > c_.members.size();
}

bool ProofTransfer::survives() const {
  if (!hasProofs(c_) || !c_.joints.empty()) return false;
  const LoadCertificate& proof = c_.certificate.front();
  const auto kept = std::ranges::count_if(before_, [](auto block) { return block != kNew; });
  if (proof.witnesses.front().lambda.size() != static_cast<std::size_t>(kept)) return false;
  return proof.heaviest == heaviestOf(state_, c_);
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

/// The load of a witness seen from the new box, and its impulses in the new order.
void ProofTransfer::express(Witness& witness) const {
  const double size = sizeOf(state_, c_), scale = size / size_;
  const Vec2 way = state_.extent(c_.rigid).box.frame.position - middle_;
  FrameLoad& load = witness.frame;
  const double along = load[2] / size_, across = load[3] / size_;
  load[0] += along * way.x() - across * way.y();
  load[1] += along * way.y() + across * way.x();
  for (std::size_t i = 2; i < load.size(); ++i) load[i] *= scale;
  for (Twist& outer : witness.outer) outer.omega *= scale;
  std::vector<Impulses> lambda;
  lambda.reserve(c_.blocks.size());
  for (std::uint32_t i = 0; i < c_.blocks.size(); ++i) {
    const std::uint32_t block = before_[c_.block_contact[i]];
    lambda.push_back(block == kNew ? c_.blocks[i].lambda : witness.lambda[block]);
  }
  witness.lambda = std::move(lambda);
}

/// The two edges of the cones of new contacts, and the loads from outside that they take over.
class NewContacts {
 public:
  static constexpr std::size_t kMost = 16;  // edges: of eight points

  NewContacts(const State& state, const Collection& c, const std::vector<std::uint32_t>& blocks)
      : state_(state), c_(c) {
    for (const std::uint32_t i : blocks) add(i);
  }

  bool tooMany() const { return edges_.size() > kMost; }

  /// The impulses that leave least of the load from outside in a proof.
  void hold(LoadCertificate& proof, Witness& witness) const {
    const double size = sizeOf(state_, c_);
    std::array<double, kMost * kMost> gram{};
    std::array<double, kMost> b{};
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      for (const Push& push : edges_[i].pushes) {
        const Twist& outer = witness.outer[columnOf(proof, push.body)];
        b[i] += energy(push, {outer.vx, outer.vy, outer.omega / size});
      }
      for (std::size_t j = 0; j < edges_.size(); ++j) {
        double& g = gram[i * kMost + j];
        for (const Push& x : edges_[i].pushes) {
          for (const Push& y : edges_[j].pushes) {
            if (x.body == y.body) g += energy(x, y.gain);
          }
        }
        if (i == j) g *= 1.0 + kRidge;
      }
    }
    const auto part = nonNegativeFit<kMost>(gram, b, edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Edge& edge = edges_[i];
      Impulses& lambda = witness.lambda[edge.block];
      lambda[edge.point] += part[i];
      lambda[edge.point + 2] += part[i] * edge.mu;
    }
  }

 private:
  static constexpr double kRidge = 1e-10;  // edges of many points depend on each other
  struct Push {
    BodyId body{};
    Twist gain;
  };
  struct Edge {
    std::uint32_t block = 0;
    std::size_t point = 0;
    double mu = 0.0;
    std::vector<Push> pushes;
  };

  double energy(const Push& x, const Twist& y) const {
    const Body& body = state_[x.body];
    return body.mass * (x.gain.vx * y.vx + x.gain.vy * y.vy) +
           body.inertia * x.gain.omega * y.omega;
  }

  void add(std::uint32_t i) {
    const ContactBlock& k = c_.blocks[i];
    for (std::size_t p = 0; p < static_cast<std::size_t>(k.count); ++p) {
      if (!k.rolls() && k.bias[p] > 0.0) continue;  // not closed yet
      for (const double mu : {k.mu, -k.mu}) {
        Edge edge{i, p, mu, {}};
        Impulses unit{};
        unit[p] = 1.0;
        unit[p + 2] = mu;
        const Gains gains = gainsOf(state_, k, unit, state_.bodies.size());
        const auto push = [&](std::uint32_t body, const SolverVelocity& u) {
          if (!isHeld(state_, c_, body)) return;
          edge.pushes.push_back({BodyId{body}, {u.vx, u.vy, u.omega}});
        };
        push(k.a, gains.a);
        push(k.b, gains.b);
        edges_.push_back(std::move(edge));
        if (mu == 0.0) break;
      }
    }
  }

  const State& state_;
  const Collection& c_;
  std::vector<Edge> edges_;
};

/// New contacts take over from forces outside what they can: few of them in each proof as much as
/// they can, many what they carry now.
void ProofTransfer::holdNewContacts() {
  LoadCertificate& proof = c_.certificate.front();
  const double size = sizeOf(state_, c_);
  for (const std::uint32_t i : fresh_) {
    for (const std::uint32_t body : {c_.blocks[i].a, c_.blocks[i].b}) {
      if (isHeld(state_, c_, body)) columnOf(proof, BodyId{body});
    }
  }
  const NewContacts contacts(state_, c_, fresh_);
  if (!contacts.tooMany()) {
    for (Witness& witness : proof.witnesses) {
      for (const std::uint32_t i : fresh_) witness.lambda[i] = {};
      contacts.hold(proof, witness);
    }
  }
  for (const std::uint32_t i : fresh_) {
    const ContactBlock& k = c_.blocks[i];
    for (const std::uint32_t body : {k.a, k.b}) {
      if (!isHeld(state_, c_, body)) continue;
      addToColumn(state_, proof, k, BodyId{body}, -1.0, size,
                  [&](const Witness& w) -> const Impulses& { return w.lambda[i]; });
    }
  }
}

/// How fast the members move at the new contacts.
double ProofTransfer::motionOf(const Witness& witness) const {
  std::vector<SolverVelocity> u(c_.members.size() + 1);
  for (std::uint32_t m = 0; m < c_.members.size(); ++m) {
    const BodyId b = c_.members[m];
    if (b == c_.certificate.front().heaviest) continue;
    const Twist load = loadOnMember(state_, c_, witness, m);
    u[m] = atRest(state_, b);
    u[m].vx = load.vx;
    u[m].vy = load.vy;
    u[m].omega = load.omega;
  }
  const auto velocity = [&](std::uint32_t body) -> SolverVelocity& {
    const bool inside = body < state_.bodies.size() && state_[BodyId{body}].rigid == c_.rigid;
    return inside ? u[state_[rigidOf(BodyId{body})].member] : u.back();
  };
  for (std::uint32_t i = 0; i < c_.blocks.size(); ++i) {
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
  if (!survives()) {
    c_.certificate.clear();
    return;
  }
  LoadCertificate& proof = c_.certificate.front();
  for (std::uint32_t i = 0; i < c_.blocks.size(); ++i) {
    if (before_[c_.block_contact[i]] == kNew) fresh_.push_back(i);
  }
  dropColumns();
  for (Witness& witness : proof.witnesses) express(witness);
  holdNewContacts();
  for (Witness& witness : proof.witnesses) witness.motion = motionOf(witness);
  const auto isProof = [&](const Witness& w) { return w.motion <= cutSpeed(state_); };
  const auto found = proof.witnesses.begin() + static_cast<std::ptrdiff_t>(proof.inherited);
  const auto old = std::count_if(proof.witnesses.begin(), found, isProof);
  std::erase_if(proof.witnesses, [&](const Witness& w) { return !isProof(w); });
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
