#pragma once
/// From the state to what can be seen of it.

#include "src2d/dynamics/forces.h"
#include "src2d/dynamics/state.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

/// Fills `out` with everything but the decisions; energies and momenta are computed here.
void captureState(const State& state, const Actions& actions, const Scratch& scratch,
                  Snapshot& out);

/// The same without contacts, welds and joints, at a fraction of the cost.
void captureMotion(const State& state, const Actions& actions, const Scratch& scratch,
                   Snapshot& out);

/// How deep bodies overlap [m] in contacts of the step that just ended, and inside the collections
/// that merged in it: over all steps the largest is that of all contacts, since nothing changes
/// inside collections or where all sleep.
double deepestOverlap(const State& state, const std::vector<Event>& events);

/// The cheap part of the statistics: counts of the step that just ended.
void countBodies(const State& state, Scratch& scratch);

/// Bytes held by the tables of a simulation.
std::size_t memoryBytes(const State& state, const Scratch& scratch);

}  // namespace merge2d
