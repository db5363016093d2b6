#pragma once
/// The loads from outside in the proofs of a collection: one column for each member on which
/// something outside acts in any of them.

#include "src2d/proofs/load_certificate.h"

namespace merge2d {

/// Whether a collection has a load that its contacts are known to carry.
bool hasProofs(const Collection& collection);

/// Whether a body is a member whose load from outside counts: of a floating collection the heaviest
/// follows from the others.
bool hasColumn(const State& state, const Collection& collection, std::uint32_t body);

/// The velocities that impulses of a block give its two bodies.
struct BlockGains {
  SolverVelocity a, b;
};
BlockGains gainsOf(const State& state, const ContactBlock& block, const Impulses& lambda);

/// The place of a body's column, which is made if there is none.
std::size_t columnOf(LoadCertificate& proof, BodyId body);

/// Adds the impulses that a block has in each proof to the loads from outside on its members,
/// `sign` times.
void addToColumns(const State& state, Collection& collection, std::uint32_t block, double sign);

}  // namespace merge2d
