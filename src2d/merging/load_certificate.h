#pragma once
/// Proofs that the contacts inside a collection carry the load on its members.
///
/// In a collection's frame the load on a member at rest there is linear in five numbers (FrameLoad)
/// and in the forces that act on it from outside. Admissible impulses (Eqs. (2)-(7)) form a convex
/// cone, and equilibrium is linear: a load that is a non-negative combination of loads that were
/// carried is carried by the same combination of their impulses.

#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The load on one collection in this step. Bodies outside act on `outer`, ascending by member.
struct CollectionLoad {
  FrameLoad frame{};
  std::span<const OuterLoad> outer;
  Rotation back;            ///< from the world into the collection's frame
  double size = 1.0;        ///< of the collection [m]
  double norm = 0.0;        ///< of `frame` [m/s]
  double outer_norm = 0.0;  ///< of the velocities that `outer` gives [m/s]
};

/// Lists the forces and impulses from outside on the members of awake collections, with the contact
/// impulses of the last step, in `scratch.outer_loads`.
void listOuterLoads(const State& state, Scratch& scratch);

/// The load on a collection, once those are listed.
CollectionLoad loadOn(const State& state, const Scratch& scratch, const Collection& c);

/// True when the collection's witnesses cover the load: its weights are then those of the
/// combination.
bool covers(const State& state, Collection& c, const CollectionLoad& load);

/// True while a load is nearer to the one that is sought ahead than where that search began.
bool leadsTo(const State& state, const Collection& c, const CollectionLoad& load);

/// The load as a witness that has no impulses yet.
Witness asWitness(const State& state, Collection& c, const CollectionLoad& load);

/// A load as far beyond this one, seen from the mean of the witnesses, as `part` of its distance,
/// and at least as `least` of its size; with the impulses of this one. `way`: how
/// far that is.
Witness beyond(const LoadCertificate& proof, const Witness& load, double part, double least,
               double& way);

/// The velocity that the load gives one member, in the collection's frame.
Twist loadOnMember(const State& state, const Collection& c, const Witness& load,
                   std::uint32_t member);

/// The velocities that a load gives all members, in the collection's frame, before contacts and
/// joints inside act: momentum and angular momentum are zero for what floats.
void loadMembers(const State& state, const Collection& c, const CollectionLoad& load,
                 std::vector<Twist>& out);

/// Puts the impulses that stand in blocks and joints into a witness, or takes them from there.
void readImpulses(const Collection& c, Witness& to);
void swapImpulses(Collection& c, Witness& with);

/// What the impulses that carry a load would be if they were linear in it, from those of the
/// witnesses, and brought back to their limits. Nothing without witnesses.
void predictImpulses(const Collection& c, Witness& load);

/// Keeps a witness; today's load is taken to be its.
void remember(Collection& c, Witness&& witness);

/// Writes the impulses that belong to the weights into blocks and joints.
void writeImpulses(Collection& c);

}  // namespace merge2d
