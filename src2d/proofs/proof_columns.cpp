#include "src2d/proofs/proof_columns.h"

#include <algorithm>

namespace merge2d {

bool hasProofs(const Collection& c) {
  return !c.certificate.empty() && !c.certificate.front().witnesses.empty();
}

bool hasColumn(const State& state, const Collection& c, std::uint32_t body) {
  if (body >= state.bodies.size()) return false;
  const BodyId b{body};
  return state[b].rigid == c.rigid && b != c.certificate.front().heaviest;
}

BlockGains gainsOf(const State& state, const ContactBlock& block, const Impulses& lambda) {
  BlockGains gains;
  if (block.a < state.bodies.size()) gains.a = memberVelocity(state, BodyId{block.a});
  if (block.b < state.bodies.size()) gains.b = memberVelocity(state, BodyId{block.b});
  ContactBlock k = block;
  k.lambda = lambda;
  applyImpulses(k, gains.a, gains.b);
  return gains;
}

std::size_t columnOf(LoadCertificate& proof, BodyId b) {
  const auto at = std::ranges::lower_bound(proof.columns, b) - proof.columns.begin();
  const auto place = static_cast<std::size_t>(at);
  if (place < proof.columns.size() && proof.columns[place] == b) return place;
  proof.columns.insert(proof.columns.begin() + at, b);
  for (Witness& witness : proof.witnesses) {
    witness.outer.insert(witness.outer.begin() + at, Twist{});
  }
  return place;
}

void addToColumns(const State& state, Collection& c, std::uint32_t block, double sign) {
  LoadCertificate& proof = c.certificate.front();
  const ContactBlock& k = c.blocks[block];
  const double size = sizeOf(state, c);
  const auto add = [&](Twist& column, const SolverVelocity& gain) {
    column.vx += sign * gain.vx;
    column.vy += sign * gain.vy;
    column.omega += sign * gain.omega * size;
  };
  for (const std::uint32_t body : {k.a, k.b}) {
    if (!hasColumn(state, c, body)) continue;
    const std::size_t column = columnOf(proof, BodyId{body});
    for (Witness& witness : proof.witnesses) {
      const BlockGains gains = gainsOf(state, k, witness.lambda[block]);
      add(witness.outer[column], body == k.a ? gains.a : gains.b);
    }
  }
}

}  // namespace merge2d
