#pragma once
/// The search for impulses inside a collection that carry a load: the engine's own block sweeps
/// inside the conjugate gradient (dynamics/nncg.h) over rigid rows, until they have converged.
/// Velocities are those against the collection's frame, in its directions.

#include "src2d/dynamics/state.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/load_certificate.h"

namespace merge2d {

/// Whether its load is looked at in this step, as always but for a while after a hit.
bool isLookedAt(const State& state, const Collection& collection);

/// Begins a search for impulses that carry a load.
void beginSearch(const State& state, Collection& collection, const CollectionLoad& load);

/// Whether Newton's method takes part in this step, as sweeps over all rows have not ended the
/// search.
bool isDirect(const State& state, const ProofSearch& search);

/// Replaces the load of a search by that of this step; the impulses found so far stay.
void renewLoad(const State& state, Collection& collection, const CollectionLoad& load);

/// Begins a search for impulses that carry a load beyond those that there were. The heaviest member
/// of a floating collection is fixed, as its rows follow from those of the others.
void beginSearchAhead(const State& state, Collection& collection, Witness&& load, double way);

/// Memory and records of a search: several threads may go on with searches in different
/// collections.
struct SearchTools {
  SweepTools sweeps;
  NewtonWorkspace* newton = nullptr;  ///< of a direct solve; none where none is due
  Notes* notes = nullptr;             ///< none where no records are made
};

/// Where a direct solve keeps its matrix, if the search is to go on with one.
void makeRoom(const State& state, Scratch& scratch, const Collection& collection);
SearchTools searchToolsOf(Scratch& scratch, const SweepTools& sweeps, const Collection& collection);

/// Goes on with a search, for one step at most or until its residual is below `tolerance` [m/s];
/// leaves the members' velocities in `trial_u` of the memory of sweeps and the largest residual of
/// a row in Collection::residual.
void continueSearch(const State& state, const SearchTools& tools, Collection& collection,
                    double tolerance);

/// How fast the members move at the contacts with the velocities in `memory.trial_u` [m/s];
/// infinite where one is no number.
double fastestContact(const SweepMemory& memory, const Collection& collection);

}  // namespace merge2d
